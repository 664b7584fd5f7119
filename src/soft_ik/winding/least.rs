//! The equilibrium of least `O` for problem files: on whatever branch, in a few times the work of one Gauss-Newton run.

use super::recruit;
use super::search::{Care, LATTICE, Search};
use crate::soft_ik::contraction::GaussNewton;
use crate::soft_ik::{Answer, Budget, Method, Posture, Question};

/// Walks along lines may take so many times the factorisations of the first run, and all exploring so many times: for one winch,
/// whose range is then covered in all but rare cases, and for two and three.
const WALKING: [f64; 2] = [2.0, 1.5];
const EXPLORING: [f64; 2] = [3.0, 2.5];
/// A run that is done sooner counts as this many factorisations: otherwise a start next to a valley would leave nothing for a
/// look at the others.
const SHORT_RUN: usize = 12;
/// An end is better than the first where `O` is below this part of it: less is the same value.
const BETTER: f64 = 1.0 - 1e-9;

/// Gauss-Newton from the start; then, for up to three winches, a look at the states along lines through their ranges, and
/// Gauss-Newton from the best valleys there, all bounded by a few times the work of the first; for more, from several starts.
pub fn least(question: &mut Question, start: &Posture, budget: &Budget) -> Answer {
    if question.actuation.winches.len() > LATTICE {
        return recruit::from_several(question, start, budget);
    }
    let mut first = GaussNewton::default().solve(question, start, budget);
    if (budget.stop)() || question.actuation.winches.is_empty() {
        return first;
    }
    let work = first.factorizations.max(SHORT_RUN);
    let winches = question.actuation.winches.len();
    let times = |factor: [f64; 2]| (factor[usize::from(winches > 1)] * work as f64) as usize;
    let care = Care { walking: times(WALKING), ..Care::quick(winches) };
    let mut search = Search::new(question, start, care);
    search.offer(&first.posture, true);
    search.advance(question, times(EXPLORING), budget.stop);
    search.hurry();
    let found = search.run(question, budget.stop);
    first.iterations += found.iterations;
    first.factorizations += found.factorizations;
    if found.posture.in_equilibrium() && found.posture.objective < BETTER * first.posture.objective {
        first.posture = found.posture;
        first.converged = found.converged;
    }
    let contractions = question.actuation.contractions(&first.posture.beta);
    question.model.contractile.set_contractions(&contractions);
    first
}
