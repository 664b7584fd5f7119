//! The equilibrium of least `O` for problem files: on whatever branch, in a few times the work of one Gauss-Newton run.

use super::care::{Care, LATTICE};
use super::recruit;
use super::search::Search;
use crate::soft_ik::contraction::GaussNewton;
use crate::soft_ik::{Answer, Budget, Method, Posture, Question};

/// For one, two and three winches: walks along lines may take so many times the factorisations of the first run, and so many at
/// most. One winch has few states and its range is covered in all but rare cases; more have valleys that are wide enough for a
/// coarse look.
const WALKING: [f64; LATTICE] = [2.0, 1.2, 1.5];
const MOST_WALKING: [usize; LATTICE] = [100, 80, 120];
/// Polishing valleys may take so many times the factorisations of the first run.
const POLISHING: f64 = 0.8;
/// A run that is done sooner counts as this many factorisations: a start next to a valley leaves something for a look at the
/// others.
const SHORT_RUN: usize = 16;
/// What a run from a start that no step leads away from counts as, in factorisations: there the walks are all that may lead to a valley.
const STALLED_RUN: [usize; LATTICE] = [24, 40, 48];
/// Iterations of the first run, before it waits for what the walks find: it may be slow towards a valley that is not the best.
const FIRST_ITERATIONS: usize = 12;
/// An end is better than the first where `O` is below this part of it: less is the same value.
const BETTER: f64 = 1.0 - 1e-9;

/// Gauss-Newton from the start; then, for up to three winches, a look at the states along lines through their ranges, and
/// Gauss-Newton from the best valleys there, all bounded by a few times the work of the first; for more, from several starts.
pub fn least(question: &mut Question, start: &Posture, budget: &Budget) -> Answer {
    if question.actuation.winches.len() > LATTICE {
        return recruit::from_several(question, start, budget);
    }
    let some = Budget { iterations: budget.iterations.min(FIRST_ITERATIONS), stop: budget.stop };
    let mut first = GaussNewton::default().solve(question, start, &some);
    if (budget.stop)() || question.actuation.winches.is_empty() {
        return first;
    }
    let winches = question.actuation.winches.len();
    let stalled = first.posture.objective >= BETTER * start.objective;
    let least = if stalled { STALLED_RUN[winches - 1] } else { SHORT_RUN };
    let work = first.factorizations.max(least) as f64;
    let walking = MOST_WALKING[winches - 1].min((WALKING[winches - 1] * work) as usize);
    let mut search = Search::new(question, start, Care { walking, ..Care::quick(winches) });
    search.offer(&first.posture, first.converged);
    search.advance(question, walking + (POLISHING * work) as usize, budget.stop);
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
