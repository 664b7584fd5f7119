//! What the studies of posing share: starts, converged optima, and Algorithm 1 as the baseline.

use super::shapes::Subject;
use super::stub_tracker::{Quality, Tracker};
use crate::physics::{Model, statics};
use crate::soft_ik::gradient::Gradient;
use crate::soft_ik::{Actuation, Budget, Method, Posture, Question};
use std::time::Instant;

/// Rounds of accurate work on a converged optimum, and the relative decrease of `O` in a round that ends it.
const ROUNDS: usize = 30;
const ROUND_DECREASE: f64 = 1e-6;
/// Iterations after which Algorithm 1 gives up on a frame.
pub const BASELINE_ITERATIONS: usize = 200;
/// Target errors count as equal within this part of the body length: some micrometres on a soft toy.
pub const EQUAL_ERROR: f64 = 1e-5;

/// All fibres free, nothing held.
pub fn free_fibers(subject: &Subject) -> Actuation {
    Actuation { winches: subject.plushie.fibers.clone(), fixed: vec![0.0; subject.plushie.fiber_elements.end] }
}

/// Everything at contraction zero, in equilibrium.
pub fn at_rest(question: &mut Question, stop: &dyn Fn() -> bool) -> Posture {
    let rest = question.model.rest.clone();
    let zero = vec![0.0; question.actuation.winches.len()];
    question.settle(&zero, &rest, stop).0
}

/// How far a posture is from the equilibrium of its own activations: the largest unbalanced force over the forces at work.
pub fn distance_from_equilibrium(model: &mut Model, actuation: &Actuation, posture: &Posture) -> f64 {
    model.contractile.set_contractions(&actuation.contractions(&posture.beta));
    let mut gradient = vec![0.0; posture.x.len()];
    model.gradient(&posture.x, &mut gradient);
    statics::norm(&gradient) / model.force_scale(&posture.x).max(f64::MIN_POSITIVE)
}

/// Whether a posture may be shown: finite, and no triangle inverted.
pub fn may_be_shown(model: &Model, posture: &Posture) -> bool {
    posture.x.iter().all(|v| v.is_finite()) && model.body.smallest_determinant(&posture.x) > 0.0
}

/// The best of the optima that accurate work leads to from these starts, each followed until `O` stands still and settled.
pub fn optimum(question: &mut Question, starts: &[&Posture], stop: &dyn Fn() -> bool) -> Option<Posture> {
    let mut best: Option<Posture> = None;
    for start in starts {
        let mut tracker = Tracker::new(question, start);
        let mut last = f64::INFINITY;
        for _ in 0..ROUNDS {
            if stop() {
                return best;
            }
            let frame = tracker.frame(question, Quality::Accurate, stop);
            let posture = tracker.posture().clone();
            let settled = question.settle(&posture.beta, &posture.x, stop).0;
            let value = settled.objective;
            if settled.in_equilibrium && best.as_ref().is_none_or(|b| value < b.objective) {
                best = Some(settled);
            }
            if frame.converged || value > (1.0 - ROUND_DECREASE) * last {
                break;
            }
            last = value;
        }
    }
    best
}

/// What Algorithm 1 needed for one frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Baseline {
    pub milliseconds: f64,
    /// Whether it came as close as asked; if not, the time is a lower bound.
    pub reached: bool,
}

/// Algorithm 1 from the posture before the frame until the rms target error (mm) is at most `error`, with the statics and the
/// factorisation of the other methods. It gives up after [`BASELINE_ITERATIONS`] or `patience_ms`.
///
/// The start is settled for it outside the clock, and iterations that turn out unnecessary are not counted: its iterates are
/// deterministic, so the fewest that suffice are found by repetition.
pub fn algorithm_1(
    question: &mut Question,
    before: &Posture,
    error: f64,
    patience_ms: f64,
    stop: &dyn Fn() -> bool,
) -> Baseline {
    let start = question.settle(&before.beta, &before.x, stop).0;
    let mut attempt = |iterations: usize| -> Baseline {
        let clock = Instant::now();
        let elapsed = || 1e3 * clock.elapsed().as_secs_f64();
        let impatient = || stop() || elapsed() > patience_ms;
        let answer = Gradient::default().solve(question, &start, &Budget { iterations, stop: &impatient });
        let reached = question.objective.target_error(&answer.posture.x) <= error;
        Baseline { milliseconds: elapsed(), reached }
    };
    let whole = attempt(BASELINE_ITERATIONS);
    if !whole.reached {
        return whole;
    }
    let (mut too_few, mut enough, mut found) = (0, BASELINE_ITERATIONS, whole);
    let mut next = 1;
    while enough - too_few > 1 && !stop() {
        let outcome = attempt(next);
        if outcome.reached {
            (enough, found) = (next, outcome);
        } else {
            too_few = next;
        }
        // Doubling until it suffices, halving then.
        next =
            if enough == BASELINE_ITERATIONS { (2 * too_few).max(1).min(enough - 1) } else { (too_few + enough) / 2 };
    }
    found
}
