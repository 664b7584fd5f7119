//! What is asked of the solver, and what it answers. The newest question wins; the last good shapes stay.

use super::canvas::Plushie;
use super::session::{Mode, Session};
use crate::design::animation;
use crate::engine::{NEAR_EQUILIBRIUM, Question, Request, Shape};
use std::sync::Arc;

impl Session {
    pub(super) fn take_outcome(&mut self) {
        let Some(outcome) = self.worker.take() else { return };
        if outcome.id < self.first_id {
            return;
        }
        let nodes = self.design().mesh.nodes.len();
        let fits = |shape: &Shape| {
            shape.nodes.len() == nodes && shape.nodes.iter().flatten().all(|coordinate| coordinate.is_finite())
        };
        let warning = |shape: &Option<Shape>| {
            let shape = shape.as_ref()?;
            shape.warning.clone().filter(|warning| !(warning.passes() && is_on_its_way(shape)))
        };
        let said = warning(&outcome.realizable).or_else(|| warning(&outcome.idealized));
        self.warning = said.map(|warning| warning.to_string());
        self.answered_id = Some(outcome.id);
        let refined = outcome.refined;
        for (slot, new) in [
            (&mut self.shapes.idealized, outcome.idealized.filter(fits)),
            (&mut self.shapes.realizable, outcome.realizable.filter(fits)),
        ] {
            let Some(mut shape) = new else { continue };
            if let Some(frame) = slot.as_ref().filter(|_| refined) {
                // What is told is what a frame takes, not what it took to refine the last one.
                shape.milliseconds = frame.milliseconds;
            }
            *slot = Some(Arc::new(shape));
        }
    }

    /// Submits what should be seen, if that is not what was asked last.
    pub(super) fn ask(&mut self) {
        let design = self.design().clone();
        let question = match self.mode {
            Mode::Pose => Question::Targets(self.targets().to_vec()),
            Mode::Animation => Question::Activations(animation::activations_at(&design, self.playback.time_s)),
        };
        let request = Request {
            id: self.asked.as_ref().map_or(0, |asked| asked.id + 1),
            design,
            question,
            quality: self.quality,
            show_idealized: self.look.views.shows(Plushie::Idealized),
            show_realizable: self.look.views.shows(Plushie::Realizable),
        };
        if self.asked.as_ref().is_some_and(|asked| asked.id >= self.first_id && same(asked, &request)) {
            return;
        }
        self.worker.submit(request.clone());
        self.asked = Some(request);
    }
}

/// Whether a shape only waits for a hand to rest: near equilibrium, which the figures say, and about to be refined.
fn is_on_its_way(shape: &Shape) -> bool {
    !shape.converged && shape.residual > 0.0 && shape.distance_from_equilibrium() < NEAR_EQUILIBRIUM
}

/// Whether two requests have the same answer.
fn same(a: &Request, b: &Request) -> bool {
    Arc::ptr_eq(&a.design, &b.design)
        && same_question(&a.question, &b.question)
        && (a.quality, a.show_idealized, a.show_realizable) == (b.quality, b.show_idealized, b.show_realizable)
}

fn same_question(a: &Question, b: &Question) -> bool {
    match (a, b) {
        (Question::Targets(a), Question::Targets(b)) => a == b,
        (Question::Activations(a), Question::Activations(b)) => a == b,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_shape_far_from_equilibrium_is_worth_a_warning() {
        let shape =
            |residual: f64, converged: bool| Shape { residual, converged, force_scale: 1.0, ..Shape::default() };
        assert!(is_on_its_way(&shape(1e-5, false)));
        // Far off; a body that was not solved at all; a settled one whose warning is about something else.
        for said in [shape(0.5, false), shape(0.0, false), shape(1e-12, true)] {
            assert!(!is_on_its_way(&said));
        }
    }
}
