//! Newton's method.

use super::line_search::{Found, Line};
use super::reuse::Reuse;
use super::shifted_newton::ShiftedNewton;
use super::state::{Cause, Progress, StaticsSettings};
use super::workspace::{Workspace, norm};
use crate::physics::energy::HessianForm;
use crate::physics::model::Model;

/// Newton steps after which a search counts as slow, and more is done in each ([`ShiftedNewton`]).
const SLOW: usize = 15;
/// A Newton step that leaves at most this part of the residual is followed by steps with the same factor, each of which must
/// leave at most `REUSED` of it: Newton's method squares the part that is left, these steps about double it.
const CONTRACTING: f64 = 0.03;
const REUSED: f64 = 0.1;
/// At the slowest rate these leave 1e-8 of the residual, and one more Newton step does the rest.
const MAX_REUSES: usize = 8;
/// A triangle of less than this part of its area is flat: that takes stresses of a thousand shear moduli.
const FLAT: f64 = 1e-5;
/// A residual below this part of what a change in the sixth digit of the coordinates does is rounding: five units in the last
/// place.
const RESOLVED: f64 = 1e-9;

/// Newton's method on the model as it is.
pub(super) fn newton(
    model: &mut Model,
    x: &mut [f64],
    settings: &StaticsSettings,
    cancel: &dyn Fn() -> bool,
    work: &mut Workspace,
) -> Progress {
    let n = model.dimension();
    let Workspace { gradient, step, trial, trial_gradient, forces, rounding } = work;
    for buffer in [&mut *gradient, step, trial, trial_gradient, forces, rounding] {
        buffer.resize(n, 0.0);
    }
    let mut energy = valid_energy(model, x);
    model.gradient(x, gradient);
    let mut state = Progress { energy, residual: norm(gradient), ..Progress::default() };
    if !energy.is_finite() {
        return Progress { cause: Some(Cause::InvalidStart), ..state };
    }
    let mut shifted = ShiftedNewton::new(model);
    loop {
        state.energy = energy;
        state.residual = norm(gradient);
        let at_work = model.scales_into(x, forces, rounding);
        if model.is_pulled_away(gradient, forces) {
            return Progress { cause: Some(Cause::FreeToMove), ..state };
        }
        let most = settings.tolerance * at_work;
        let balanced = gradient.iter().zip(rounding.iter()).all(|(g, r)| g.abs() <= most + RESOLVED * r);
        state.force_scale = forces.iter().zip(rounding.iter()).map(|(f, r)| f + r).fold(0.0, f64::max);
        let settled = state.residual <= settings.stagnation_tolerance * state.force_scale;
        let unsettled = |cause: Cause| if settled { None } else { Some(cause) };
        if balanced {
            return state;
        }
        if state.iterations >= settings.max_iterations {
            return Progress { cause: unsettled(Cause::Iterations), ..state };
        }
        if cancel() {
            return Progress { cause: Some(Cause::Cancelled), ..state };
        }
        state.iterations += 1;
        let slow = state.iterations > SLOW;
        let factors = if slow { shifted.factorize(model, x, cancel) } else { factorize(model, x, cancel) };
        let Some((form, factors)) = factors else {
            let cause = if cancel() { Cause::Cancelled } else { Cause::Factorization };
            return Progress { cause: Some(cause), ..state };
        };
        state.factorizations += factors;
        state.projections += (form == HessianForm::Projected) as usize;
        for (s, g) in step.iter_mut().zip(gradient.iter()) {
            *s = -g;
        }
        model.solve(step);
        let line = Line { x, step, gradient, energy, residual: state.residual };
        let t = match line.search(model, slow.then_some(&mut shifted), trial, trial_gradient, cancel) {
            Found::Step { length, energy: there } => {
                energy = there;
                length
            }
            Found::Cancelled => return Progress { cause: Some(Cause::Cancelled), ..state },
            Found::Nothing => return Progress { cause: unsettled(stalled(model, x)), ..state },
        };
        shifted.learn(t);
        x.copy_from_slice(trial);
        model.gradient(x, gradient);
        // Where the Hessian hardly changes any more, a solve does what would take a factorisation.
        let quick = !slow && t == 1.0 && form == HessianForm::Exact && norm(gradient) <= CONTRACTING * state.residual;
        let reuse = Reuse { enough: settings.tolerance * state.force_scale, left: REUSED, steps: MAX_REUSES };
        if quick && reuse.steps(model, x, [&mut *gradient, step, trial, trial_gradient]) > 0 {
            energy = model.energy(x);
        }
    }
}

/// The exact Hessian or the projected one, and the number of factorisations that took.
fn factorize(model: &mut Model, x: &[f64], cancel: &dyn Fn() -> bool) -> Option<(HessianForm, usize)> {
    if model.factorize(x, HessianForm::Exact).is_ok() {
        return Some((HessianForm::Exact, 1));
    }
    let projected = !cancel() && model.factorize_projected(x).is_ok();
    projected.then_some((HessianForm::Projected, 2))
}

fn valid_energy(model: &Model, x: &[f64]) -> f64 {
    if x.iter().all(|v| v.is_finite()) { model.energy(x) } else { f64::INFINITY }
}

/// Why no step leads on: where a triangle is pressed flat, rounding of its corners is all that its forces depend on.
fn stalled(model: &Model, x: &[f64]) -> Cause {
    if model.body.smallest_determinant(x) < FLAT { Cause::Collapsed } else { Cause::Stalled }
}
