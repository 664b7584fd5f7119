//! Statics: where the plushie comes to rest (minimum of `E`), by an inversion-safe Newton method.
//!
//! The exact Hessian is factorised; only where that fails the projected one takes its place. A step is first capped so that
//! no triangle comes near inversion, then halved until the energy falls enough (Armijo). Near equilibrium, where the Hessian
//! hardly changes any more, steps are repeated with the same factor (Shamanskii's method).

use super::continuation;
use super::energy::HessianForm;
use super::model::Model;
use super::patience::Patience;
use super::ridge;

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

/// Newton steps after which a search counts as slow, and more is done in each ([`Patience`]).
const PATIENCE: usize = 15;
/// A Newton step that leaves at most this part of the residual is followed by steps with the same factor, each of which must
/// leave at most `REUSED` of it: Newton's method squares the part that is left, these steps about double it.
const CONTRACTING: f64 = 0.03;
const REUSED: f64 = 0.1;
/// At the slowest rate these leave 1e-8 of the residual, and one more Newton step does the rest.
const MAX_REUSES: usize = 8;
/// Armijo: the part of the predicted decrease that must be met.
const SUFFICIENT_DECREASE: f64 = 1e-4;
/// Halvings before a step counts as failed: a factor of about 1e-12.
const MAX_HALVINGS: usize = 40;
/// A step capped below this leads nowhere: triangles have collapsed against the edge of the material's domain.
const SMALLEST_STEP: f64 = 1e-12;
/// A triangle of less than this part of its area is flat: that takes stresses of a thousand shear moduli.
const FLAT: f64 = 1e-5;
/// Relative rounding of an energy sum: differences below it say nothing.
const ENERGY_ROUNDING: f64 = 1e-13;
/// There a step must leave at most this part of the residual, or rounding is all that is left of it.
const STILL_FALLING: f64 = 0.7;
/// A residual below this part of what a change in the sixth digit of the coordinates does is rounding: five units in the last
/// place.
const RESOLVED: f64 = 1e-9;

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
    #[error("the allowed number of Newton steps was not enough")]
    Iterations,
    #[error("the body is free to move: add a pin")]
    FreeToMove,
    #[error("a triangle is pressed flat: pull less")]
    Collapsed,
    #[error("cancelled")]
    Cancelled,
}

/// What a search for equilibrium did.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    pub energy: f64,
    /// `max |dE/dx|`.
    pub residual: f64,
    /// The forces at work, against which the residual is small.
    pub force_scale: f64,
    pub iterations: usize,
    pub factorizations: usize,
    pub projections: usize,
    /// Why it is not in equilibrium; `None` where it is.
    pub cause: Option<Cause>,
}

/// What statics works in; kept between solves, so that a warm one allocates nothing.
#[derive(Debug, Default)]
pub struct Workspace {
    gradient: Vec<f64>,
    step: Vec<f64>,
    trial: Vec<f64>,
    trial_gradient: Vec<f64>,
    forces: Vec<f64>,
    rounding: Vec<f64>,
}

impl Workspace {
    /// Ready for models of this dimension; an empty one grows where it is first used.
    pub fn new(dimension: usize) -> Self {
        let zero = || vec![0.0; dimension];
        Self { gradient: zero(), step: zero(), trial: zero(), trial_gradient: zero(), forces: zero(), rounding: zero() }
    }

