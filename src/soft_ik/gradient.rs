//! The paper's Algorithm 1: gradient descent on `xi` with a linearised line search (section 5.7).
//!
//! `beta_j = f_j(xi_j)` with `f(xi) = beta_max - U(-xi)`: eq. 8 reflected and raised (section 5.6), its constants `eps_f`,
//! `K_f` its own. `f' = 0` in the saturated zone, as printed: there, and where elements are slack, the method may
//! stall. It is the baseline that the other methods are measured against.

use super::sensitivity::gradient;
use super::{Answer, Budget, Method, Posture, Question};
use crate::physics::HessianForm;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gradient {
    /// `eps_f` as a fraction of `beta_max`.
    pub epsilon_fraction: f64,
    /// Stops when an iteration gains less than this part of `O`.
    pub relative_decrease: f64,
}

impl Default for Gradient {
    fn default() -> Self {
        Self { epsilon_fraction: 0.05, relative_decrease: 1e-12 }
    }
}

/// Halvings of `gamma` before the iteration counts as stalled.
const MAX_HALVINGS: usize = 30;

/// `f(xi)` of one winch: bounded above by `top`, linear with slope 1 far below, quadratic towards the bound.
#[derive(Clone, Copy)]
struct Reparametrisation {
    /// `beta_max`; infinite for the identity.
    top: f64,
    epsilon: f64,
    stiffness: f64,
}

impl Reparametrisation {
    /// `U(s)` and `U'(s)` of eq. 8 with this `K` and `eps`.
    fn unilateral(&self, s: f64) -> (f64, f64) {
        let (k, eps) = (self.stiffness, self.epsilon);
        if s <= -eps {
            (0.0, 0.0)
        } else if s <= eps {
            (k / (6.0 * eps) * (s + eps).powi(3), k / (2.0 * eps) * (s + eps).powi(2))
        } else {
            (k * s * s + k * eps * eps / 3.0, 2.0 * k * s)
        }
    }

    /// `(f, f')`; `f` falls from `beta_max` as `xi` falls.
    fn at(&self, xi: f64) -> (f64, f64) {
        if !self.top.is_finite() || self.top <= 0.0 {
            return if self.top.is_finite() { (xi.min(self.top), (xi < self.top) as u8 as f64) } else { (xi, 1.0) };
        }
        let (u, du) = self.unilateral(-xi);
        (self.top - u, du)
    }

    /// `xi` with `f(xi) = beta`, by bisection; the edge of the saturated zone for `beta >= beta_max`.
    fn inverse(&self, beta: f64) -> f64 {
        if !self.top.is_finite() || self.top <= 0.0 {
            return beta;
        }
        let (mut low, mut high) = (-1.0_f64.max(self.top), self.epsilon);
        while self.at(low).0 > beta {
            low *= 2.0;
        }
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if self.at(middle).0 < beta { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }
}

impl Method for Gradient {
    fn name(&self) -> &'static str {
        "gradient"
    }

