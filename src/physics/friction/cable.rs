//! A cable at the holes of its routing: turns, weights of its pieces, and their derivatives.

use crate::physics::pattern::Scatter;
use crate::physics::{Element, Model};

/// Turns below this many radians, half a degree, count less than they are, so that the law is smooth where a cable passes a hole
/// straight: `|phi|` becomes `phi^2 (2 - |phi|/R)/R`, which meets it with equal slope at `R`. No turn is off by more than
/// `4/27 R`, no tension by more than a part of `0.0013 mu` a hole. Smaller, and Newton's method sees a corner.
const STRAIGHT: f64 = 0.00873;

/// A cable that rubs.
pub(super) struct Cable {
    /// Its place among the elements of the model.
    pub element: usize,
    pub mu: f64,
    pub pieces: Vec<Piece>,
    /// Width of a point, see [`Element`].
    point: f64,
}

/// The straight cable between two points of a routing: the nodes that its vector `d = sum c_i x_i` depends on, and their parts.
pub(super) struct Piece {
    nodes: Vec<usize>,
    parts: Vec<f64>,
}

/// The turn at a hole: the angle, and its derivatives by the vectors of the pieces before and after.
pub(super) struct Turn {
    pub angle: f64,
    pub by_before: [f64; 2],
    pub by_after: [f64; 2],
}

impl Piece {
    pub fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    /// Its vector.
    fn vector(&self, x: &[f64]) -> [f64; 2] {
        let along = |axis: usize| self.nodes.iter().zip(&self.parts).map(|(n, c)| c * x[2 * n + axis]).sum();
        [along(0), along(1)]
    }

    /// Adds the transpose of [`Self::vector`].
    pub fn add(&self, [fx, fy]: [f64; 2], out: &mut [f64]) {
        for (n, c) in self.nodes.iter().zip(&self.parts) {
            out[2 * n] += c * fx;
            out[2 * n + 1] += c * fy;
        }
    }

    /// [`Self::add`] to a sparse vector.
    pub fn push(&self, [fx, fy]: [f64; 2], out: &mut Vec<(usize, f64)>) {
        for (n, c) in self.nodes.iter().zip(&self.parts) {
            out.extend([(2 * n, c * fx), (2 * n + 1, c * fy)]);
        }
    }
}

impl Cable {
    pub fn new(element: usize, of: &Element, mu: f64) -> Self {
        let pieces = of.routing.windows(2).map(|ends| {
            let mut piece = Piece { nodes: Vec::new(), parts: Vec::new() };
            for (sign, end) in [(-1.0, &ends[0]), (1.0, &ends[1])] {
                for (node, weight) in end.parts() {
                    match piece.nodes.iter().position(|n| *n == node) {
                        Some(k) => piece.parts[k] += sign * weight,
                        None => {
                            piece.nodes.push(node);
                            piece.parts.push(sign * weight);
                        }
                    }
                }
            }
            piece
        });
        Self { element, mu, pieces: pieces.collect(), point: of.point() }
    }

    /// `(tau, U'')` at its winch.
    pub fn law(&self, model: &Model, x: &[f64]) -> (f64, f64) {
        let (element, law) = (&model.contractile.elements[self.element], model.contractile.laws[self.element]);
        law.tension_and_tangent(element, element.length(x))
    }

    /// The turns at all holes.
    pub fn turns(&self, x: &[f64]) -> Vec<Turn> {
        let vectors: Vec<[f64; 2]> = self.pieces.iter().map(|p| p.vector(x)).collect();
        vectors.windows(2).map(|d| turn(d[0], d[1], self.point)).collect()
    }

    /// `w_k` of every piece, with a `part` (and sign) of its coefficient.
    pub fn weights(&self, x: &[f64], part: f64) -> Vec<f64> {
        self.weights_of(&self.turns(x), part)
    }

    pub fn weights_of(&self, turns: &[Turn], part: f64) -> Vec<f64> {
        let mut sum = 0.0;
        let behind = turns.iter().map(|turn| {
            sum += turn.angle;
            (-part * self.mu * sum).exp()
        });
        std::iter::once(1.0).chain(behind).collect()
    }

    /// Unit vector of every piece.
    pub fn units(&self, x: &[f64]) -> Vec<[f64; 2]> {
        let unit = |piece: &Piece| {
            let d = piece.vector(x);
            let length = (d[0] * d[0] + d[1] * d[1] + self.point * self.point).sqrt();
            d.map(|v| v / length)
        };
        self.pieces.iter().map(unit).collect()
    }

    /// Adds `tau (g_w - g)`, what friction changes in the force.
    pub fn add_friction(&self, x: &[f64], part: f64, tau: f64, out: &mut [f64]) {
        let weights = self.weights(x, part);
        for ((piece, unit), weight) in self.pieces.iter().zip(self.units(x)).zip(weights) {
            piece.add(unit.map(|u| tau * (weight - 1.0) * u), out);
        }
    }

    /// Adds `tau sum (w_k - 1) d2 l_k`; `first`: the stencil of its first piece.
    pub fn add_curvature(&self, x: &[f64], weights: &[f64], tau: f64, first: usize, out: &mut Scatter) {
        for (k, (piece, weight)) in self.pieces.iter().zip(weights).enumerate() {
            let [dx, dy] = piece.vector(x);
            let squared = dx * dx + dy * dy + self.point * self.point;
            let by = tau * (weight - 1.0) / (squared * squared.sqrt());
            // (I - u u^T) / l.
            let block = [by * (squared - dx * dx), -by * dx * dy, -by * dx * dy, by * (squared - dy * dy)];
            out.add(first + k, |a, b| block.map(|v| piece.parts[a] * piece.parts[b] * v));
        }
    }
}

/// The turn from one vector to the next.
fn turn(before: [f64; 2], after: [f64; 2], point: f64) -> Turn {
    let cross = before[0] * after[1] - before[1] * after[0];
    let along = before[0] * after[0] + before[1] * after[1];
    let (phi, sign) = (cross.abs().atan2(along), if cross < 0.0 { -1.0 } else { 1.0 });
    let (angle, slope) = if phi < STRAIGHT {
        let t = phi / STRAIGHT;
        (phi * t * (2.0 - t), t * (4.0 - 3.0 * t))
    } else {
        (phi, 1.0)
    };
    // The angle of a vector d changes by (-dy, dx) / d^2.
    let by = |d: [f64; 2], factor: f64| {
        let factor = factor / (d[0] * d[0] + d[1] * d[1] + point * point);
        [-d[1] * factor, d[0] * factor]
    };
    Turn { angle, by_before: by(before, -sign * slope), by_after: by(after, sign * slope) }
}
