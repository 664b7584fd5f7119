//! What a view shows, made anew only when something it depends on has changed.

use super::geometry::Geometry;
use super::renderer::ViewCallback;
use super::{Pane, Plushie, solved};
use crate::design::Design;
use crate::engine::Shape;
use crate::picture::palette::Theme;
use crate::picture::scene::{self, Options, Stage};
use crate::picture::{Scene, Texture};
use crate::rigging::Proposal;
use crate::studio::session::{Mode, Selection, Session};
use eframe::egui::Ui;
use std::sync::Arc;

/// Everything a drawing depends on. It keeps what it was made from alive, so that equal addresses mean equal things.
struct Drawn {
    design: Arc<Design>,
    shape: Option<Arc<Shape>>,
    proposal: Option<Arc<Proposal>>,
    texture: Option<Arc<Texture>>,
    options: (Stage, Option<usize>, Mode, Selection, Theme, bool, bool),
}

impl Drawn {
    fn new(session: &Session, plushie: Plushie) -> Self {
        let look = &session.look;
        Self {
            design: session.design().clone(),
            shape: solved(session, plushie).cloned(),
            proposal: session.shown_proposal().cloned(),
            texture: shown_texture(session).cloned(),
            options: (
                session.discovery.stage,
                session.pose,
                session.mode,
                session.selection,
                look.theme,
                look.fibers,
                look.networks,
            ),
        }
    }

    fn same(&self, other: &Self) -> bool {
        fn same<T>(a: &Option<Arc<T>>, b: &Option<Arc<T>>) -> bool {
            a.as_ref().map(Arc::as_ptr) == b.as_ref().map(Arc::as_ptr)
        }
        Arc::ptr_eq(&self.design, &other.design)
            && same(&self.shape, &other.shape)
            && same(&self.proposal, &other.proposal)
            && same(&self.texture, &other.texture)
            && self.options == other.options
    }
}

/// The drawing of a view, and what it was made from.
#[derive(Default)]
pub struct Picture {
    made: Option<(Drawn, Arc<Geometry>)>,
}

impl Picture {
    pub fn paint(&mut self, ui: &Ui, pane: &Pane<'_>, shape: &Shape) {
        let drawn = Drawn::new(pane.session, pane.plushie);
        let geometry = match &self.made {
            Some((before, geometry)) if before.same(&drawn) => geometry.clone(),
            _ => {
                let geometry = Arc::new(Geometry::of(&draw(pane.session, pane.plushie, shape)));
                self.made = Some((drawn, geometry.clone()));
                geometry
            }
        };
        let (slot, size) = (pane.plushie as u64, pane.rect.size());
        let callback = ViewCallback { slot, camera: pane.camera, size, geometry };
        ui.painter().add(egui_wgpu::Callback::new_paint_callback(pane.rect, callback));
    }
}

fn shown_texture(session: &Session) -> Option<&Arc<Texture>> {
    session.texture().filter(|_| session.look.texture)
}

fn draw(session: &Session, plushie: Plushie, shape: &Shape) -> Scene {
    let look = &session.look;
    let selected_target = match session.selection {
        Selection::Target(index) => Some(index),
        _ => None,
    };
    let options = Options {
        theme: look.theme,
        texture: shown_texture(session),
        fibers: look.fibers && plushie == Plushie::Idealized,
        networks: look.networks,
        pins: true,
        targets: session.targets(),
        selected_target,
        stage: None,
    };
    match (plushie, session.shown_proposal()) {
        (Plushie::Idealized, Some(proposal)) => {
            let stage = Some((session.discovery.stage, &proposal.stages));
            scene::scene(session.design(), shape, &Options { stage, ..options })
        }
        (Plushie::Realizable, Some(proposal)) => {
            let mut design = Design::clone(session.design());
            design.networks.push(proposal.network.clone());
            scene::scene(&design, shape, &options)
        }
        _ => scene::scene(session.design(), shape, &options),
    }
}
