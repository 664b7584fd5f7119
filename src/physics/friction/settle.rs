//! Where a body with rubbing cables comes to rest.

use super::bordered::Bordered;
use super::{Direction, Friction};
use crate::physics::statics::{self, norm};
use crate::physics::{Cause, HessianForm, Model, StaticsSettings};

/// Newton steps for one part of the friction. From the part before they are fewer than ten; a way that takes more is cut in two.
const MOST_STEPS: usize = 40;
/// The shortest part of the friction that is added at a time: a state that does not follow by then has snapped elsewhere, or there is none.
const SHORTEST_PART: f64 = 1.0 / 64.0;
/// Part of the residual that a step promises and must take away: as for Armijo's rule.
const SUFFICIENT_DECREASE: f64 = 1e-4;
/// Halvings of a step: down to a part in a million, where no state in reach is better balanced.
const MAX_HALVINGS: usize = 20;
/// A residual below this part of what a change in the sixth digit of the coordinates does is rounding, as in statics.
const RESOLVED: f64 = 1e-9;

/// A state in which forces balance under friction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SlidingState {
    pub x: Vec<f64>,
    /// `max |r|`, force.
    pub residual: f64,
    pub iterations: usize,
    pub factorizations: usize,
}

/// Why there is none; the best state reached comes with it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("at {:.0} % of the friction when {}: {fault}", 100.0 * reached.abs(), if *reached < 0.0 { "let out" } else { "pulled" })]
pub struct FrictionError {
    pub fault: Fault,
    /// The part of the friction with which forces balanced last, from -1 (all of it, letting out) to 1 (pulling).
    pub reached: f64,
    /// The state there.
    pub best: SlidingState,
}

/// What kept forces from balancing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    #[error("{0}")]
    Frictionless(Cause),
    #[error("the body has no stiffness left against some motion")]
    Singular,
    #[error("no step balances the forces any better")]
    Stalled,
    #[error("the allowed number of Newton steps was not enough")]
    Iterations,
    #[error("cancelled")]
    Cancelled,
}

/// The equilibrium with friction that continues the one without: that is found first, from `start`, and then friction is added in
/// as few parts as Newton's method follows. Without rubbing cables it is [`statics::solve`].
///
/// # Errors
/// [`FrictionError`] with the part of the friction that was reached.
pub fn settle(
    model: &mut Model,
    friction: &Friction,
    start: &[f64],
    direction: Direction,
    stop: &dyn Fn() -> bool,
) -> Result<SlidingState, Box<FrictionError>> {
    let mut now = match statics::solve(model, start, &StaticsSettings::default(), stop) {
        Ok(state) => SlidingState {
            x: state.x,
            residual: state.residual,
            iterations: state.iterations,
            factorizations: state.factorizations,
        },
        Err(error) => {
            let best = SlidingState { x: error.best.x, residual: error.best.residual, ..SlidingState::default() };
            return Err(Box::new(FrictionError { fault: Fault::Frictionless(error.cause), reached: 0.0, best }));
        }
    };
    if !friction.is_absent() {
        add_friction(model, friction, &mut now, [0.0, direction.sign()], stop)?;
    }
    Ok(now)
}

/// The equilibrium with friction next to `start`, which is one at nearly the same contractions: no detour without friction.
///
/// # Errors
/// [`FrictionError`] with the state where Newton's method came to a halt.
pub fn follow(
    model: &mut Model,
    friction: &Friction,
    start: &[f64],
    direction: Direction,
    stop: &dyn Fn() -> bool,
) -> Result<SlidingState, Box<FrictionError>> {
    if friction.is_absent() {
        return settle(model, friction, start, direction, stop);
    }
    let mut now = SlidingState { x: start.to_vec(), ..SlidingState::default() };
    match newton(model, friction, &mut now, direction.sign(), stop) {
        Ok(()) => Ok(now),
        Err(fault) => Err(Box::new(FrictionError { fault, reached: direction.sign(), best: now })),
    }
}