    /// Works out the forces at `x`; returns the largest unbalanced one and the forces at work, as [`Model::gradient_and_scale`].
    pub fn forces_at(&mut self, model: &Model, x: &[f64]) -> (f64, f64) {
        let n = x.len();
        for buffer in [&mut self.gradient, &mut self.step, &mut self.trial, &mut self.trial_gradient, &mut self.forces]
        {
            buffer.resize(n, 0.0);
        }
        let scale = model.gradient_and_scale(x, &mut self.gradient, &mut self.forces);
        (norm(&self.gradient), scale)
    }
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

/// The same in place: `x` becomes the equilibrium, or the best state reached.
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
/// step ([`super::continuation`]); the way there is left again if it ends above the energy of the start.
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

/// Newton's method on the model as it is.
fn newton(
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
    let mut state = Progress {
        energy,
        residual: norm(gradient),
        force_scale: 0.0,
        iterations: 0,
        factorizations: 0,
        projections: 0,
        cause: None,
    };
    if !energy.is_finite() {
        return Progress { cause: Some(Cause::InvalidStart), ..state };
    }
    let mut patience = Patience::new(model);
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
        let slow = state.iterations > PATIENCE;
        let factors = if slow { patience.factorize(model, x, cancel) } else { factorize(model, x, cancel) };
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
        let slope: f64 = gradient.iter().zip(step.iter()).map(|(g, s)| g * s).sum();
        let mut t = model.step_limit(x, step);
        let mut accepted = false;
        let halvings = if t < SMALLEST_STEP { 0 } else { MAX_HALVINGS };
        for _ in 0..halvings {
            for ((p, x), s) in trial.iter_mut().zip(x.iter()).zip(step.iter()) {
                *p = x + t * s;
            }
            let mut trial_energy = model.energy(trial);
            if slow {
                if cancel() {
                    return Progress { cause: Some(Cause::Cancelled), ..state };
                }
                trial_energy = patience.correct(model, gradient, t, trial, trial_energy);
            }
            if trial_energy <= energy + SUFFICIENT_DECREASE * t * slope && slope < 0.0 {
                accepted = true;
            } else if trial_energy.is_finite() && (t * slope).abs() <= ENERGY_ROUNDING * energy_scale(model, energy) {
                // Energies no longer tell states apart; forces still do.
                model.gradient(trial, trial_gradient);
                if norm(trial_gradient) <= STILL_FALLING * state.residual {
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
            return Progress { cause: unsettled(stalled(model, x)), ..state };
        }
        patience.learn(t);
        x.copy_from_slice(trial);
        model.gradient(x, gradient);
        let quick = !slow && t == 1.0 && form == HessianForm::Exact && norm(gradient) <= CONTRACTING * state.residual;
        if quick
            && reuse_factor(
                model,
                x,
                settings.tolerance * state.force_scale,
                [&mut *gradient, step, trial, trial_gradient],
            )
        {
            energy = model.energy(x);
        }
    }
}

/// Steps with the factor of the last Newton step, while each leaves little of the residual: where the Hessian hardly changes
/// any more, a solve does what would take a factorisation. Whether any was taken.
fn reuse_factor(model: &mut Model, x: &mut [f64], enough: f64, buffers: [&mut Vec<f64>; 4]) -> bool {
    let most = Reuse { enough, left: REUSED, steps: MAX_REUSES };
    most.steps(model, x, buffers) > 0
}

/// How far steps with a factor that is at hand go on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reuse {
    /// Residual at which they end, force.
    pub enough: f64,
    /// The part of the residual that a step may leave at most; else it is not taken, and was the last.
    pub left: f64,
    pub steps: usize,
}

impl Reuse {
    /// Takes steps from `x`, whose forces are in `work`; see [`Workspace::forces_at`]. Returns the residual reached. Nothing
    /// happens where the model has no factor.
    pub fn settle(&self, model: &mut Model, x: &mut [f64], work: &mut Workspace) -> f64 {
        let Workspace { gradient, step, trial, trial_gradient, .. } = work;
        if model.has_factor() {
            self.steps(model, x, [&mut *gradient, step, trial, trial_gradient]);
        }
        norm(gradient)
    }

    /// Returns how many steps were taken. The first buffer holds the forces at `x`, before and after.
    fn steps(&self, model: &mut Model, x: &mut [f64], buffers: [&mut Vec<f64>; 4]) -> usize {
        let [gradient, step, trial, trial_gradient] = buffers;
        for taken in 0..self.steps {
            let residual = norm(gradient);
            if residual <= self.enough {
                return taken;
            }
            for (s, g) in step.iter_mut().zip(gradient.iter()) {
                *s = -g;
            }
            model.solve(step);
            if model.step_limit(x, step) < 1.0 {
                return taken;
            }
            for ((p, x), s) in trial.iter_mut().zip(x.iter()).zip(step.iter()) {
                *p = x + s;
            }
            model.gradient(trial, trial_gradient);
            if norm(trial_gradient) > self.left * residual {
                return taken;
            }
            x.copy_from_slice(trial);
            std::mem::swap(gradient, trial_gradient);
        }
        self.steps
    }
}

/// The same as [`solve`], and on from an equilibrium that is not stable: by symmetry Newton's method may end on a ridge of the
/// energy (a bar that is pressed and does not buckle). From there it goes down to either side.
pub fn minimum(
    model: &mut Model,
    start: &[f64],
    settings: &StaticsSettings,
    cancel: &dyn Fn() -> bool,
) -> Result<Equilibrium, Box<StaticsError>> {
    let mut state = solve(model, start, settings, cancel)?;
    for _ in 0..RIDGES {
        if cancel() {
            break;
        }
        state.factorizations += 1;
        if model.factorize(&state.x, HessianForm::Exact).is_ok() {
            break;
        }
        let Some(aside) = ridge::step_aside(model, &state.x, cancel) else { break };
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

/// Ridges that are left at most.
const RIDGES: usize = 6;

/// The exact Hessian or the projected one, and the number of factorisations that took.
fn factorize(model: &mut Model, x: &[f64], cancel: &dyn Fn() -> bool) -> Option<(HessianForm, usize)> {
    if model.factorize(x, HessianForm::Exact).is_ok() {
        return Some((HessianForm::Exact, 1));
    }
    let projected = !cancel() && model.factorize_projected(x).is_ok();
    projected.then_some((HessianForm::Projected, 2))
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

/// Why no step leads on: where a triangle is pressed flat, rounding of its corners is all that its forces depend on.
fn stalled(model: &Model, x: &[f64]) -> Cause {
    if model.body.smallest_determinant(x) < FLAT { Cause::Collapsed } else { Cause::Stalled }
}
