//! Exact sensitivities by where cables run: the rest positions of the points of their routings.
//!
//! A routing point at the rest position `P` of a triangle with shape functions `N_i` is at `p = sum N_i(P) x_i`, so that
//! `dp/dP = F`, and pulls on the node `i` with the part `N_i(P)`. The rest length of the element follows, `alpha = l^X(P) + ...`:
//! a cable is cut for its routing. With `dE/dx = 0` and `Gamma = l(x, P) - alpha(P)`:
//!
//! ```text
//! H dx/dP = -( U'' dGamma/dP grad l + tau d(grad l)/dP )
//! ```

use super::Question;
use crate::physics::Element;

/// A point at which elements pass the body, and that can be moved in its triangle.
#[derive(Clone, Debug, PartialEq)]
pub struct RoutingPoint {
    pub triangle: usize,
    pub nodes: [usize; 3],
    /// `dN_i/dP`, 1/length.
    pub gradients: [[f64; 2]; 3],
    /// Elements that pass it, and where in their routings; those of one element next to each other.
    pub passes: Vec<(usize, usize)>,
}

impl RoutingPoint {
    /// The point in triangle `triangle` of a body at rest.
    pub fn new(triangle: usize, nodes: [usize; 3], rest: &[f64], passes: Vec<(usize, usize)>) -> Self {
        let [a, b, c] = nodes.map(|n| [rest[2 * n], rest[2 * n + 1]]);
        let doubled = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        let opposite = [(b, c), (c, a), (a, b)];
        let gradients = opposite.map(|(p, q)| [(p[1] - q[1]) / doubled, (q[0] - p[0]) / doubled]);
        Self { triangle, nodes, gradients, passes }
    }

    /// `dp/dP` along an axis of the rest plane, of a field that has two entries a node: a column of `F` for coordinates.
    fn moved(&self, field: &[f64], axis: usize) -> [f64; 2] {
        let part = |k: usize, d: usize| self.gradients[k][axis] * field[2 * self.nodes[k] + d];
        [0, 1].map(|d| part(0, d) + part(1, d) + part(2, d))
    }
}

/// Right-hand sides of `H dx/dP`, `-d(dE/dx)/dP`, by both axes of every point, column after column: all elements springs under the
/// `tensions` and with the tangents that they have at `x`.
pub fn force_columns(question: &Question, x: &[f64], laws: &[(f64, f64)], points: &[RoutingPoint]) -> Vec<f64> {
    let n = x.len();
    let mut columns = vec![0.0; 2 * points.len() * n];
    for (k, column) in columns.chunks_exact_mut(n.max(1)).enumerate() {
        let (point, axis) = (&points[k / 2], k % 2);
        for passes in point.passes.chunk_by(|a, b| a.0 == b.0) {
            let element = &question.model.contractile.elements[passes[0].0];
            let (tension, tangent) = laws[passes[0].0];
            if tension == 0.0 && tangent == 0.0 {
                continue;
            }
            let rate = stretch_rate(element, passes, point, axis, x, &question.model.rest);
            element.add_length_gradient(x, -tangent * rate, column);
            for &(_, place) in passes {
                add_turned(element, place, point, axis, x, tension, column);
            }
        }
    }
    columns
}

/// `dGamma/dP` along an axis at fixed `x`: how the length at `x` changes beyond that at rest.
fn stretch_rate(
    element: &Element,
    passes: &[(usize, usize)],
    point: &RoutingPoint,
    axis: usize,
    x: &[f64],
    rest: &[f64],
) -> f64 {
    let rate = |field: &[f64]| -> f64 {
        let moved = point.moved(field, axis);
        let pieces = passes.iter().flat_map(|&(_, place)| pieces(element, place));
        pieces.map(|(from, to)| dot(unit(element, from, to, field).0, moved)).sum()
    };
    rate(x) - rate(rest)
}

/// The pieces of an element that end at a place of its routing, each from its far end.
fn pieces(element: &Element, place: usize) -> impl Iterator<Item = (usize, usize)> {
    let before = place.checked_sub(1).map(|other| (other, place));
    let after = (place + 1 < element.routing.len()).then_some((place + 1, place));
    before.into_iter().chain(after)
}

/// Adds `-tau d(grad l)/dP`: the pieces at the point turn, and its force goes to its nodes by other parts.
fn add_turned(
    element: &Element,
    place: usize,
    point: &RoutingPoint,
    axis: usize,
    x: &[f64],
    tension: f64,
    column: &mut [f64],
) {
    let moved = point.moved(x, axis);
    for (from, to) in pieces(element, place) {
        let (u, length) = unit(element, from, to, x);
        let along = dot(u, moved);
        let turn = [0, 1].map(|d| -tension * (moved[d] - along * u[d]) / length);
        element.routing[to].add(turn, column);
        element.routing[from].add(turn.map(|f| -f), column);
        for (node, gradient) in point.nodes.iter().zip(point.gradients) {
            for d in 0..2 {
                column[2 * node + d] -= tension * u[d] * gradient[axis];
            }
        }
    }
}

/// The unit vector of a piece, and its length, between points of the element's width.
fn unit(element: &Element, from: usize, to: usize, field: &[f64]) -> ([f64; 2], f64) {
    let (a, b) = (element.routing[from].at(field), element.routing[to].at(field));
    let (dx, dy, width) = (b[0] - a[0], b[1] - a[1], element.point());
    let length = (dx * dx + dy * dy + width * width).sqrt();
    ([dx / length, dy / length], length)
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// `dO/dP` of every point at the equilibrium `x` at fixed activations, by the adjoint; the exact Hessian at `x` must be factorised.
/// Where the activations are the best ones within their bounds, it is the derivative of the best `O` as well (envelope theorem).
pub fn gradient_with_factor(question: &mut Question, x: &[f64], points: &[RoutingPoint]) -> Vec<[f64; 2]> {
    let elements = &question.model.contractile.elements;
    let laws: Vec<(f64, f64)> = elements
        .iter()
        .zip(&question.model.contractile.laws)
        .map(|(e, law)| law.tension_and_tangent(e, e.length(x)))
        .collect();
    let mut adjoint = vec![0.0; x.len()];
    question.objective.position_gradient(x, &mut adjoint);
    let weight = question.objective.tension_weight;
    let mut free = vec![false; elements.len()];
    for &(e, _) in question.actuation.winches.iter().flat_map(|w| &w.members) {
        free[e] = true;
        elements[e].add_length_gradient(x, weight * laws[e].0 * laws[e].1, &mut adjoint);
    }
    question.model.solve(&mut adjoint);
    let columns = force_columns(question, x, &laws, points);
    let elements = &question.model.contractile.elements;
    let explicit = |point: &RoutingPoint, axis: usize| -> f64 {
        let passes = point.passes.chunk_by(|a, b| a.0 == b.0).filter(|passes| free[passes[0].0]);
        let one = |passes: &[(usize, usize)]| {
            let e = passes[0].0;
            weight * laws[e].0 * laws[e].1 * stretch_rate(&elements[e], passes, point, axis, x, &question.model.rest)
        };
        passes.map(one).sum()
    };
    let column =
        |k: usize| columns[k * x.len()..(k + 1) * x.len()].iter().zip(&adjoint).map(|(f, p)| f * p).sum::<f64>();
    points
        .iter()
        .enumerate()
        .map(|(k, point)| [0, 1].map(|axis| column(2 * k + axis) + explicit(point, axis)))
        .collect()
}
