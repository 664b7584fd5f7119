//! Statics: where the plushie comes to rest (minimum of `E`), by an inversion-safe Newton method.
//!
//! The exact Hessian is factorised; only where that fails the projected one takes its place. A step is first capped so that
//! no triangle comes near inversion, then halved until the energy falls enough (Armijo).

use super::energy::HessianForm;
use super::model::Model;

/// Settings of [`solve`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StaticsSettings {
    /// Converged when the largest unbalanced force is below this fraction of the forces at work. 1e-12 is near what
    /// rounding allows; positions are then good to about ten digits.
    pub tolerance: f64,
    /// Where rounding stops progress, a residual below this fraction still counts as converged.
    pub stagnation_tolerance: f64,
    /// Newton steps. Ordinary bodies take fewer than 30; cables a million times stiffer than the body take hundreds.
    pub max_iterations: usize,
}

impl Default for StaticsSettings {
    fn default() -> Self {
        Self { tolerance: 1e-12, stagnation_tolerance: 1e-8, max_iterations: 1000 }
    }
}

/// Armijo: the part of the predicted decrease that must be met.
const SUFFICIENT_DECREASE: f64 = 1e-4;
/// Halvings before a step counts as failed: a factor of about 1e-12.
const MAX_HALVINGS: usize = 40;
/// A step capped below this leads nowhere: triangles have collapsed against the edge of the material's domain.
const SMALLEST_STEP: f64 = 1e-12;
/// Relative rounding of an energy sum: differences below it say nothing.
const ENERGY_ROUNDING: f64 = 1e-13;

/// A converged state.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    pub x: Vec<f64>,
    pub energy: f64,
    /// `max |dE/dx|`.
    pub residual: f64,
    pub iterations: usize,
    pub factorizations: usize,
    /// Iterations in which the Hessian had to be projected.
    pub projections: usize,
}

/// Why statics did not converge; the best state reached comes with it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{cause}")]
pub struct StaticsError {
    pub cause: Cause,
    pub best: Equilibrium,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Cause {
    #[error("the rest state itself is inverted or not finite")]
    InvalidStart,
    #[error("the stiffness matrix could not be factorised, even projected")]
    Factorization,
    #[error("no step lowers the energy any further, and forces are still unbalanced")]
    Stalled,
    #[error("not in equilibrium after the allowed number of Newton steps")]
    Iterations,
    #[error("the body is free to move and is pulled away: add a pin")]
    FreeToMove,
    #[error("cancelled")]
    Cancelled,
}

/// Minimises `E` from `start` (from rest where `start` is inverted or not finite). `cancel` is asked at every step.
///
/// On success the model's factor is that of the last Newton step, not of the state returned: refactorise before taking
/// sensitivities.
pub fn solve(
    model: &mut Model,
    start: &[f64],
    settings: &StaticsSettings,
    cancel: &dyn Fn() -> bool,
) -> Result<Equilibrium, Box<StaticsError>> {
    let n = model.dimension();
    let mut x = start.to_vec();
    let mut energy = valid_energy(model, &x);
    if !energy.is_finite() {
        x = model.rest.clone();
        energy = valid_energy(model, &x);
    }
    let mut gradient = vec![0.0; n];
    let mut step = vec![0.0; n];
    let mut trial = vec![0.0; n];
    let mut trial_gradient = vec![0.0; n];
    model.gradient(&x, &mut gradient);
    let mut state = Equilibrium {
        x: x.clone(),
        energy,
        residual: norm(&gradient),
        iterations: 0,
        factorizations: 0,
        projections: 0,
    };
    let fail = |cause, best| Err(Box::new(StaticsError { cause, best }));
    if !energy.is_finite() {
        return fail(Cause::InvalidStart, state);
    }
    let settled = |residual: f64, scale: f64| residual <= settings.stagnation_tolerance * scale;
    loop {
        let residual = norm(&gradient);
        let scale = model.force_scale(&x);
        state = Equilibrium { x: x.clone(), energy, residual, ..state };
        if residual <= settings.tolerance * scale || residual == 0.0 {
            return Ok(state);
        }
        if state.iterations >= settings.max_iterations {
            return if settled(residual, scale) {
                Ok(state)
            } else {
                fail(unconverged(model, Cause::Iterations), state)
            };
        }
        if cancel() {
            return fail(Cause::Cancelled, state);
        }
        state.iterations += 1;
        state.factorizations += 1;
        match model.factorize_for_descent(&x) {
            Ok(HessianForm::Exact) => {}
            Ok(HessianForm::Projected) => {
                state.factorizations += 1;
                state.projections += 1;
            }
            Err(_) => return fail(Cause::Factorization, state),
        }
        for (s, g) in step.iter_mut().zip(&gradient) {
            *s = -g;
        }
        model.solve(&mut step);
        let slope: f64 = gradient.iter().zip(&step).map(|(g, s)| g * s).sum();
        let mut t = model.step_limit(&x, &step);
        let mut accepted = false;
        let halvings = if t < SMALLEST_STEP { 0 } else { MAX_HALVINGS };
        for _ in 0..halvings {
            for ((p, x), s) in trial.iter_mut().zip(&x).zip(&step) {
                *p = x + t * s;
            }
            let trial_energy = model.energy(&trial);
            if trial_energy <= energy + SUFFICIENT_DECREASE * t * slope && slope < 0.0 {
                accepted = true;
            } else if trial_energy.is_finite() && (t * slope).abs() <= ENERGY_ROUNDING * energy_scale(model, energy) {
                // Energies no longer tell states apart; forces still do.
                model.gradient(&trial, &mut trial_gradient);
                if norm(&trial_gradient) < residual {
                    accepted = true;
                } else {
                    break;
                }
            }
            if accepted {
                energy = trial_energy;
                break;
            }
            t *= 0.5;
        }
        if !accepted {
            return if settled(residual, scale) { Ok(state) } else { fail(unconverged(model, Cause::Stalled), state) };
        }
        std::mem::swap(&mut x, &mut trial);
        model.gradient(&x, &mut gradient);
    }
}

/// `max |v|`, infinite for NaN.
pub fn norm(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |m, a| if a.is_nan() { f64::INFINITY } else { m.max(a.abs()) })
}

fn valid_energy(model: &Model, x: &[f64]) -> f64 {
    if x.iter().all(|v| v.is_finite()) { model.energy(x) } else { f64::INFINITY }
}

/// The magnitude whose rounding an energy difference carries: the sum itself, or the body at unit strain where the sum
/// nearly vanishes.
fn energy_scale(model: &Model, energy: f64) -> f64 {
    energy.abs().max(model.body.material().shear_modulus() * model.body.area())
}

fn unconverged(model: &Model, cause: Cause) -> Cause {
    if model.free_pieces() > 0 { Cause::FreeToMove } else { cause }
}
