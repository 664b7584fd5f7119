//! Shifted Newton steps with a second-order correction, where Newton's method is slow: ordinary bodies do not need them, and do not
//! pay for them.
//!
//! **Negative curvature.** The projected Hessian is too stiff wherever the exact one has a little negative curvature, and crosses such a region in
//! hundreds of equal steps. The exact one plus the smallest shift that makes it positive definite goes along that curvature in
//! a few.
//!
//! **Curved valleys.** A pendulum of stuffing swings freely but does not stretch. A step along its tangent is right to first order;
//! to second order it stretches, the stress stiffens the swing, and the next step is short (the Maratos effect of constrained
//! optimisation). A correction with the same factor, `-H^-1 [g(x + t s) - (1 - t) g(x)]`, takes the stretch away before the
//! step is judged.

use crate::physics::energy::HessianForm;
use crate::physics::model::Model;

/// Shift of the exact Hessian at first and at least, in shear moduli; from try to try; tries.
const FIRST_SHIFT: f64 = 1e-3;
const LEAST_SHIFT: f64 = 1e-9;
const GROWTH: f64 = 6.0;
const TRIES: usize = 12;
/// A step of at least this length lets the shift shrink; shorter ones let it grow.
const GOOD_STEP: f64 = 0.5;
/// Corrections of a step at most.
const CORRECTIONS: usize = 3;

/// State between the steps of one search.
pub(super) struct ShiftedNewton {
    shift: f64,
    least: f64,
    /// Empty until the search is slow.
    correction: Vec<f64>,
    corrected: Vec<f64>,
}

impl ShiftedNewton {
    pub fn new(model: &Model) -> Self {
        let mu = model.body.material().shear_modulus();
        Self { shift: FIRST_SHIFT * mu, least: LEAST_SHIFT * mu, correction: Vec::new(), corrected: Vec::new() }
    }

    /// The exact Hessian, shifted where it has to be, and the number of factorisations that took. `cancel` is asked between them.
    pub fn factorize(
        &mut self,
        model: &mut Model,
        x: &[f64],
        cancel: &dyn Fn() -> bool,
    ) -> Option<(HessianForm, usize)> {
        if model.factorize(x, HessianForm::Exact).is_ok() {
            return Some((HessianForm::Exact, 1));
        }
        let mut shift = self.shift;
        for tries in 0..TRIES {
            if cancel() {
                return None;
            }
            if model.factorize_shifted(x, HessianForm::Exact, shift).is_ok() {
                self.shift = shift;
                return Some((HessianForm::Projected, 2 + tries));
            }
            shift *= GROWTH;
        }
        let projected = !cancel() && model.factorize_projected(x).is_ok();
        projected.then_some((HessianForm::Projected, TRIES + 2))
    }

    /// Takes out of the step of length `t` to `trial` what is wrong with it to second order, as far as that lowers its energy,
    /// which is returned. `gradient` is that of where the step begins, whose Hessian must be factorised.
    pub fn correct(&mut self, model: &mut Model, gradient: &[f64], t: f64, trial: &mut [f64], energy: f64) -> f64 {
        self.correction.resize(trial.len(), 0.0);
        self.corrected.resize(trial.len(), 0.0);
        let mut best = energy;
        for _ in 0..CORRECTIONS {
            if !best.is_finite() {
                break;
            }
            model.gradient(trial, &mut self.correction);
            for (c, g) in self.correction.iter_mut().zip(gradient) {
                *c = (1.0 - t) * g - *c;
            }
            model.solve(&mut self.correction);
            if model.step_limit(trial, &self.correction) < 1.0 {
                break;
            }
            for ((c, x), d) in self.corrected.iter_mut().zip(trial.iter()).zip(&self.correction) {
                *c = x + d;
            }
            let energy = model.energy(&self.corrected);
            if energy.is_nan() || energy >= best {
                break;
            }
            trial.copy_from_slice(&self.corrected);
            best = energy;
        }
        best
    }

    /// Takes note of the length of an accepted step.
    pub fn learn(&mut self, t: f64) {
        self.shift = if t >= GOOD_STEP { (self.shift / GROWTH).max(self.least) } else { GROWTH.sqrt() * self.shift };
    }
}
