//! What each free winch contributes to the optimality conditions: sparse rows over the nodes that its elements pass.

use super::form::Form;
use crate::physics::{Element, Energy};
use crate::soft_ik::{Actuation, Question};

/// The fixed structure: for every free winch, the distinct nodes of its elements, ascending.
pub(super) struct Stencils {
    starts: Vec<usize>,
    nodes: Vec<usize>,
}

/// The values at a state. Two numbers a node of the winch's stencil.
#[derive(Default)]
pub(super) struct Rows {
    /// `d2L/dbeta dx`, exact, and without the concave part of the elements' own law.
    pub bend: [Vec<f64>; 2],
    /// `d2E/dbeta dx`, the unbalanced force that a change of `beta` makes.
    pub force: Vec<f64>,
    /// `d2L/dbeta^2` of the explicit terms alone: `lambda sum (r/alpha_0)^2`.
    pub explicit: Vec<f64>,
    /// The change of the tangent's part in it: exact, and where that is not negative.
    pub change: [Vec<f64>; 2],
    /// `U''' G p` of every element where the Lagrangian is concave in its deformation, else zero.
    pub concave: Vec<f64>,
}

impl Stencils {
    pub fn new(question: &Question) -> Self {
        let (mut starts, mut nodes) = (vec![0], Vec::new());
        for winch in &question.actuation.winches {
            let first = nodes.len();
            for &(e, _) in &winch.members {
                nodes.extend_from_slice(question.model.contractile.stencil(e));
            }
            nodes[first..].sort_unstable();
            let mut kept = first;
            for k in first..nodes.len() {
                if k == first || nodes[k] != nodes[kept - 1] {
                    nodes[kept] = nodes[k];
                    kept += 1;
                }
            }
            nodes.truncate(kept);
            starts.push(kept);
        }
        Self { starts, nodes }
    }

    pub fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// The distinct nodes of winch `j`.
    pub fn nodes(&self, j: usize) -> &[usize] {
        &self.nodes[self.starts[j]..self.starts[j + 1]]
    }

    /// Where the entries of winch `j` stand in `Rows`.
    pub fn entries(&self, j: usize) -> std::ops::Range<usize> {
        2 * self.starts[j]..2 * self.starts[j + 1]
    }
}

impl Rows {
    /// At `x` with all elements springs at `contractions`; `p = H^-1 dO/dx`.
    pub fn update(&mut self, stencils: &Stencils, question: &Question, x: &[f64], contractions: &[f64], p: &[f64]) {
        let length = 2 * stencils.nodes.len();
        for list in self.bend.iter_mut().chain([&mut self.force]) {
            list.clear();
            list.resize(length, 0.0);
        }
        self.explicit.clear();
        self.change.iter_mut().for_each(Vec::clear);
        let elements = &question.model.contractile.elements;
        self.concave.clear();
        self.concave.resize(elements.len(), 0.0);
        let lambda = question.objective.contraction_weight;
        for (j, winch) in question.actuation.winches.iter().enumerate() {
            let (nodes, entries) = (stencils.nodes(j), stencils.entries(j));
            let force = &mut self.force[entries.clone()];
            let [bend, convex] = &mut self.bend;
            let (bend, convex) = (&mut bend[entries.clone()], &mut convex[entries]);
            let (mut explicit, mut change, mut convex_change) = (0.0, 0.0, 0.0);
            for &(e, ratio) in &winch.members {
                let element = &elements[e];
                let gamma = element.length(x) - element.alpha0 + contractions[e];
                let tangent = element.tangent(gamma);
                let third = third_derivative(element, gamma) * element.length_rate(x, p);
                explicit += lambda * (ratio / element.alpha0).powi(2);
                change -= ratio * ratio * third;
                convex_change -= ratio * ratio * third.min(0.0);
                self.concave[e] = third.max(0.0);
                if tangent != 0.0 {
                    add_row(element, nodes, x, p, ratio, [tangent, third], force, [bend, convex]);
                }
            }
            self.explicit.push(explicit);
            self.change[0].push(change);
            self.change[1].push(convex_change);
        }
    }

