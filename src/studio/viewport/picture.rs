//! What a view shows: of its layers, only those are made anew whose inputs have changed.

use super::geometry::Geometry;
use super::renderer::ViewCallback;
use crate::engine::Shape;
use crate::picture::layers::looks::Gap;
use crate::picture::layers::{Ghost, Layer};
use crate::picture::palette::{Palette, Theme};
use crate::picture::ramp::Bar;
use crate::picture::{Color, Layers, Silhouette, Subject, Weave};
use crate::studio::canvas::{Canvas, Plushie};
use crate::studio::session::{Selection, Session, Views};
use eframe::egui::Ui;
use std::sync::Arc;

/// The drawing of a view, and what it was made from.
#[derive(Default)]
pub struct Picture {
    layers: Layers,
    /// Of each layer.
    parts: Vec<Arc<Geometry>>,
}

impl Picture {
    /// Draws the view, and says what its colours stand for.
    pub fn paint(&mut self, ui: &Ui, canvas: &Canvas<'_>, drawn: &Drawn<'_>) -> Option<Bar> {
        let ghosts = ghosts(canvas.session, drawn);
        let layers = Layers::of(&subject(canvas.session, drawn, &ghosts));
        let bar = layers.bar().cloned();
        if !canvas.session.gpu {
            return bar;
        }
        let nothing = Geometry::default();
        let part = |layer: usize| {
            let before = layers.same_in(layer, &self.layers).and_then(|before| self.parts.get(before));
            let cloth = self.parts.get(layer).map(Arc::as_ref).unwrap_or(&nothing);
            before.cloned().unwrap_or_else(|| Arc::new(Geometry::after(&layers.scene_of(layer), cloth)))
        };
        self.parts = (0..layers.count()).map(part).collect();
        self.layers = layers;
        let (slot, size) = (drawn.plushie as u64, canvas.rect.size());
        let callback = ViewCallback { slot, camera: canvas.camera, size, parts: self.parts.clone() };
        ui.painter().add(egui_wgpu::Callback::new_paint_callback(canvas.rect, callback));
        bar
    }
}

/// What there is to draw in a view.
pub struct Drawn<'a> {
    pub plushie: Plushie,
    pub shape: &'a Arc<Shape>,
    /// That of the other plushie, where it is shown too.
    pub beside: Option<&'a Arc<Shape>>,
    pub body: (&'a Arc<Silhouette>, &'a Arc<Weave>),
}

/// Outlines over the body: of neighbouring keyframes, and of the idealized plushie in an overlay.
fn ghosts(session: &Session, drawn: &Drawn<'_>) -> Vec<Ghost> {
    let look = session.look();
    let mut ghosts = Vec::new();
    if drawn.plushie == Plushie::Realizable && look.onion.on {
        let (before, after) = match look.theme {
            Theme::Light => (Color(40, 96, 190, 255), Color(206, 96, 8, 255)),
            Theme::Dark => (Color(120, 176, 255, 255), Color(255, 166, 84, 255)),
        };
        let both = look.onion.shapes.iter().zip([before, after]);
        ghosts.extend(both.filter_map(|(shape, color)| Some(Ghost { shape: shape.clone()?, color })));
    }
    // The gap is such an outline already, in colours.
    let overlaid = look.views == Views::Overlay && look.body != Gap::NAME;
    if let Some(shape) = drawn.beside.filter(|_| overlaid) {
        ghosts.push(Ghost { shape: Arc::clone(shape), color: Palette::of(look.theme).target });
    }
    ghosts
}

/// What the view of a plushie is a picture of.
fn subject<'a>(session: &'a Session, drawn: &Drawn<'a>, ghosts: &'a [Ghost]) -> Subject<'a> {
    let selected_target = match session.picked.selection {
        Selection::Target(index) => Some(index),
        _ => None,
    };
    let proposal = session.displayed_proposal();
    let idealized = drawn.plushie == Plushie::Idealized;
    Subject {
        fibers: idealized,
        theme: session.look.theme,
        shown: &session.look.shown,
        texture: session.texture(),
        targets: session.targets(),
        selected_target,
        proposed: proposal.filter(|_| !idealized).map(|proposal| &proposal.network),
        stage: proposal
            .filter(|_| idealized)
            .and_then(|proposal| Some((session.discovery.stage, &proposal.paper.as_ref()?.1))),
        look: session.look.body,
        beside: drawn.beside,
        ghosts,
        ..Subject::with(session.acting(), drawn.body, drawn.shape)
    }
}
