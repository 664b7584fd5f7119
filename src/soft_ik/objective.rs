//! The posing objective `O` and its derivatives by `x`.

use super::actuation::Actuation;
use crate::physics::Element;

/// A point of the body and its goal.
#[derive(Clone, Debug, PartialEq)]
pub struct PointTarget {
    pub nodes: Vec<usize>,
    /// Weights of the nodes, which sum to one.
    pub weights: Vec<f64>,
    /// `x'`.
    pub goal: [f64; 2],
    /// `q`.
    pub weight: f64,
}

#[derive(Clone, Debug, Default, PartialEq)]
pub struct Objective {
    pub targets: Vec<PointTarget>,
    /// `q_i` of every node towards its rest position.
    pub rest_weights: Vec<f64>,
    /// `X`, flat.
    pub rest: Vec<f64>,
    /// `lambda`, on the squared relative contraction of all elements.
    pub contraction_weight: f64,
    /// `rho`, on the squared tension of the free elements.
    pub tension_weight: f64,
}

impl PointTarget {
    /// `S x - x'`.
    pub fn offset(&self, x: &[f64]) -> [f64; 2] {
        let mut out = [-self.goal[0], -self.goal[1]];
        for (&n, w) in self.nodes.iter().zip(&self.weights) {
            out[0] += w * x[2 * n];
            out[1] += w * x[2 * n + 1];
        }
        out
    }
}

impl Objective {
    /// The part of `O` that depends on positions alone.
    pub fn position_value(&self, x: &[f64]) -> f64 {
        let mut sum = 0.0;
        for t in &self.targets {
            let [dx, dy] = t.offset(x);
            sum += t.weight * (dx * dx + dy * dy);
        }
        for (i, q) in self.rest_weights.iter().enumerate() {
            if *q > 0.0 {
                let (dx, dy) = (x[2 * i] - self.rest[2 * i], x[2 * i + 1] - self.rest[2 * i + 1]);
                sum += q * (dx * dx + dy * dy);
            }
        }
        0.5 * sum
    }

    /// `O` at positions, contractions of all elements and their tensions.
    pub fn value(
        &self,
        x: &[f64],
        elements: &[Element],
        contractions: &[f64],
        tensions: &[f64],
        actuation: &Actuation,
    ) -> f64 {
        let mut value = self.position_value(x);
        if self.contraction_weight > 0.0 {
            let sum: f64 = elements.iter().zip(contractions).map(|(e, c)| (c / e.alpha0).powi(2)).sum();
            value += 0.5 * self.contraction_weight * sum;
        }
        if self.tension_weight > 0.0 {
            let free = actuation.winches.iter().flat_map(|w| &w.members);
            value += 0.5 * self.tension_weight * free.map(|&(e, _)| tensions[e] * tensions[e]).sum::<f64>();
        }
        if value.is_nan() { f64::INFINITY } else { value }
    }

    /// `dO/dx` of the position part, into `out`.
    pub fn position_gradient(&self, x: &[f64], out: &mut [f64]) {
        self.rest_gradient(x, out);
        for t in &self.targets {
            let offset = t.offset(x);
            for (&n, w) in t.nodes.iter().zip(&t.weights) {
                out[2 * n] += t.weight * w * offset[0];
                out[2 * n + 1] += t.weight * w * offset[1];
            }
        }
    }

    /// `Q (x - X)`, the pull towards rest, into `out`.
    pub fn rest_gradient(&self, x: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        for (i, q) in self.rest_weights.iter().enumerate() {
            for d in [2 * i, 2 * i + 1] {
                out[d] = q * (x[d] - self.rest[d]);
            }
        }
    }

    /// Adds `Q dx`, by how much `dO/dx` of the position part changes.
    pub fn add_position_curvature(&self, dx: &[f64], out: &mut [f64]) {
        for (i, q) in self.rest_weights.iter().enumerate() {
            out[2 * i] += q * dx[2 * i];
            out[2 * i + 1] += q * dx[2 * i + 1];
        }
        for t in &self.targets {
            for axis in 0..2 {
                let parts = || t.nodes.iter().zip(&t.weights);
                let moved: f64 = parts().map(|(&n, w)| w * dx[2 * n + axis]).sum();
                parts().for_each(|(&n, w)| out[2 * n + axis] += t.weight * w * moved);
            }
        }
    }

    /// Root mean square distance of the targets, unweighted; zero without targets.
    pub fn target_error(&self, x: &[f64]) -> f64 {
        if self.targets.is_empty() {
            return 0.0;
        }
        let sum: f64 = self.targets.iter().map(|t| t.offset(x)).map(|[dx, dy]| dx * dx + dy * dy).sum();
        (sum / self.targets.len() as f64).sqrt()
    }
}