    fn solve(&self, question: &mut Question, start: &Posture, budget: &Budget) -> Answer {
        let maps: Vec<Reparametrisation> = question
            .actuation
            .winches
            .iter()
            .map(|w| Reparametrisation {
                top: w.upper,
                epsilon: self.epsilon_fraction * w.upper.abs(),
                stiffness: 1.0 / w.upper.abs(),
            })
            .collect();
        let mut xi: Vec<f64> = maps.iter().zip(&start.beta).map(|(f, b)| f.inverse(*b)).collect();
        let mut best = start.clone();
        let mut answer = Answer::at(&best);
        while answer.iterations < budget.iterations && !(budget.stop)() {
            answer.iterations += 1;
            answer.factorizations += 1;
            let contractions = question.actuation.contractions(&best.beta);
            question.model.contractile.set_contractions(&contractions);
            let Some(total) = gradient(question, &best.x, &contractions) else { break };
            let slopes: Vec<f64> = maps.iter().zip(&xi).map(|(f, v)| f.at(*v).1).collect();
            let direction: Vec<f64> = total.by_activation.iter().zip(&slopes).map(|(g, s)| -g * s).collect();
            let Some(mut gamma) = linearised_step(question, &best, &direction, &slopes) else {
                answer.converged = true;
                break;
            };
            let mut accepted = false;
            for _ in 0..MAX_HALVINGS {
                let trial_xi: Vec<f64> = xi.iter().zip(&direction).map(|(v, d)| v + gamma * d).collect();
                let mut beta: Vec<f64> = maps.iter().zip(&trial_xi).map(|(f, v)| f.at(*v).0).collect();
                question.actuation.clamp(&mut beta);
                let (trial, factorizations) = question.settle(&beta, &best.x, budget.stop);
                answer.factorizations += factorizations;
                if trial.in_equilibrium() && trial.objective < best.objective {
                    answer.converged = best.objective - trial.objective < self.relative_decrease * best.objective;
                    best = trial;
                    xi = trial_xi;
                    accepted = true;
                    break;
                }
                gamma *= 0.5;
            }
            if !accepted || answer.converged {
                break;
            }
        }
        let contractions = question.actuation.contractions(&best.beta);
        question.model.contractile.set_contractions(&contractions);
        answer.posture = best;
        answer
    }
}

/// `gamma` that minimises `O` with `x` linearised in `xi` (eq. 32): closed form, since `O` is then quadratic.
fn linearised_step(question: &mut Question, at: &Posture, direction: &[f64], slopes: &[f64]) -> Option<f64> {
    let tangents: Vec<f64> = question
        .model
        .contractile
        .elements
        .iter()
        .zip(&question.model.contractile.laws)
        .map(|(e, law)| law.tension_and_tangent(e, e.length(&at.x)).1)
        .collect();
    let dbeta: Vec<f64> = direction.iter().zip(slopes).map(|(d, s)| d * s).collect();
    let dalpha = question.actuation.contractions(&dbeta);
    let mut dx = vec![0.0; at.x.len()];
    let moving: Vec<usize> =
        question.actuation.winches.iter().flat_map(|w| w.members.iter().map(|&(e, _)| e)).collect();
    for &e in &moving {
        question.model.contractile.elements[e].add_length_gradient(&at.x, -tangents[e] * dalpha[e], &mut dx);
    }
    question.model.factorize(&at.x, HessianForm::Exact).ok()?;
    question.model.solve(&mut dx);
    let objective = question.objective;
    let (mut slope, mut curvature) = (0.0, 0.0);
    for t in &objective.targets {
        let offset = t.offset(&at.x);
        for axis in 0..2 {
            let rate: f64 = t.nodes.iter().zip(&t.weights).map(|(n, w)| w * dx[2 * n + axis]).sum();
            slope += t.weight * offset[axis] * rate;
            curvature += t.weight * rate * rate;
        }
    }
    for (d, rate) in dx.iter().enumerate() {
        let q = objective.rest_weights[d / 2];
        slope += q * (at.x[d] - objective.rest[d]) * rate;
        curvature += q * rate * rate;
    }
    let contractions = question.actuation.contractions(&at.beta);
    let tensions = question.model.contractile.tensions(&at.x);
    for &e in &moving {
        let element = &question.model.contractile.elements[e];
        let by = objective.contraction_weight / (element.alpha0 * element.alpha0);
        slope += by * contractions[e] * dalpha[e];
        curvature += by * dalpha[e] * dalpha[e];
        let rate = tangents[e] * (element.length_rate(&at.x, &dx) + dalpha[e]);
        slope += objective.tension_weight * tensions[e] * rate;
        curvature += objective.tension_weight * rate * rate;
    }
    (slope < 0.0 && curvature > 0.0).then(|| -slope / curvature)
}
