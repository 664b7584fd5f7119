//! Poses that are kept: everything is tried.

use crate::soft_ik::contraction::GaussNewton;
use crate::soft_ik::winding::{self, Care, Search};
use crate::soft_ik::{self, Answer, Budget, Method, Posture, Quality, Tracker};

/// Iterations of the winches' methods where there is time (checks, rigging).
const THOROUGH_ITERATIONS: usize = 200;

/// Frames of the fibres' solver there, at the finest quality: most poses are done in three.
const THOROUGH_FRAMES: usize = 16;

/// The best state that winding from rest reaches, what the hand has found included where winding leads there.
pub(super) fn wind_from_all(
    question: &mut soft_ik::Question,
    hand: Option<&Posture>,
    zero: &[f64],
    stop: &dyn Fn() -> bool,
) -> Answer {
    let rest = question.model.rest.clone();
    let (rest, mut spent) = question.settle(zero, &rest, stop);
    // A body that can turn freely ends in another position of the same pose each time: there is nothing to prove.
    let proved = question.model.free_pieces() == 0;
    let mut search = Search::new(question, &rest, Care { proved, ..Care::THOROUGH });
    let budget = Budget { iterations: THOROUGH_ITERATIONS, stop };
    if zero.len() > winding::LATTICE {
        let found = winding::from_several(question, &rest, &budget);
        spent += found.factorizations;
        search.offer(&found.posture, found.converged);
    }
    if let Some(hand) = hand {
        let onwards = GaussNewton::default().solve(question, hand, &budget);
        spent += onwards.factorizations;
        search.offer(&onwards.posture, onwards.converged);
        search.offer(hand, false);
    }
    let mut answer = search.run(question, stop);
    if let Some(hand) = hand.filter(|hand| stop() && hand.objective < answer.posture.objective) {
        answer.posture = hand.clone();
        let contractions = question.actuation.contractions(&answer.posture.beta);
        question.model.contractile.set_contractions(&contractions);
    }
    answer.factorizations += spent;
    answer
}

/// The fibres, frame by frame to the end: each ends in equilibrium, so that a state which would snap elsewhere is noticed and
/// left. The best pose on the way counts, and what the hand has found.
pub(super) fn pull_thoroughly(
    question: &mut soft_ik::Question,
    start: &Posture,
    hand: &Posture,
    stop: &dyn Fn() -> bool,
) -> Answer {
    let mut tracker = Tracker::within(question, start, stop);
    let found = if hand.in_equilibrium() && hand.objective < start.objective { hand } else { start };
    let mut best = Answer::at(found);
    for _ in 0..THOROUGH_FRAMES {
        let frame = tracker.frame(question, Quality::Accurate, stop);
        best.iterations += frame.iterations;
        best.factorizations += frame.factorizations;
        let now = tracker.posture();
        if now.in_equilibrium() && (now.objective < best.posture.objective || !best.posture.in_equilibrium()) {
            best.posture = now.clone();
        }
        best.converged = frame.converged;
        if frame.converged || stop() {
            break;
        }
    }
    let contractions = question.actuation.contractions(&best.posture.beta);
    question.model.contractile.set_contractions(&contractions);
    best
}
