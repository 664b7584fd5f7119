//! Poses of few winches whose cables rub at their holes ([`crate::physics::friction`]).
//!
//! Started from the activations that are best without friction, wound from rest in steps with all cables being pulled. Then
//! Gauss-Newton in the activations within their bounds, as in [`super::contraction`], on the Jacobian of the law of friction:
//!
//! ```text
//! J dx/dbeta_j = -sum Z_ej U''_e g_w,e         over the tendons e of winch j
//! ```
//!
//! What is found is wound to once more, and counts as that. The friction at a state depends on no history as long as all cables
//! slide the same way; which of several equilibria winding enters still does.

use super::contraction::{FIRST_DAMPING, quadratic};
use super::quadratic::Quadratic;
use super::{Posture, Question};
use crate::physics::friction::{self, Bordered, FrictionError, SlidingState};
use crate::physics::{Direction, Friction, HessianForm};

/// Steps of winding from rest, and the shortest one, as a part of the way: where a state does not follow, the step is halved.
const STEPS: usize = 8;
const SHORTEST_STEP: f64 = 1.0 / 512.0;
/// Gauss-Newton iterations; from the frictionless answer, few are needed.
const ITERATIONS: usize = 30;
/// Stops when a step promises less than this part of `O`: a thousandth of the error, and less than what `mu` is known to.
const ENOUGH: f64 = 1e-6;
/// Damping at which no useful step is left, and its factor from try to try.
const LAST_DAMPING: f64 = 1e8;
const DAMPING_GROWTH: f64 = 8.0;
/// Part of the promised decrease that a step must reach.
const SUFFICIENT_DECREASE: f64 = 1e-4;

/// A pose under friction, at both ends of the band.
#[derive(Clone, Debug)]
pub struct FrictionPose {
    /// Reached by winding from rest: all cables have been pulled.
    pub pulled: Posture,
    /// At the same activations, all cables having been let out; or why there is none.
    pub let_out: Result<Vec<f64>, Box<FrictionError>>,
    /// Whether no other activations promise to come closer.
    pub converged: bool,
    pub factorizations: usize,
}

/// The activations that serve the question best when its cables rub, near those that do without friction.
///
/// # Errors
/// [`FrictionError`] where winding from rest to the frictionless activations does not stay in balance.
pub fn pose(
    question: &mut Question,
    friction: &Friction,
    frictionless: &[f64],
    stop: &dyn Fn() -> bool,
) -> Result<FrictionPose, Box<FrictionError>> {
    let mut spent = 0;
    let mut best = wind(question, friction, frictionless, &mut spent, stop)?;
    let (found, converged) = descend(question, friction, &best, &mut spent, stop);
    if found.beta != best.beta {
        // Where winding ends elsewhere than the descent, the plushie would be there.
        if let Ok(wound) = wind(question, friction, &found.beta, &mut spent, stop)
            && wound.objective < best.objective
        {
            best = wound;
        }
    }
    set(question, &best.beta);
    let state = SlidingState { x: best.x.clone(), ..SlidingState::default() };
    let let_out = state.reversed(question.model, friction, Direction::Pulling, stop);
    let let_out = let_out.map(|state| {
        spent += state.factorizations;
        state.x
    });
    Ok(FrictionPose { pulled: best, let_out, converged, factorizations: spent })
}

