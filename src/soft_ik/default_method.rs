//! The default: chooses and combines the methods.
//!
//! Fibres (every winch one element): the all-at-once method in tension space gives the answer to the tension-regularised
//! objective; where the question's own objective differs (`lambda`), Gauss-Newton in contraction space ends the work.
//! Winches: Gauss-Newton in contraction space after a look at the states that winding reaches, since few cables leave real local
//! minima ([`winding`]).

use super::contraction::GaussNewton;
use super::tension::AllAtOnce;
use super::winding::{self, absorb};
use super::{Answer, Budget, Method, Posture, Question};

/// Beyond this many free winches the dense Gauss-Newton step (cost ~ winches^3) is not worth its time.
const DENSE_LIMIT: usize = 700;
/// Up to this many free winches of one element each are treated as winches.
const FEW: usize = 4;

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
        let own_objective = question.objective.contraction_weight > 0.0 || question.objective.tension_weight == 0.0;
        let count = question.actuation.winches.len();
        if !question.actuation.is_fibers_only() || count <= FEW {
            return winding::least(question, start, budget);
        }
        let mut best = Answer { posture: start.clone(), iterations: 0, factorizations: 0, converged: false };
        absorb(&mut best, AllAtOnce::default().solve(question, start, budget));
        if !own_objective || count > DENSE_LIMIT {
            return best;
        }
        let from = best.posture.clone();
        absorb(&mut best, GaussNewton::default().solve(question, &from, budget));
        if !(budget.stop)() {
            winding::explore(question, start, &mut best, budget);
        }
        best
    }
}
