//! Fits improved step by step, for all poses or the worst, and wound from rest.

use super::local::{Local, Sample, cost};
use super::task::{Fit, Task};

/// First and last damping, relative to the curvature; it grows by the second factor after a bad step, and falls by the third
/// after a good one.
const DAMPING: [f64; 2] = [1e-2, 1e4];
const HARDER: f64 = 6.0;
const EASIER: f64 = 0.3;
/// Damping that is as good as none.
const LEAST_DAMPING: f64 = 1e-6;
/// A step that leaves more than this part of the cost was the last.
const WORTHWHILE: f64 = 0.999;
/// Steps of improvement in another mesh.
const TRANSFER_STEPS: usize = 15;
/// Steps from rest in which an answer is wound, and by how much `C` may differ there.
const WINDING_STEPS: usize = 6;
const SAME_STATE: f64 = 1.02;
/// A violation below this is within the margins that the search keeps.
pub(in crate::rigging) const KEPT: f64 = 1e-5;
/// Power of the misses at the end, where nearly the worst pose alone counts.
const SHARP: f64 = 5.0;

impl Task<'_> {
    /// Improves a fit by at most so many steps; `frozen` leaves the points where they are.
    pub fn improve(&self, fit: Fit, steps: usize, frozen: bool, stop: &dyn Fn() -> bool) -> Fit {
        let Some(built) = self.build(&fit.layout) else { return fit };
        let mut improved = improved_together(vec![Sample { task: self, fit, built, weight: 1.0 }], steps, frozen, stop);
        improved.swap_remove(0).fit
    }

    /// The same layout with every pose wound from rest in proportion: what a real plushie does. Poses that end elsewhere are
    /// improved from there.
    pub fn wound(&self, fit: Fit, steps: usize, stop: &dyn Fn() -> bool) -> Option<Fit> {
        let wound = self.wind(&fit, stop)?;
        if wound.cost <= SAME_STATE * fit.cost || steps == 0 {
            return Some(wound);
        }
        let improved = self.improve(wound, steps, false, stop);
        self.wound(improved, 0, stop)
    }

    /// A fit's layout with every pose wound from rest to the fit's activations; `None` where one does not settle, or others are served here.
    fn wind(&self, fit: &Fit, stop: &dyn Fn() -> bool) -> Option<Fit> {
        if fit.served != self.served {
            return None;
        }
        let mut built = self.build(&fit.layout)?;
        let rest = built.plushie.model.rest.clone();
        let mut poses = Vec::with_capacity(fit.poses.len());
        for (k, posture) in fit.poses.iter().enumerate() {
            let mut beta = posture.beta.clone();
            built.actuation.clamp(&mut beta);
            let mut question = built.question(k);
            let zero = question.settle(&vec![0.0; beta.len()], &rest, stop).0;
            let wound = question.wind(&zero, &beta, WINDING_STEPS, stop).0;
            if !wound.in_equilibrium() {
                return None;
            }
            poses.push(wound);
        }
        Some(self.judged(fit.layout.clone(), &built, poses))
    }

    /// A fit of the same body in another mesh: wound from rest to its activations, and improved from there.
    pub fn transferred(&self, fit: &Fit, stop: &dyn Fn() -> bool) -> Option<Fit> {
        let begun = self.wind(fit, stop)?;
        self.wound(self.improve(begun, TRANSFER_STEPS, false, stop), TRANSFER_STEPS, stop)
    }

    /// A fit improved for its worst pose, at the others' expense; as it was where that gains nothing.
    pub fn sharpened(&self, fit: Fit, steps: usize, stop: &dyn Fn() -> bool) -> Fit {
        let whole = fit.misses.iter().fold(f64::MIN_POSITIVE, |m, f| m.max(*f));
        let sharp = Task {
            poses: self.poses.clone(),
            served: self.served.clone(),
            rings: self.rings.clone(),
            power: SHARP,
            whole,
            ..*self
        };
        let improved = || {
            let begun = sharp.resume(fit.layout.clone(), &fit, stop)?;
            sharp.wound(sharp.improve(begun, steps, false, stop), 0, stop)
        };
        let allowed = fit.violation.max(KEPT);
        improved().filter(|new| new.compare(&fit).is_lt() && new.violation <= allowed).unwrap_or(fit)
    }
}

/// Fits whose layouts are moved alike, improved together by at most so many steps.
pub(super) fn improved_together<'t>(
    mut now: Vec<Sample<'t>>,
    steps: usize,
    frozen: bool,
    stop: &dyn Fn() -> bool,
) -> Vec<Sample<'t>> {
    let mut damping = DAMPING[0];
    for _ in 0..steps {
        let Some(local) = Local::new(&mut now, frozen) else { break };
        let before = cost(&now);
        let mut better = None;
        while damping < DAMPING[1] && better.is_none() && !stop() {
            better = local.trial(&mut now, damping, stop);
            damping *= if better.is_some() { EASIER } else { HARDER };
        }
        let Some(next) = better else { break };
        now = next;
        damping = damping.max(LEAST_DAMPING);
        if cost(&now) > WORTHWHILE * before {
            break;
        }
    }
    now
}