/// The state that winding from rest leads to: all winches in proportion, all cables being pulled.
fn wind(
    question: &mut Question,
    friction: &Friction,
    beta: &[f64],
    spent: &mut usize,
    stop: &dyn Fn() -> bool,
) -> Result<Posture, Box<FrictionError>> {
    let rest = question.model.rest.clone();
    set(question, &vec![0.0; beta.len()]);
    let mut now = friction::settle(question.model, friction, &rest, Direction::Pulling, stop)?;
    let (mut done, mut step) = (0.0, 1.0 / STEPS as f64);
    let mut ahead: Option<Vec<f64>> = None;
    while done < 1.0 {
        let next = if done + 1.001 * step >= 1.0 { 1.0 } else { done + step };
        set(question, &beta.iter().map(|b| next * b).collect::<Vec<_>>());
        // As far again as in the step before; that guess is left where it leads nowhere.
        let guess = ahead.take().map(|rate| -> Vec<f64> {
            let dx: Vec<f64> = rate.iter().map(|r| r * (next - done)).collect();
            let part = if question.model.step_limit(&now.x, &dx) < 1.0 { 0.0 } else { 1.0 };
            now.x.iter().zip(dx).map(|(x, d)| x + part * d).collect()
        });
        let from = guess.as_ref().unwrap_or(&now.x);
        match friction::follow(question.model, friction, from, Direction::Pulling, stop) {
            Ok(state) => {
                ahead = Some(state.x.iter().zip(&now.x).map(|(x, before)| (x - before) / (next - done)).collect());
                *spent += state.factorizations;
                (now, done) = (state, next);
            }
            Err(error) => {
                *spent += error.best.factorizations;
                step *= 0.5;
                if step < SHORTEST_STEP || error.fault == friction::Fault::Cancelled {
                    return Err(error);
                }
            }
        }
    }
    Ok(posture(question, beta, now))
}

/// Gauss-Newton from a posture; the best one found, and whether it is stationary. `O` never rises.
fn descend(
    question: &mut Question,
    friction: &Friction,
    start: &Posture,
    spent: &mut usize,
    stop: &dyn Fn() -> bool,
) -> (Posture, bool) {
    let (mut best, mut damping) = (start.clone(), FIRST_DAMPING);
    for _ in 0..ITERATIONS {
        let Some(local) = Local::at(question, friction, &best, stop) else { return (best, false) };
        *spent += 1;
        let floor = ENOUGH * best.objective;
        loop {
            if damping > LAST_DAMPING || stop() {
                return (best, false);
            }
            let Some((beta, guess, promised)) = local.step(question, &best, damping, stop) else {
                return (best, false);
            };
            if promised <= floor {
                if local.model.best_single_promise() <= floor {
                    return (best, true);
                }
                damping *= DAMPING_GROWTH;
                continue;
            }
            set(question, &beta);
            let trial = friction::follow(question.model, friction, &guess, Direction::Pulling, stop);
            *spent += trial.as_ref().map_or_else(|error| error.best.factorizations, |state| state.factorizations);
            let trial = trial.ok().map(|state| posture(question, &beta, state));
            if let Some(trial) = trial.filter(|t| best.objective - t.objective > SUFFICIENT_DECREASE * promised) {
                damping = (damping * 0.2).max(1e-12);
                best = trial;
                break;
            }
            damping *= DAMPING_GROWTH;
        }
    }
    (best, false)
}

/// The quadratic model of `O` at an equilibrium under friction.
struct Local {
    /// Activations from which steps start: those of slack winches that should pull are moved to just slack.
    base: Vec<f64>,
    model: Quadratic,
    /// `dx/dbeta`, column by column.
    columns: Vec<f64>,
}

impl Local {
    fn at(question: &mut Question, friction: &Friction, at: &Posture, stop: &dyn Fn() -> bool) -> Option<Self> {
        let n = at.x.len();
        let contractions = set(question, &at.beta);
        let jacobian = Bordered::new(friction, question.model, &at.x, 1.0, HessianForm::Exact).ok()?;
        let elements = &question.model.contractile.elements;
        let gammas = elements.iter().zip(&contractions).map(|(e, c)| (e, e.length(&at.x) - e.alpha0 + c));
        let (tensions, mut tangents): (Vec<f64>, Vec<f64>) = gammas.map(|(e, g)| (e.tension(g), e.tangent(g))).unzip();
        let (mut base, mut idle) = (at.beta.clone(), Vec::new());
        for (j, winch) in question.actuation.winches.iter().enumerate() {
            let slack = winch.members.iter().map(|&(e, r)| elements[e].just_slack(&at.x) / r);
            let slack = slack.fold(f64::INFINITY, f64::min);
            if winch.members.iter().all(|&(e, _)| tangents[e] <= 0.0) && slack < winch.upper {
                base[j] = base[j].max(slack);
                winch.members.iter().for_each(|&(e, _)| tangents[e] = elements[e].stiffness);
                idle.push(j);
            }
        }
        let mut columns = columns(question, friction, &jacobian, &at.x, &tangents, stop)?;
        let mut slope = vec![0.0; n];
        question.objective.position_gradient(&at.x, &mut slope);
        for j in idle {
            let column = &mut columns[j * n..(j + 1) * n];
            if slope.iter().zip(&*column).map(|(s, c)| s * c).sum::<f64>() >= 0.0 {
                // Pulling would not help.
                column.fill(0.0);
                base[j] = at.beta[j];
                question.actuation.winches[j].members.iter().for_each(|&(e, _)| tangents[e] = 0.0);
            }
        }
        let mut model = quadratic(question, at, &base, &columns, &contractions, &tensions, &tangents);
        model.prepare(stop)?;
        Some(Self { base, model, columns })
    }

