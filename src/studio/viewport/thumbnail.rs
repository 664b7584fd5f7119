//! The stages of a discovery as small pictures, like the paper's fig. 6.

use super::geometry::Geometry;
use super::renderer::ViewCallback;
use crate::design::Design;
use crate::engine::Shape;
use crate::outline::polygon;
use crate::picture::layers::{Layer, Pins};
use crate::picture::palette::Theme;
use crate::picture::{Layers, Shown, Silhouette, Stage, Subject, Weave};
use crate::rigging::Proposal;
use crate::studio::canvas::Camera;
use crate::studio::session::Session;
use eframe::egui::{Rect, Ui};
use std::sync::Arc;

/// Lines and discs are this much thinner than in a view.
const THINNER: f32 = 0.5;
/// Slots of the renderer, clear of those of the views.
const FIRST_SLOT: u64 = 16;

/// Pictures of the proposal that is shown.
#[derive(Default)]
pub struct Thumbnails {
    made: Option<Made>,
}

struct Made {
    // Kept alive, so that equal addresses mean equal things.
    design: Arc<Design>,
    proposal: Arc<Proposal>,
    theme: Theme,
    pictures: [Arc<Geometry>; 4],
}

impl Thumbnails {
    /// Draws a stage of the shown proposal into `rect`.
    pub fn paint(&mut self, ui: &Ui, session: &Session, stage: Stage, rect: Rect) {
        let Some(proposal) = session.shown_proposal() else { return };
        let (design, theme) = (session.design(), session.look().theme);
        let fresh = self.made.as_ref().is_some_and(|made| {
            Arc::ptr_eq(&made.design, design) && Arc::ptr_eq(&made.proposal, proposal) && made.theme == theme
        });
        if !fresh {
            let body = (&Arc::new(Silhouette::of(design)), &Arc::new(Weave::of(design)));
            let pictures = Stage::ALL.map(|stage| Arc::new(picture(design, body, proposal, theme, stage)));
            self.made = Some(Made { design: design.clone(), proposal: proposal.clone(), theme, pictures });
        }
        let Some(made) = &self.made else { return };
        let (low, high) = polygon::bounding_box(&design.mesh.nodes);
        let callback = ViewCallback {
            slot: FIRST_SLOT + stage as u64,
            camera: Camera::fit(low, high, rect.size()),
            size: rect.size(),
            parts: vec![made.pictures[stage as usize].clone()],
        };
        ui.painter().add(egui_wgpu::Callback::new_paint_callback(rect, callback));
    }
}

/// The rest shape with the stage on it.
fn picture(
    design: &Arc<Design>,
    body: (&Arc<Silhouette>, &Arc<Weave>),
    proposal: &Proposal,
    theme: Theme,
    stage: Stage,
) -> Geometry {
    let rest = Arc::new(Shape { nodes: design.mesh.nodes.clone(), ..Shape::default() });
    let shown = Shown::default().with(Pins::NAME, false);
    let stage = proposal.paper.as_ref().map(|(_, stages)| (stage, stages));
    let subject = Subject { theme, shown: &shown, stage, ..Subject::with(design, body, &rest) };
    let mut geometry = Geometry::of(&Layers::of(&subject).scene());
    for capsule in &mut geometry.capsules {
        capsule.radius *= THINNER;
        capsule.inner *= THINNER;
    }
    geometry
}
