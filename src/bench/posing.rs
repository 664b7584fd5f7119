//! What the studies of posing share: starts, converged optima, and what makes a posture fit to be shown.

use super::shapes::Subject;
use super::{Quality, Tracker};
use crate::physics::{Model, statics};
use crate::soft_ik::{Actuation, Posture, Question};

/// Rounds of accurate work on a converged optimum, and the relative decrease of `O` in a round that ends it.
const ROUNDS: usize = 30;
const ROUND_DECREASE: f64 = 1e-6;
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
            if settled.in_equilibrium() && best.as_ref().is_none_or(|b| value < b.objective) {
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