    /// Activations after a damped step, the positions that the model predicts there, and the decrease of `O` that it promises.
    fn step(
        &self,
        question: &Question,
        at: &Posture,
        damping: f64,
        stop: &dyn Fn() -> bool,
    ) -> Option<(Vec<f64>, Vec<f64>, f64)> {
        let curvatures = self.model.curvatures();
        let largest = curvatures.max().max(f64::MIN_POSITIVE);
        let damping = curvatures.map(|c| damping * (c + 1e-4 * largest) + 1e-14 * largest);
        let step = self.model.minimise(&damping, stop)?;
        let mut beta: Vec<f64> = self.base.iter().zip(step.iter()).map(|(b, d)| b + d).collect();
        question.actuation.clamp(&mut beta);
        let mut dx = vec![0.0; at.x.len()];
        for (column, d) in self.columns.chunks_exact(at.x.len()).zip(step.iter()) {
            dx.iter_mut().zip(column).for_each(|(x, c)| *x += d * c);
        }
        let part = if question.model.step_limit(&at.x, &dx) < 1.0 { 0.0 } else { 1.0 };
        let guess = at.x.iter().zip(dx).map(|(x, d)| x + part * d).collect();
        Some((beta, guess, self.model.promise(&step)))
    }
}

/// `dx/dbeta` of all free winches, column after column, at the equilibrium `x` when all cables are being pulled; the elements' laws are as
/// the winches stand. `None` where the body has no stiffness against some motion, or `stop` has ended it.
pub fn position_jacobian(
    question: &mut Question,
    friction: &Friction,
    x: &[f64],
    stop: &dyn Fn() -> bool,
) -> Option<Vec<f64>> {
    let contractile = &question.model.contractile;
    let laws = contractile.elements.iter().zip(&contractile.laws);
    let tangents: Vec<f64> = laws.map(|(e, law)| law.tension_and_tangent(e, e.length(x)).1).collect();
    let jacobian = Bordered::new(friction, question.model, x, 1.0, HessianForm::Exact).ok()?;
    columns(question, friction, &jacobian, x, &tangents, stop)
}

/// [`position_jacobian`] with the Jacobian of the forces at hand, and with tangents given.
fn columns(
    question: &mut Question,
    friction: &Friction,
    jacobian: &Bordered,
    x: &[f64],
    tangents: &[f64],
    stop: &dyn Fn() -> bool,
) -> Option<Vec<f64>> {
    let mut columns = vec![0.0; x.len() * question.actuation.winches.len()];
    for (winch, column) in question.actuation.winches.iter().zip(columns.chunks_exact_mut(x.len())) {
        for &(e, ratio) in &winch.members {
            friction.add_weighted_gradient(question.model, e, x, -ratio * tangents[e], column);
        }
        if stop() {
            return None;
        }
        jacobian.solve(question.model, column)?;
    }
    Some(columns)
}

/// Winds the winches to `beta`; the contractions of all elements.
fn set(question: &mut Question, beta: &[f64]) -> Vec<f64> {
    let contractions = question.actuation.contractions(beta);
    question.model.contractile.set_contractions(&contractions);
    contractions
}

fn posture(question: &Question, beta: &[f64], state: SlidingState) -> Posture {
    let contractions = question.actuation.contractions(beta);
    let objective = question.objective_at(&state.x, &contractions);
    Posture { beta: beta.to_vec(), x: state.x, objective, residual: state.residual, unsettled: None }
}
