//! What a method of Soft IK is.

use super::question::{Posture, Question};

/// The outcome of a method, and the work that it took.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    pub posture: Posture,
    pub iterations: usize,
    pub factorizations: usize,
    /// Whether the method's own objective cannot be lowered any more, by its own measure.
    pub converged: bool,
    /// Starts that were followed.
    pub starts: usize,
}

impl Answer {
    /// Nothing done yet.
    pub fn at(posture: &Posture) -> Self {
        Self { posture: posture.clone(), iterations: 0, factorizations: 0, converged: false, starts: 1 }
    }

    /// Takes the better posture and adds up the work.
    pub(super) fn absorb(&mut self, other: Self) {
        self.iterations += other.iterations;
        self.factorizations += other.factorizations;
        if other.posture.objective <= self.posture.objective || !self.posture.in_equilibrium() {
            self.posture = other.posture;
            self.converged = other.converged;
        }
    }
}

/// How long a method may go on.
pub struct Budget<'a> {
    pub iterations: usize,
    /// Asked between factorisations; `true` ends the work with the best posture so far.
    pub stop: &'a dyn Fn() -> bool,
}

/// A way to minimise `O` from a starting posture.
pub trait Method {
    fn name(&self) -> &'static str;
    /// What it minimises: the question's own `O`, where nothing else is said.
    fn objective(&self) -> &'static str {
        "objective"
    }
    fn solve(&self, question: &mut Question, start: &Posture, budget: &Budget) -> Answer;
}
