//! How things are shown.

use super::onion::Onion;
use crate::design::Design;
use crate::mesh::BodyPoint;
use crate::outline::Point;
use crate::picture::layers::looks;
use crate::picture::layers::{Layer, Shown};
use crate::picture::palette::Theme;
use crate::studio::canvas::{Camera, Plushie};
use crate::studio::language::Choice;
use std::sync::Arc;

pub struct Look {
    pub language: Choice,
    pub theme: Theme,
    /// Nothing moves by itself but what is asked to play.
    pub still: bool,
    /// Which layers of the pictures.
    pub shown: Shown,
    /// How the body is shown: a look of the pictures by its name.
    pub body: &'static str,
    pub views: Views,
    /// Of both views, or of the idealized one where each has its own. `None`: fits the body.
    pub camera: Option<Camera>,
    /// Whether the views of a wide body stand one above the other.
    pub stacks: bool,
    /// Whether both views have one camera.
    pub linked: bool,
    /// Of the realizable view where each has its own.
    pub apart: Option<Camera>,
    /// Times which the scale shall change about the middle, as soon as a view knows what it shows.
    pub zoom: Option<f32>,
    /// A box that shall fill the views, as soon as they know their sizes, mm.
    pub frame: Option<[Point; 2]>,
    /// Places of a body that were asked for, ringed until something else is done.
    pub marked: Option<(Arc<Design>, Vec<BodyPoint>)>,
    /// Whether rulers and a grid are shown.
    pub rulers: bool,
    /// Outlines of neighbouring keyframes.
    pub onion: Onion,
}

/// Which views are shown: one at least. What is hidden is not solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Views {
    Both,
    Only(Plushie),
    /// Both in one place: the realizable plushie, and the outline of the idealized one over it.
    Overlay,
}

impl Views {
    /// Whether a plushie is seen, and so has to be solved.
    pub fn shows(self, plushie: Plushie) -> bool {
        match self {
            Self::Both | Self::Overlay => true,
            Self::Only(shown) => shown == plushie,
        }
    }

    /// Whether a plushie has a view of its own.
    pub fn has_place(self, plushie: Plushie) -> bool {
        match self {
            Self::Overlay => plushie == Plushie::Realizable,
            _ => self.shows(plushie),
        }
    }

    pub fn toggled(self, plushie: Plushie) -> Self {
        self.with(plushie, !self.shows(plushie))
    }

    /// With one of them shown or hidden. Where that leaves none, the other one comes back.
    pub fn with(self, plushie: Plushie, shown: bool) -> Self {
        let other = plushie.other();
        match (shown, self.shows(other)) {
            (true, true) if self == Self::Overlay => self,
            (true, true) => Self::Both,
            (true, false) => Self::Only(plushie),
            (false, _) => Self::Only(other),
        }
    }
}

impl Look {
    /// That of a view; `None` fits the body.
    pub fn camera_of(&self, plushie: Plushie) -> Option<Camera> {
        if self.linked || plushie == Plushie::Idealized { self.camera } else { self.apart }
    }

    pub(crate) fn set_camera(&mut self, plushie: Plushie, camera: Camera) {
        let held = if self.linked || plushie == Plushie::Idealized { &mut self.camera } else { &mut self.apart };
        *held = Some(camera);
    }

    /// Fits the body into the views.
    pub(crate) fn fit(&mut self) {
        (self.camera, self.apart, self.frame, self.zoom, self.marked) = (None, None, None, None, None);
    }

    /// Lets each view have its own camera, or both that of the idealized one.
    pub(crate) fn link(&mut self, linked: bool) {
        self.linked = linked;
        self.apart = self.camera;
    }

    /// Changes the scale about the middle.
    pub(crate) fn zoom(&mut self, factor: f32) {
        self.zoom = Some(self.zoom.unwrap_or(1.0) * factor);
    }
}

impl Default for Look {
    fn default() -> Self {
        Self {
            language: Choice::default(),
            theme: Theme::Light,
            shown: Shown::default(),
            body: looks::Plush::NAME,
            views: Views::Both,
            stacks: true,
            camera: None,
            linked: true,
            apart: None,
            zoom: None,
            frame: None,
            marked: None,
            rulers: false,
            onion: Onion::default(),
            still: false,
        }
    }
}