impl SlidingState {
    /// From the end of the band that this state is at to the other one, at the same contractions.
    ///
    /// # Errors
    /// As [`settle`].
    pub fn reversed(
        &self,
        model: &mut Model,
        friction: &Friction,
        from: Direction,
        stop: &dyn Fn() -> bool,
    ) -> Result<Self, Box<FrictionError>> {
        let mut now = self.clone();
        add_friction(model, friction, &mut now, [from.sign(), -from.sign()], stop)?;
        Ok(now)
    }
}

/// Takes `now` from one part of the friction to another, in parts that are halved where Newton's method does not follow.
fn add_friction(
    model: &mut Model,
    friction: &Friction,
    now: &mut SlidingState,
    [from, to]: [f64; 2],
    stop: &dyn Fn() -> bool,
) -> Result<(), Box<FrictionError>> {
    let (mut done, mut part) = (0.0, 1.0);
    while done < 1.0 {
        let next = f64::min(done + part, 1.0);
        let mut trial = now.clone();
        match newton(model, friction, &mut trial, from + next * (to - from), stop) {
            Ok(()) => {
                *now = trial;
                (done, part) = (next, 2.0 * part);
            }
            Err(fault) => {
                (now.iterations, now.factorizations) = (trial.iterations, trial.factorizations);
                part *= 0.5;
                if part < SHORTEST_PART || fault == Fault::Cancelled {
                    let reached = from + done * (to - from);
                    return Err(Box::new(FrictionError { fault, reached, best: now.clone() }));
                }
            }
        }
    }
    Ok(())
}

/// Newton's method on the residual, with a `part` of every coefficient. Steps stop short of inversion and are halved until the
/// residual falls (Euclidean norm: the step is a descent direction of it).
fn newton(
    model: &mut Model,
    friction: &Friction,
    state: &mut SlidingState,
    part: f64,
    stop: &dyn Fn() -> bool,
) -> Result<(), Fault> {
    let settings = StaticsSettings::default();
    let n = state.x.len();
    let [mut force, mut step, mut trial, mut at_work, mut rounding] = [(); 5].map(|()| vec![0.0; n]);
    friction.residual(model, &state.x, part, &mut force);
    for _ in 0..MOST_STEPS {
        state.residual = norm(&force);
        let scale = model.scales_into(&state.x, &mut at_work, &mut rounding);
        let balanced = force.iter().zip(&rounding).all(|(f, r)| f.abs() <= settings.tolerance * scale + RESOLVED * r);
        if balanced {
            return Ok(());
        }
        if stop() {
            return Err(Fault::Cancelled);
        }
        let settled = state.residual <= settings.stagnation_tolerance * scale;
        state.iterations += 1;
        let Some(jacobian) = factorize(model, friction, state, part) else { return Err(Fault::Singular) };
        step.iter_mut().zip(&force).for_each(|(s, f)| *s = -f);
        jacobian.solve(model, &mut step).ok_or(Fault::Singular)?;
        let before = euclidean(&force);
        let mut length = model.step_limit(&state.x, &step);
        let mut found = false;
        for _ in 0..MAX_HALVINGS {
            trial.iter_mut().zip(&state.x).zip(&step).for_each(|((t, x), s)| *t = x + length * s);
            friction.residual(model, &trial, part, &mut force);
            found = euclidean(&force) <= (1.0 - SUFFICIENT_DECREASE * length) * before;
            if found {
                break;
            }
            length *= 0.5;
        }
        if !found {
            return if settled { Ok(()) } else { Err(Fault::Stalled) };
        }
        std::mem::swap(&mut state.x, &mut trial);
    }
    Err(Fault::Iterations)
}

/// The exact Jacobian, or one with the projected Hessian of the body where the exact one cannot be factorised.
fn factorize(model: &mut Model, friction: &Friction, state: &mut SlidingState, part: f64) -> Option<Bordered> {
    for form in [HessianForm::Exact, HessianForm::Projected] {
        state.factorizations += 1;
        if let Ok(jacobian) = Bordered::new(friction, model, &state.x, part, form) {
            return Some(jacobian);
        }
    }
    None
}

/// `|v|`, infinite for what is not finite.
fn euclidean(v: &[f64]) -> f64 {
    let squared: f64 = v.iter().map(|a| a * a).sum();
    if squared.is_finite() { squared.sqrt() } else { f64::INFINITY }
}
