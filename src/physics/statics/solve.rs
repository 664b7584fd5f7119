//! From a start to an equilibrium.

use super::newton::newton;
use super::state::{Cause, Equilibrium, Progress, StaticsError, StaticsSettings};
use super::workspace::Workspace;
use super::{continuation, negative_curvature};
use crate::physics::energy::HessianForm;
use crate::physics::model::Model;

/// States of negative curvature that are left at most.
const SADDLES: usize = 6;

/// Minimises `E` from `start` (from rest where `start` is inverted or not finite). `cancel` is asked at every step.
///
/// On success the model's factor is that of the last Newton step, not of the state returned: refactorise before taking
/// sensitivities.
///
/// # Errors
/// [`StaticsError`] with the best state reached, where forces do not balance.
pub fn solve(
    model: &mut Model,
    start: &[f64],
    settings: &StaticsSettings,
    cancel: &dyn Fn() -> bool,
) -> Result<Equilibrium, Box<StaticsError>> {
    let mut x = start.to_vec();
    let done = settle(model, &mut x, settings, cancel, &mut Workspace::default());
    let state = Equilibrium {
        x,
        energy: done.energy,
        residual: done.residual,
        iterations: done.iterations,
        factorizations: done.factorizations,
        projections: done.projections,
    };
    match done.cause {
        None => Ok(state),
        Some(cause) => Err(Box::new(StaticsError { cause, best: state })),
    }
}

/// [`solve`] in place: `x` becomes the equilibrium, or the best state reached.
pub fn settle(
    model: &mut Model,
    x: &mut [f64],
    settings: &StaticsSettings,
    cancel: &dyn Fn() -> bool,
    work: &mut Workspace,
) -> Progress {
    let done = approach(model, x, settings, cancel, work);
    if done.cause != Some(Cause::InvalidStart) {
        return done;
    }
    x.copy_from_slice(&model.rest);
    approach(model, x, settings, cancel, work)
}

/// From where `x` is.
///
/// Where springs far stiffer than the body are far from their balance, they are first taken as softer ones and stiffened step by
/// step ([`continuation`]); the way there is left again if it ends above the energy of the start.
fn approach(
    model: &mut Model,
    x: &mut [f64],
    settings: &StaticsSettings,
    cancel: &dyn Fn() -> bool,
    work: &mut Workspace,
) -> Progress {
    let mut spent = [0; 3];
    let mut count = |done: &Progress| {
        for (sum, more) in spent.iter_mut().zip([done.iterations, done.factorizations, done.projections]) {
            *sum += more;
        }
    };
    let wanted = continuation::is_wanted(model, x);
    if wanted || continuation::is_bulky(model) {
        let start = x.to_vec();
        if !wanted {
            let most = settings.max_iterations.min(continuation::FIRST_TRY);
            let done = newton(model, x, &StaticsSettings { max_iterations: most, ..*settings }, cancel, work);
            if done.cause != Some(Cause::Iterations) || most == settings.max_iterations {
                return done;
            }
            count(&done);
        }
        let tried = x.to_vec();
        x.copy_from_slice(&start);
        for stage in continuation::stages(model) {
            let kept = continuation::enter(model, stage);
            let done = newton(model, x, &continuation::SETTINGS, cancel, work);
            continuation::leave(model, kept);
            count(&done);
        }
        if model.energy(x) > model.energy(&tried) {
            x.copy_from_slice(&tried);
        }
    }
    let done = newton(model, x, settings, cancel, work);
    count(&done);
    let [iterations, factorizations, projections] = spent;
    Progress { iterations, factorizations, projections, ..done }
}

/// [`solve`], and on from an equilibrium that is not stable: by symmetry Newton's method may end where the energy has negative
/// curvature (a bar that is pressed and does not buckle). From there it goes down to either side.
///
/// # Errors
/// As [`solve`].
pub fn minimum(
    model: &mut Model,
    start: &[f64],
    settings: &StaticsSettings,
    cancel: &dyn Fn() -> bool,
) -> Result<Equilibrium, Box<StaticsError>> {
    let mut state = solve(model, start, settings, cancel)?;
    for _ in 0..SADDLES {
        if cancel() {
            break;
        }
        state.factorizations += 1;
        if model.factorize(&state.x, HessianForm::Exact).is_ok() {
            break;
        }
        let Some(aside) = negative_curvature::step_aside(model, &state.x, cancel) else { break };
        let next = solve(model, &aside, settings, cancel);
        let (next, failed) = match next {
            Ok(next) => (next, None),
            Err(error) => (error.best, Some(error.cause)),
        };
        let counted = Equilibrium {
            iterations: state.iterations + next.iterations,
            factorizations: state.factorizations + next.factorizations,
            projections: state.projections + next.projections,
            ..next
        };
        match failed {
            None => state = counted,
            Some(cause) => return Err(Box::new(StaticsError { cause, best: counted })),
        }
    }
    Ok(state)
}
