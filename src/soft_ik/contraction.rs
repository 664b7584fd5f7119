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
const FIRST_DAMPING: f64 = 1e-4;
/// Damping at which no useful step is left.
const LAST_DAMPING: f64 = 1e10;
/// Rounds of fixing activations that a step drives over their bounds.
const BOUND_ROUNDS: usize = 30;

impl Method for GaussNewton {
    fn name(&self) -> &'static str {
        "contraction"
    }

    fn solve(&self, question: &mut Question, start: &Posture, budget: &Budget) -> Answer {
        let mut best = start.clone();
        let mut answer = Answer { posture: best.clone(), iterations: 0, factorizations: 0, converged: false };
        let mut damping = FIRST_DAMPING;
        if question.actuation.winches.is_empty() {
            answer.converged = true;
            return answer;
        }
        while answer.iterations < budget.iterations && !(budget.stop)() {
            answer.iterations += 1;
            answer.factorizations += 1;
            let Some(local) = Linearisation::new(question, &best) else { break };
            let floor = self.relative_decrease * best.objective;
            let mut improved = false;
            while damping < LAST_DAMPING && !(budget.stop)() {
                let (step, promised) = local.step(question, damping);
                if promised <= floor {
                    answer.converged = true;
                    break;
                }
                let mut beta: Vec<f64> = local.base.iter().zip(&step).map(|(b, d)| b + d).collect();
                question.actuation.clamp(&mut beta);
                let guess = local.predict(question, &best.x, &step);
                let (trial, factorizations) = question.settle(&beta, &guess, budget.stop);
                answer.factorizations += factorizations;
                let gain = best.objective - trial.objective;
                if trial.in_equilibrium && gain > 1e-4 * promised {
                    damping = (damping * if gain > 0.7 * promised { 0.1 } else { 0.5 }).max(1e-12);
                    best = trial;
                    improved = true;
                    break;
                }
                damping = (damping * 8.0).max(1e-8);
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
    gradient: DVector<f64>,
    /// `J^T J`.
    gram: DMatrix<f64>,
    /// `dx/dbeta`, column by column.
    columns: Vec<f64>,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl Linearisation {
    fn new(question: &mut Question, at: &Posture) -> Option<Self> {
        let contractions = question.actuation.contractions(&at.beta);
        question.model.contractile.set_contractions(&contractions);
        question.model.factorize_for_descent(&at.x).ok()?;
        let mut pull = vec![0.0; at.x.len()];
        question.objective.position_gradient(&at.x, &mut pull);
        question.model.solve(&mut pull);
        let winches = question.actuation.winches.len();
        let elements = &question.model.contractile.elements;
        let (mut tensions, mut tangents) = (Vec::new(), Vec::new());
        for (e, c) in elements.iter().zip(&contractions) {
            let gamma = e.length(&at.x) - e.alpha0 + c;
            tensions.push(e.tension(gamma));
            tangents.push(e.tangent(gamma));
        }
        let mut base = at.beta.clone();
        for (winch, b) in question.actuation.winches.iter().zip(&mut base) {
            if winch.members.iter().any(|&(e, _)| tangents[e] > 0.0) {
                continue;
            }
            let by_tension: f64 = winch.members.iter().map(|&(e, r)| -r * elements[e].length_rate(&at.x, &pull)).sum();
            let just_slack = winch
                .members
                .iter()
                .map(|&(e, r)| (elements[e].alpha0 - elements[e].length(&at.x) - elements[e].epsilon) / r)
                .fold(f64::INFINITY, f64::min);
            if by_tension < 0.0 && just_slack < winch.upper && just_slack >= *b {
                *b = just_slack;
                for &(e, _) in &winch.members {
                    tangents[e] = elements[e].stiffness;
                }
            }
        }
        let columns = position_jacobian(question, &at.x, &tangents);
        let this = Self {
            gradient: DVector::zeros(winches),
            gram: DMatrix::zeros(winches, winches),
            lower: question.actuation.winches.iter().zip(&base).map(|(w, b)| w.lower - b).collect(),
            upper: question.actuation.winches.iter().zip(&base).map(|(w, b)| w.upper - b).collect(),
            base,
            columns,
        };
        Some(this.with_quadratic(question, at, &contractions, &tensions, &tangents))
    }

    /// Sums `J^T r` and `J^T J` over the groups of residuals.
    fn with_quadratic(
        mut self,
        question: &Question,
        at: &Posture,
        contractions: &[f64],
        tensions: &[f64],
        tangents: &[f64],
    ) -> Self {
        let (objective, n) = (question.objective, at.x.len());
        let winches = &question.actuation.winches;
        let column = |j: usize| &self.columns[j * n..(j + 1) * n];
        for target in &objective.targets {
            let offset = target.offset(&at.x);
            for (axis, r) in offset.into_iter().enumerate() {
                let row = DVector::from_fn(winches.len(), |j, _| {
                    target.nodes.iter().zip(&target.weights).map(|(m, w)| w * column(j)[2 * m + axis]).sum::<f64>()
                });
                self.gradient.axpy(target.weight * r, &row, 1.0);
                self.gram.ger(target.weight, &row, &row, 1.0);
            }
        }
        if objective.rest_weights.iter().any(|q| *q > 0.0) {
            let weight = |d: usize| objective.rest_weights[d / 2];
            let scaled = DMatrix::from_fn(n, winches.len(), |d, j| weight(d).sqrt() * column(j)[d]);
            let residual = DVector::from_fn(n, |d, _| weight(d).sqrt() * (at.x[d] - objective.rest[d]));
            self.gradient += scaled.tr_mul(&residual);
            self.gram += scaled.tr_mul(&scaled);
        }
        let elements = &question.model.contractile.elements;
        let lambda = objective.contraction_weight;
        for (j, winch) in winches.iter().enumerate() {
            for &(e, ratio) in &winch.members {
                let by = ratio / elements[e].alpha0;
                self.gradient[j] += lambda * by * contractions[e] / elements[e].alpha0;
                self.gram[(j, j)] += lambda * by * by;
            }
        }
        if objective.tension_weight > 0.0 {
            let rho = objective.tension_weight;
            for (k, winch) in winches.iter().enumerate() {
                for &(e, ratio) in &winch.members {
                    if tangents[e] == 0.0 {
                        continue;
                    }
                    let row = DVector::from_fn(winches.len(), |j, _| {
                        let own = if j == k { ratio } else { 0.0 };
                        tangents[e] * (elements[e].length_rate(&at.x, column(j)) + own)
                    });
                    self.gradient.axpy(rho * tensions[e], &row, 1.0);
                    self.gram.ger(rho, &row, &row, 1.0);
                }
            }
        }
        self
    }

    /// The damped step within the bounds, and the decrease of `O` that the model promises for it.
    fn step(&self, _question: &Question, damping: f64) -> (Vec<f64>, f64) {
        let m = self.gradient.len();
        let largest = self.gram.diagonal().max().max(f64::MIN_POSITIVE);
        let mut matrix = self.gram.clone();
        for j in 0..m {
            matrix[(j, j)] += damping * (self.gram[(j, j)] + 1e-4 * largest) + 1e-14 * largest;
        }
        let mut step = DVector::zeros(m);
        // A variable on its bound stays there when the gradient pushes it outward.
        let mut held: Vec<bool> = (0..m)
            .map(|j| {
                (self.lower[j] >= 0.0 && self.gradient[j] > 0.0) || (self.upper[j] <= 0.0 && self.gradient[j] < 0.0)
            })
            .collect();
        for j in 0..m {
            step[j] = 0.0_f64.max(self.lower[j]).min(self.upper[j]);
        }
        for _ in 0..BOUND_ROUNDS {
            let free: Vec<usize> = (0..m).filter(|j| !held[*j]).collect();
            if free.is_empty() {
                break;
            }
            let block = DMatrix::from_fn(free.len(), free.len(), |a, b| matrix[(free[a], free[b])]);
            let rhs = DVector::from_fn(free.len(), |a, _| {
                let j = free[a];
                let coupled: f64 = (0..m).filter(|k| held[*k]).map(|k| matrix[(j, k)] * step[k]).sum();
                -self.gradient[j] - coupled
            });
            let Some(cholesky) = block.cholesky() else { break };
            let solution = cholesky.solve(&rhs);
            let mut clipped = false;
            for (a, &j) in free.iter().enumerate() {
                step[j] = solution[a].max(self.lower[j]).min(self.upper[j]);
                if step[j] != solution[a] {
                    held[j] = true;
                    clipped = true;
                }
            }
            if !clipped {
                break;
            }
        }
        let promised = -self.gradient.dot(&step) - 0.5 * (&self.gram * &step).dot(&step);
        (step.as_slice().to_vec(), promised)
    }

    /// First-order prediction of the positions after a step, or the old ones where it would invert a triangle.
    fn predict(&self, question: &Question, x: &[f64], step: &[f64]) -> Vec<f64> {
        let n = x.len();
        let mut dx = vec![0.0; n];
        for (column, d) in self.columns.chunks_exact(n).zip(step) {
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
