//! What is asked of the solver, and what it answers. The newest question wins; the last good shapes stay.

use super::session::{Mode, Session};
use crate::design::{Design, animation};
use crate::engine::{Question, Request, Shape};
use std::sync::Arc;

/// Asked of the worker last.
pub(super) struct Asked {
    pub(super) id: u64,
    pub(super) design: Arc<Design>,
    pub(super) question: Question,
}

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
        let warning = |shape: &Option<Shape>| shape.as_ref().and_then(|s| s.warning.clone());
        self.warning = warning(&outcome.realizable).or_else(|| warning(&outcome.idealized));
        self.answered_id = Some(outcome.id);
        if let Some(shape) = outcome.idealized.filter(fits) {
            self.shapes.idealized = Some(Arc::new(shape));
        }
        if let Some(shape) = outcome.realizable.filter(fits) {
            self.shapes.realizable = Some(Arc::new(shape));
        }
    }

    /// Submits what should be seen, if that is not what was asked last.
    pub(super) fn ask(&mut self) {
        let design = self.design().clone();
        let question = match self.mode {
            Mode::Pose => Question::Targets(self.targets().to_vec()),
            Mode::Animation => Question::Activations(animation::activations_at(&design, self.playback.time_s)),
        };
        if let Some(asked) = &self.asked
            && asked.id >= self.first_id
            && Arc::ptr_eq(&asked.design, &design)
            && same(&asked.question, &question)
        {
            return;
        }
        let id = self.asked.as_ref().map_or(0, |asked| asked.id + 1);
        self.worker.submit(Request {
            id,
            design: design.clone(),
            question: question.clone(),
            show_idealized: true,
            show_realizable: true,
        });
        self.asked = Some(Asked { id, design, question });
    }
}

fn same(a: &Question, b: &Question) -> bool {
    match (a, b) {
        (Question::Targets(a), Question::Targets(b)) => a == b,
        (Question::Activations(a), Question::Activations(b)) => a == b,
        _ => false,
    }
}
