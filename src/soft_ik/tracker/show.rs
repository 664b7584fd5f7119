//! The pose that a frame shows: the best state of the fibres' run, settled.

use super::Tracker;
use super::fibers::{Fibers, SETTLED, SMALL};
use crate::physics::statics::Reuse;
use crate::physics::{Cause, StaticsSettings, statics};
use crate::soft_ik::{Frame, Quality, Question, Winch};
use std::time::Instant;

/// The pose found from rest is taken where its `O` is at most this factor of that of the pose under the hand: between two poses whose
/// errors differ by less than the root of that, the one to rest in is the one that does not depend on the way there.
const AS_GOOD: f64 = 2.0;
/// The pose of the next frame is taken at most this factor above that of the last: it may be worse by rounding alone.
const NO_WORSE: f64 = 1.0 + 1e-6;
/// What must be reached before a pose is shown, whatever the budget.
const SHOWN: f64 = 1e-3;
/// In large scenes the factor of the iteration settles it, in steps that cost a tenth of a factorisation: to this residual, so
/// that the forces at work may change a little on the way, as long as a step leaves this part of the residual, so many at most.
const SHOWN_WITH_MARGIN: f64 = 0.9e-3;
const STILL_SETTLING: f64 = 0.6;
const REUSES: usize = 6;
/// Newton steps spent on that at most, before the pose of the last frame stays: in small scenes, and in large ones, where the
/// hand would feel them.
const SETTLING_STEPS: usize = 60;
const HASTY_STEPS: usize = 8;

impl Tracker {
    /// Takes the best state of the run, its actuators within their limits, settled: to the end where the budget allows, near
    /// enough in any case. The pose of the last frame stays where it is better, or where the new one does not settle.
    /// Returns `O` of the new pose where that was taken.
    #[allow(clippy::too_many_arguments)]
    pub(super) fn show(
        &mut self,
        question: &mut Question,
        fibers: &mut Fibers,
        pulled: bool,
        quality: Quality,
        budget: usize,
        frame: &mut Frame,
        stop: &dyn Fn() -> bool,
    ) -> Option<f64> {
        let clock = Instant::now();
        let best = &fibers.run.best;
        self.trial.copy_from_slice(&best.x);
        best.activations_into(question, &mut self.along, &mut self.beta);
        question.actuation.contractions_into(&self.beta, &mut self.contractions);
        question.model.contractile.set_contractions(&self.contractions);
        let small = Quality::Balanced.factorizations(self.beta.len()) >= SMALL;
        let whole = small || quality == Quality::Accurate;
        let left = if whole { SETTLING_STEPS } else { budget.saturating_sub(frame.factorizations) };
        let (mut residual, mut scale) = self.statics.forces_at(question.model, &self.trial);
        if left == 0 && residual > SHOWN * scale {
            let reuse = Reuse { enough: SHOWN_WITH_MARGIN * scale, left: STILL_SETTLING, steps: REUSES };
            residual = reuse.settle(question.model, &mut self.trial, &mut self.statics);
        }
        let mut cause = None;
        let mut settle = |tolerance: f64, max_iterations: usize, x: &mut [f64]| {
            let settings = StaticsSettings { tolerance, stagnation_tolerance: tolerance.max(1e-8), max_iterations };
            let done = statics::settle(question.model, x, &settings, stop, &mut self.statics);
            frame.factorizations += done.factorizations;
            cause = done.cause;
            (done.residual, done.force_scale)
        };
        if left > 0 {
            (residual, scale) = settle(SETTLED, left, &mut self.trial);
        }
        if residual > SHOWN * scale {
            (residual, scale) = settle(SHOWN, if whole { SETTLING_STEPS } else { HASTY_STEPS }, &mut self.trial);
        }
        self.force_scale = scale;
        let settled = residual <= SHOWN * scale;
        let squares = self.squares.unwrap_or_else(|| squared_tensions(question, &self.posture.x, &self.posture.beta));
        // They are springs at `beta` now.
        question.model.contractile.tensions_into(&self.trial, &mut self.along);
        let tensions = question.actuation.winches.iter().map(|winch| self.along[winch.members[0].0]);
        let squares_after: f64 = tensions.map(|t| t * t).sum();
        let objective = question.objective;
        let value = |x: &[f64], squares: f64| objective.position_value(x) + 0.5 * objective.tension_weight * squares;
        let (before, after) = (value(&self.posture.x, squares), value(&self.trial, squares_after));
        let margin = if fibers.deciding.is_some() { AS_GOOD } else { NO_WORSE };
        let taken = !self.posture.in_equilibrium() || settled && (pulled || after <= margin * before);
        if taken {
            std::mem::swap(&mut self.posture.x, &mut self.trial);
            std::mem::swap(&mut self.posture.beta, &mut self.beta);
            self.posture.residual = residual;
            self.posture.unsettled = (!settled).then(|| cause.unwrap_or(Cause::Stalled));
        }
        self.posture.objective = if taken { after } else { before };
        self.squares = Some(if taken { squares_after } else { squares });
        fibers.work.phases.line_search += clock.elapsed().as_secs_f64();
        taken.then_some(after)
    }
}

/// The sum of the squared tensions of all free elements, springs at activations `beta`, each of which winds one element.
/// Without allocation.
fn squared_tensions(question: &Question, x: &[f64], beta: &[f64]) -> f64 {
    let elements = &question.model.contractile.elements;
    let tension = |(winch, beta): (&Winch, &f64)| {
        let (element, ratio) = winch.members[0];
        let element = &elements[element];
        element.tension(element.length(x) - element.alpha0 + ratio * beta)
    };
    question.actuation.winches.iter().zip(beta).map(tension).map(|t| t * t).sum()
}
