//! What a view shows, made anew only when the inputs of one of its layers have changed.

use super::geometry::Geometry;
use super::renderer::ViewCallback;
use crate::engine::Shape;
use crate::picture::{Layers, Subject};
use crate::studio::canvas::{Canvas, Plushie};
use crate::studio::session::{Selection, Session};
use eframe::egui::Ui;
use std::sync::Arc;

/// The drawing of a view, and what it was made from.
#[derive(Default)]
pub struct Picture {
    made: Option<(Layers, Arc<Geometry>)>,
}

impl Picture {
    pub fn paint(&mut self, ui: &Ui, canvas: &Canvas<'_>, plushie: Plushie, shape: &Arc<Shape>) {
        let layers = Layers::of(&subject(canvas.session, plushie, shape));
        let geometry = match &self.made {
            Some((before, geometry)) if *before == layers => geometry.clone(),
            _ => {
                let geometry = Arc::new(Geometry::of(&layers.scene()));
                self.made = Some((layers, geometry.clone()));
                geometry
            }
        };
        let (slot, size) = (plushie as u64, canvas.rect.size());
        let callback = ViewCallback { slot, camera: canvas.camera, size, geometry };
        ui.painter().add(egui_wgpu::Callback::new_paint_callback(canvas.rect, callback));
    }
}

/// What the view of a plushie is a picture of.
fn subject<'a>(session: &'a Session, plushie: Plushie, shape: &'a Arc<Shape>) -> Subject<'a> {
    let selected_target = match session.picked.selection {
        Selection::Target(index) => Some(index),
        _ => None,
    };
    let proposal = session.displayed_proposal();
    let idealized = plushie == Plushie::Idealized;
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
        ..Subject::new(session.acting(), shape)
    }
}
