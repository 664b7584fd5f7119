//! The length of a Newton step.

use super::shifted_newton::ShiftedNewton;
use super::workspace::norm;
use crate::physics::model::Model;

/// Armijo: the part of the predicted decrease that must be met.
const SUFFICIENT_DECREASE: f64 = 1e-4;
/// Halvings before a step counts as failed: a factor of about 1e-12.
const MAX_HALVINGS: usize = 40;
/// A step capped below this leads nowhere: triangles have collapsed against the edge of the material's domain.
const SMALLEST_STEP: f64 = 1e-12;
/// Relative rounding of an energy sum: differences below it say nothing.
const ENERGY_ROUNDING: f64 = 1e-13;
/// There a step must leave at most this part of the residual, or rounding is all that is left of it.
const STILL_FALLING: f64 = 0.7;

/// A step from a state.
pub(super) struct Line<'a> {
    pub x: &'a [f64],
    pub step: &'a [f64],
    /// Gradient and energy at `x`, and the largest unbalanced force.
    pub gradient: &'a [f64],
    pub energy: f64,
    pub residual: f64,
}

/// What became of a step.
pub(super) enum Found {
    Step {
        length: f64,
        energy: f64,
    },
    /// No part of it lowers the energy.
    Nothing,
    Cancelled,
}

impl Line<'_> {
    /// Halves the step, capped before inversion, until the energy falls enough; the state there is left in `trial`. Where the
    /// search is slow, `shifted` takes out of each what is wrong to second order.
    pub fn search(
        &self,
        model: &mut Model,
        mut shifted: Option<&mut ShiftedNewton>,
        trial: &mut [f64],
        trial_gradient: &mut [f64],
        cancel: &dyn Fn() -> bool,
    ) -> Found {
        let slope: f64 = self.gradient.iter().zip(self.step).map(|(g, s)| g * s).sum();
        let mut t = model.step_limit(self.x, self.step);
        let halvings = if t < SMALLEST_STEP { 0 } else { MAX_HALVINGS };
        for _ in 0..halvings {
            for ((p, x), s) in trial.iter_mut().zip(self.x).zip(self.step) {
                *p = x + t * s;
            }
            let mut energy = model.energy(trial);
            if let Some(shifted) = &mut shifted {
                if cancel() {
                    return Found::Cancelled;
                }
                energy = shifted.correct(model, self.gradient, t, trial, energy);
            }
            if energy <= self.energy + SUFFICIENT_DECREASE * t * slope && slope < 0.0 {
                return Found::Step { length: t, energy };
            }
            if energy.is_finite() && (t * slope).abs() <= ENERGY_ROUNDING * energy_scale(model, self.energy) {
                // Energies no longer tell states apart; forces still do.
                model.gradient(trial, trial_gradient);
                let falling = norm(trial_gradient) <= STILL_FALLING * self.residual;
                return if falling { Found::Step { length: t, energy } } else { Found::Nothing };
            }
            t *= 0.5;
        }
        Found::Nothing
    }
}

/// The magnitude whose rounding an energy difference carries: the sum itself, or the body at unit strain where the sum
/// nearly vanishes.
fn energy_scale(model: &Model, energy: f64) -> f64 {
    energy.abs().max(model.body.material().shear_modulus() * model.body.area())
}
