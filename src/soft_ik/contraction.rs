//! Gauss-Newton on the activations, with true bounds: for winches, and for the exact objective of problem files.
//!
//! `O` is half a sum of squares `|r(beta)|^2` with `r = [sqrt(q) (x - x'), sqrt(lambda) alpha_c/alpha_0, sqrt(rho) tau]`. Its
//! Jacobian follows from the exact `dx/dbeta`; `(J^T J + D) d = -J^T r` is solved on the activations that are not held by a
//! bound, with Levenberg-Marquardt damping `D`. Every trial is a true equilibrium, so `O` never rises.
//!
//! **Slack.** Where all elements of a winch are slack, `U'' = 0` and the derivative by contraction vanishes although pulling
//! might help. The derivative by *tension*, `dO/dtau = -G p` with `p = H^-1 dO/dx`, does not vanish: a slack winch that it
//! calls for is first moved to just slack (which changes no position) and enters the step with the tangent of a barely
//! taut element. So no answer is stuck in the slack stall.

use super::quadratic::Quadratic;
use super::sensitivity::position_jacobian;
use super::{Answer, Budget, Method, Posture, Question};
use nalgebra::{DMatrix, DVector};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GaussNewton {
    /// Stops when a step promises less than this part of `O`.
    pub relative_decrease: f64,
}

impl Default for GaussNewton {
    fn default() -> Self {
        Self { relative_decrease: 1e-9 }
    }
}

/// First damping, relative to the diagonal of `J^T J`.
pub const FIRST_DAMPING: f64 = 1e-4;
/// A tangent below this part of `K` counts as slack: rounding, or the very foot of the cubic, leaves no useful derivative.
const BARELY_TAUT: f64 = 1e-3;
/// Damping at which no useful step is left.
const LAST_DAMPING: f64 = 1e10;

impl Method for GaussNewton {
    fn name(&self) -> &'static str {
        "contraction"
    }

    fn solve(&self, question: &mut Question, start: &Posture, budget: &Budget) -> Answer {
        let mut damping = FIRST_DAMPING;
        self.resume(question, start, budget, &mut damping)
    }
}

impl GaussNewton {
    /// [`Method::solve`] in parts: `damping` is kept from one part to the next, [`FIRST_DAMPING`] for the first.
    pub fn resume(&self, question: &mut Question, start: &Posture, budget: &Budget, damping: &mut f64) -> Answer {
        let mut best = start.clone();
        let mut answer = Answer::at(&best);
        if question.actuation.winches.is_empty() {
            answer.converged = true;
            return answer;
        }
        while answer.iterations < budget.iterations && !(budget.stop)() {
            answer.iterations += 1;
            answer.factorizations += 1;
            let Some(local) = Linearisation::new(question, &best, budget.stop) else { break };
            let floor = self.relative_decrease * best.objective;
            let mut improved = false;
            while *damping < LAST_DAMPING && !(budget.stop)() {
                let Some((step, promised)) = local.step(*damping, budget.stop) else { break };
                if promised <= floor {
                    // Strong damping or many clipped activations make a promise small anywhere. Stationary is where no single
                    // activation promises anything either.
                    if local.model.best_single_promise() <= floor {
                        answer.converged = true;
                        break;
                    }
                    *damping = (*damping * 8.0).max(1e-8);
                    continue;
                }
                let mut beta: Vec<f64> = local.base.iter().zip(step.iter()).map(|(b, d)| b + d).collect();
                question.actuation.clamp(&mut beta);
                let guess = local.predict(question, &best.x, &step);
                let (trial, factorizations) = question.settle(&beta, &guess, budget.stop);
                answer.factorizations += factorizations;
                let gain = best.objective - trial.objective;
                if trial.in_equilibrium() && gain > 1e-4 * promised {
                    *damping = (*damping * if gain > 0.7 * promised { 0.1 } else { 0.5 }).max(1e-12);
                    best = trial;
                    improved = true;
                    break;
                }
                *damping = (*damping * 8.0).max(1e-8);
            }
            if !improved {
                break;
            }
        }
        let contractions = question.actuation.contractions(&best.beta);
        question.model.contractile.set_contractions(&contractions);
        answer.posture = best;
        answer
    }
}

/// The quadratic model of `O` at an equilibrium.
struct Linearisation {
    /// Activations from which steps start: the posture's, with recruited slack winches moved to just slack.
    base: Vec<f64>,
    model: Quadratic,
    /// `dx/dbeta`, column by column.
    columns: Vec<f64>,
}

impl Linearisation {
    /// `None` where it cannot be had, or `stop` has ended it.
    fn new(question: &mut Question, at: &Posture, stop: &dyn Fn() -> bool) -> Option<Self> {
        let contractions = question.actuation.contractions(&at.beta);
        question.model.contractile.set_contractions(&contractions);
        question.model.factorize_for_descent(&at.x).ok()?;
        let mut pull = vec![0.0; at.x.len()];
        question.objective.position_gradient(&at.x, &mut pull);
        question.model.solve(&mut pull);
        let elements = &question.model.contractile.elements;
        let (mut tensions, mut tangents) = (Vec::new(), Vec::new());
        for (e, c) in elements.iter().zip(&contractions) {
            let gamma = e.length(&at.x) - e.alpha0 + c;
            tensions.push(e.tension(gamma));
            tangents.push(e.tangent(gamma));
        }
        let mut base = at.beta.clone();
        for (winch, b) in question.actuation.winches.iter().zip(&mut base) {
            if winch.members.iter().any(|&(e, _)| tangents[e] > BARELY_TAUT * elements[e].stiffness) {
                continue;
            }
            let by_tension: f64 = winch.members.iter().map(|&(e, r)| -r * elements[e].length_rate(&at.x, &pull)).sum();
            let just_slack =
                winch.members.iter().map(|&(e, r)| elements[e].just_slack(&at.x) / r).fold(f64::INFINITY, f64::min);
            if by_tension < 0.0 && just_slack < winch.upper {
                *b = b.max(just_slack);
                for &(e, _) in &winch.members {
                    tangents[e] = elements[e].stiffness;
                }
            }
        }
        let columns = position_jacobian(question, &at.x, &tangents, stop)?;
        let mut model = quadratic(question, at, &base, &columns, &contractions, &tensions, &tangents);
        model.prepare(stop)?;
        Some(Self { base, model, columns })
    }

