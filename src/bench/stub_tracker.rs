//! Stand-in until the tracker lands.
use crate::soft_ik::tension::AllAtOnce;
use crate::soft_ik::{Budget, Method, Posture, Question};

pub use crate::problem::Quality;

pub struct Tracker {
    posture: Posture,
}

pub struct Frame {
    pub iterations: usize,
    pub factorizations: usize,
    pub converged: bool,
    pub residual: f64,
    pub force_scale: f64,
    pub phases: Phases,
}

#[derive(Default)]
pub struct Phases {
    pub assembly: f64,
    pub factorization: f64,
    pub solves: f64,
    pub dual: f64,
    pub line_search: f64,
}

impl Tracker {
    pub fn new(_question: &mut Question, start: &Posture) -> Self {
        Self { posture: start.clone() }
    }

    pub fn frame(&mut self, question: &mut Question, quality: Quality, stop: &dyn Fn() -> bool) -> Frame {
        let budget = Budget { iterations: quality.frame_iterations(), stop };
        let (start, _) = question.settle(&self.posture.beta, &self.posture.x, stop);
        let answer = AllAtOnce::default().solve(question, &start, &budget);
        self.posture = answer.posture;
        Frame {
            iterations: answer.iterations,
            factorizations: answer.factorizations,
            converged: answer.converged,
            residual: self.posture.residual,
            force_scale: question.model.force_scale(&self.posture.x),
            phases: Phases::default(),
        }
    }

    pub fn posture(&self) -> &Posture {
        &self.posture
    }
}
