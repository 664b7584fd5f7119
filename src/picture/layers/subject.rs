//! Subjects of pictures, and the layers that are shown.

use crate::design::{Design, Network, Target};
use crate::discovery::Stages;
use crate::engine::Shape;
use crate::picture::color::Color;
use crate::picture::palette::Theme;
use crate::picture::silhouette::Silhouette;
use crate::picture::texture::Texture;
use crate::picture::weave::Weave;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The subject of a picture. Every layer takes its own inputs from it.
#[derive(Clone, Debug)]
pub struct Subject<'a> {
    pub design: &'a Arc<Design>,
    /// A solved plushie of that design, or its rest.
    pub shape: &'a Arc<Shape>,
    /// That of the design.
    pub silhouette: Arc<Silhouette>,
    /// Its fibres.
    pub weave: Arc<Weave>,
    /// By its name in [`LOOKS`](super::LOOKS).
    pub look: &'a str,
    /// The other plushie in the same state: figures of both are shown on one scale.
    pub beside: Option<&'a Arc<Shape>>,
    /// Other states whose outlines are shown as well.
    pub ghosts: &'a [Ghost],
    /// Whether the plushie has fibres: the idealized one.
    pub fibers: bool,
    pub theme: Theme,
    /// The layers that are shown.
    pub shown: &'a Shown,
    /// The picture on the body, if there is one.
    pub texture: Option<&'a Arc<Texture>>,
    /// Targets of the pose that the shape belongs to.
    pub targets: &'a [Target],
    /// The target that is picked out, if any.
    pub selected_target: Option<usize>,
    /// A network that is not the design's yet, drawn after its own.
    pub proposed: Option<&'a Network>,
    /// A stage of network discovery, drawn instead of fibres and tendons.
    pub stage: Option<(Stage, &'a Arc<Stages>)>,
}

impl<'a> Subject<'a> {
    /// A shape of a design in the light theme, with everything that it has and no targets.
    pub fn new(design: &'a Arc<Design>, shape: &'a Arc<Shape>) -> Self {
        Self::with(design, (&Arc::new(Silhouette::of(design)), &Arc::new(Weave::of(design))), shape)
    }

    /// [`Self::new`] with a silhouette and fibres that are known.
    pub fn with(
        design: &'a Arc<Design>,
        (silhouette, weave): (&Arc<Silhouette>, &Arc<Weave>),
        shape: &'a Arc<Shape>,
    ) -> Self {
        static AS_AT_FIRST: Shown = Shown(BTreeMap::new());
        Self {
            design,
            shape,
            silhouette: silhouette.clone(),
            weave: weave.clone(),
            look: "plain",
            beside: None,
            ghosts: &[],
            fibers: true,
            theme: Theme::Light,
            shown: &AS_AT_FIRST,
            texture: None,
            targets: &[],
            selected_target: None,
            proposed: None,
            stage: None,
        }
    }
}

/// Another state whose outline is shown as well, and its colour.
#[derive(Clone, Debug)]
pub struct Ghost {
    pub shape: Arc<Shape>,
    pub color: Color,
}

/// The layers that somebody has asked to show or to hide, by their names; the others are as at first.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shown(BTreeMap<String, bool>);

impl Shown {
    /// Whether a layer was asked for or hidden; `None` where nothing was asked.
    pub fn asked(&self, name: &str) -> Option<bool> {
        self.0.get(name).copied()
    }

    /// Asks to show or hide a layer.
    pub fn set(&mut self, name: &str, shown: bool) {
        self.0.insert(name.to_owned(), shown);
    }

    /// With a layer shown or hidden.
    pub fn with(mut self, name: &str, shown: bool) -> Self {
        self.set(name, shown);
        self
    }
}

/// The four pictures of fig. 6.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// (a) the activation graph: every fibre, weighted by contraction.
    Activation,
    /// (b) the heaviest fibres; the starting component stands out.
    Seeds,
    /// (c) the winch tree: components and the joining paths between them.
    Tree,
    /// (d) the winch and its tendons.
    Result,
}

impl Stage {
    pub const ALL: [Self; 4] = [Self::Activation, Self::Seeds, Self::Tree, Self::Result];
}
