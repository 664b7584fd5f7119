//! The default: chooses and combines the methods.
//!
//! Fibres (every winch one element) in a drag: the all-at-once method in tension space, whose objective is the drag's.
//! Else, where there are many, and for many winches of any kind: Newton's method in contraction space from several starts
//! (`super::fibers`). Few winches leave real local minima: a look at the states that winding reaches ([`winding`]), and
//! Newton's method at the end.

use super::newton::Newton;
use super::{Answer, Budget, Method, Posture, Question, fibers, winding};

/// Up to this many free winches of one element each are treated as winches.
const FEW: usize = 4;
/// Up to this many winches of several elements their wound states can be looked at.
const FEW_WINCHES: usize = 12;

/// Solves from rest: the activation start given (clamped), several others, the best answer.
pub fn solve(question: &mut Question, beta_start: &[f64], budget: &Budget) -> Answer {
    let rest = question.model.rest.clone();
    let mut beta = beta_start.to_vec();
    question.actuation.clamp(&mut beta);
    let (start, factorizations) = question.settle(&beta, &rest, budget.stop);
    let mut answer = Default.solve(question, &start, budget);
    answer.factorizations += factorizations;
    answer
}

pub struct Default;

impl Method for Default {
    fn name(&self) -> &'static str {
        "default"
    }

    fn solve(&self, question: &mut Question, start: &Posture, budget: &Budget) -> Answer {
        let count = question.actuation.winches.len();
        let single = question.actuation.is_fibers_only();
        let own_objective = question.objective.tension_weight == 0.0;
        let few = count <= if single { FEW } else { FEW_WINCHES };
        if !few && own_objective {
            return fibers::solve(question, start, budget);
        }
        if !few && single {
            return fibers::least_tense(question, start, budget);
        }
        let mut best = winding::least(question, start, budget);
        if own_objective && !(budget.stop)() {
            let from = best.posture.clone();
            best.absorb(Newton::default().solve(question, &from, budget));
        }
        best
    }
}