    /// The damped step within the bounds, and the decrease of `O` that the model promises for it; `None` where `stop` has ended it.
    fn step(&self, damping: f64, stop: &dyn Fn() -> bool) -> Option<(DVector<f64>, f64)> {
        let curvatures = self.model.curvatures();
        let largest = curvatures.max().max(f64::MIN_POSITIVE);
        let damping = curvatures.map(|c| damping * (c + 1e-4 * largest) + 1e-14 * largest);
        let step = self.model.minimise(&damping, stop)?;
        let promised = self.model.promise(&step);
        Some((step, promised))
    }

    /// First-order prediction of the positions after a step, or the old ones where it would invert a triangle.
    fn predict(&self, question: &Question, x: &[f64], step: &DVector<f64>) -> Vec<f64> {
        let n = x.len();
        let mut dx = vec![0.0; n];
        for (column, d) in self.columns.chunks_exact(n).zip(step.iter()) {
            if *d != 0.0 {
                for (a, c) in dx.iter_mut().zip(column) {
                    *a += d * c;
                }
            }
        }
        if question.model.step_limit(x, &dx) < 1.0 {
            return x.to_vec();
        }
        x.iter().zip(&dx).map(|(a, b)| a + b).collect()
    }
}

/// Stacks the residuals' Jacobian: targets, rest weights, tensions; relative contractions are diagonal.
pub(super) fn quadratic(
    question: &Question,
    at: &Posture,
    base: &[f64],
    columns: &[f64],
    contractions: &[f64],
    tensions: &[f64],
    tangents: &[f64],
) -> Quadratic {
    let (objective, n) = (question.objective, at.x.len());
    let winches = &question.actuation.winches;
    let elements = &question.model.contractile.elements;
    let column = |j: usize| &columns[j * n..(j + 1) * n];
    let held = objective.rest_weights.iter().enumerate().filter(|(_, q)| **q > 0.0).map(|(i, q)| (i, q.sqrt()));
    let held: Vec<(usize, f64)> = held.collect();
    let pulled: Vec<(usize, usize, f64)> = if objective.tension_weight > 0.0 {
        let members = winches.iter().enumerate().flat_map(|(j, w)| w.members.iter().map(move |&(e, r)| (j, e, r)));
        members.filter(|&(_, e, _)| tangents[e] != 0.0).collect()
    } else {
        Vec::new()
    };
    let count = 2 * objective.targets.len() + 2 * held.len() + pulled.len();
    let mut rows = DMatrix::zeros(count, winches.len());
    let mut residual = DVector::zeros(count);
    let offsets: Vec<[f64; 2]> = objective.targets.iter().map(|t| t.offset(&at.x)).collect();
    let root = objective.tension_weight.sqrt();
    for (k, &(_, e, _)) in pulled.iter().enumerate() {
        residual[2 * objective.targets.len() + 2 * held.len() + k] = root * tensions[e];
    }
    for j in 0..winches.len() {
        let dx = column(j);
        let mut r = 0;
        for (target, offset) in objective.targets.iter().zip(&offsets) {
            let scale = target.weight.sqrt();
            for axis in 0..2 {
                let moved: f64 = target.nodes.iter().zip(&target.weights).map(|(m, w)| w * dx[2 * m + axis]).sum();
                rows[(r, j)] = scale * moved;
                residual[r] = scale * offset[axis];
                r += 1;
            }
        }
        for &(i, scale) in &held {
            for d in [2 * i, 2 * i + 1] {
                rows[(r, j)] = scale * dx[d];
                residual[r] = scale * (at.x[d] - objective.rest[d]);
                r += 1;
            }
        }
        for &(owner, e, ratio) in &pulled {
            let own = if owner == j { ratio } else { 0.0 };
            rows[(r, j)] = root * tangents[e] * (elements[e].length_rate(&at.x, dx) + own);
            r += 1;
        }
    }
    let mut gradient = rows.tr_mul(&residual);
    let mut diagonal = DVector::zeros(winches.len());
    let lambda = objective.contraction_weight;
    for (j, winch) in winches.iter().enumerate() {
        for &(e, ratio) in &winch.members {
            let by = ratio / elements[e].alpha0;
            gradient[j] += lambda * by * contractions[e] / elements[e].alpha0;
            diagonal[j] += lambda * by * by;
        }
    }
    let lower = winches.iter().zip(base).map(|(w, b)| w.lower - b).collect();
    let upper = winches.iter().zip(base).map(|(w, b)| w.upper - b).collect();
    Quadratic { gradient, rows, diagonal, lower, upper, gram: None }
}