    /// `d2L/dbeta_j^2`.
    pub fn weight(&self, j: usize, form: Form) -> f64 {
        self.explicit[j] + form.index().map_or(0.0, |k| self.change[k][j])
    }

    /// `bend . dx + force . dp` of winch `j`, with `z` holding `dx` and `dp` node by node.
    pub fn product(&self, stencils: &Stencils, j: usize, z: &[f64], form: Form) -> f64 {
        let (nodes, entries) = (stencils.nodes(j), stencils.entries(j));
        let force = &self.force[entries.clone()];
        let bend = form.index().map(|k| &self.bend[k][entries]);
        let mut sum = 0.0;
        for (k, &n) in nodes.iter().enumerate() {
            let at = 4 * n;
            sum += force[2 * k] * z[at + 2] + force[2 * k + 1] * z[at + 3];
            if let Some(bend) = bend {
                sum += bend[2 * k] * z[at] + bend[2 * k + 1] * z[at + 1];
            }
        }
        sum
    }

    /// Adds `factor` times the row of winch `j` to `z`.
    pub fn add(&self, stencils: &Stencils, j: usize, factor: f64, z: &mut [f64], form: Form) {
        let (nodes, entries) = (stencils.nodes(j), stencils.entries(j));
        let force = &self.force[entries.clone()];
        let bend = form.index().map(|k| &self.bend[k][entries]);
        for (k, &n) in nodes.iter().enumerate() {
            let at = 4 * n;
            z[at + 2] += factor * force[2 * k];
            z[at + 3] += factor * force[2 * k + 1];
            if let Some(bend) = bend {
                z[at] += factor * bend[2 * k];
                z[at + 1] += factor * bend[2 * k + 1];
            }
        }
    }
}

/// `U'''(Gamma)`; zero at its jumps.
fn third_derivative(element: &Element, gamma: f64) -> f64 {
    if gamma.abs() < element.epsilon { element.stiffness / element.epsilon } else { 0.0 }
}

/// Adds an element's `r U'' G` to `force`, and `-r (U''' (G p) G + U'' d2l p)` to the first of the others; to the second only where
/// `U''' (G p)`, given as `third`, is not positive.
#[allow(clippy::too_many_arguments)]
fn add_row(
    element: &Element,
    nodes: &[usize],
    x: &[f64],
    p: &[f64],
    ratio: f64,
    [tangent, third]: [f64; 2],
    force: &mut [f64],
    [bend, convex]: [&mut [f64]; 2],
) {
    let point = element.point();
    for s in element.routing.windows(2) {
        let difference = |field: &[f64]| {
            let (a, b) = (s[0].at(field), s[1].at(field));
            [b[0] - a[0], b[1] - a[1]]
        };
        let (d, v) = (difference(x), difference(p));
        let length = (d[0] * d[0] + d[1] * d[1] + point * point).sqrt();
        let u = d.map(|v| v / length);
        let along = u[0] * v[0] + u[1] * v[1];
        let ends = s.iter().zip([-1.0, 1.0]);
        for (n, part) in ends.flat_map(|(end, sign)| end.parts().map(move |(n, w)| (n, sign * w))) {
            let at = 2 * nodes.partition_point(|m| *m < n);
            for axis in 0..2 {
                let pull = ratio * tangent * u[axis];
                let turn = tangent * (v[axis] - along * u[axis]) / length;
                force[at + axis] += part * pull;
                for (list, third) in [(&mut *bend, third), (&mut *convex, third.min(0.0))] {
                    list[at + axis] += part * (-ratio * (third * u[axis] + turn));
                }
            }
        }
    }
}

/// A length that belongs to each winch, by which a derivative by its activation is multiplied: the longest initial rest length
/// of its elements, per unit of its ratio.
pub(super) fn lengths(actuation: &Actuation, elements: &[Element]) -> Vec<f64> {
    let of =
        |w: &crate::soft_ik::Winch| w.members.iter().map(|&(e, r)| elements[e].alpha0 / r.abs()).fold(0.0, f64::max);
    actuation.winches.iter().map(of).collect()
}
