//! Closed forms: states that need no solver, or only one equation in one unknown.

use crate::physics::DoubleDouble;
use crate::problem::{Problem, Statics};

/// Halvings of an interval: all digits of a double-double.
const HALVINGS: usize = 220;

/// The root of a falling or rising function in an interval where it changes sign.
pub fn root(function: impl Fn(DoubleDouble) -> DoubleDouble, low: f64, high: f64) -> DoubleDouble {
    let (mut low, mut high) = (DoubleDouble::from(low), DoubleDouble::from(high));
    let sign = |v: DoubleDouble| v < DoubleDouble::ZERO;
    let at_low = sign(function(low));
    for _ in 0..HALVINGS {
        let middle = (low + high) * DoubleDouble::from(0.5);
        if sign(function(middle)) == at_low { low = middle } else { high = middle }
    }
    (low + high) * DoubleDouble::from(0.5)
}

/// The unit square of two triangles with one element on its diagonal, nothing held: it stretches by `a` along the element and
/// by `b` across. No force acts across, so `mu (b^2 - 1) + kappa ln(a b) = 0`; along it
/// `mu (a^2 - b^2)/a + sqrt(2) U'(sqrt(2) a - alpha) = 0`, the square's area being 1.
#[derive(Clone, Copy, Debug)]
pub struct Diagonal {
    pub mu: f64,
    pub kappa: f64,
    pub stiffness: f64,
    pub epsilon: f64,
    pub alpha: f64,
}

impl Diagonal {
    /// Of a square with one element from node 0 to node 2.
    pub fn of(problem: &Problem) -> Option<Self> {
        let (element, contraction) = (problem.elements.first()?, *problem.contractions.as_ref()?.first()?);
        Some(Self {
            mu: problem.material.value("mu"),
            kappa: problem.material.value("kappa"),
            stiffness: element.stiffness,
            epsilon: element.epsilon,
            alpha: element.alpha0 - contraction,
        })
    }

    /// `(a, b)`.
    pub fn stretches(&self) -> (DoubleDouble, DoubleDouble) {
        let along = |a: DoubleDouble| self.along(a, self.across(a));
        let a = root(along, 1e-3, 50.0);
        (a, self.across(a))
    }

    /// `b` without force across. With `kappa = 0` it is 1.
    fn across(&self, a: DoubleDouble) -> DoubleDouble {
        let (mu, kappa) = (DoubleDouble::from(self.mu), DoubleDouble::from(self.kappa));
        root(|b| mu * (b.square() - DoubleDouble::ONE) + kappa * (a * b).ln(), 1e-4, 1e4)
    }

    fn along(&self, a: DoubleDouble, b: DoubleDouble) -> DoubleDouble {
        let root_two = DoubleDouble::from(2.0).sqrt();
        let gamma = root_two * a - DoubleDouble::from(self.alpha);
        let (k, eps, two) =
            (DoubleDouble::from(self.stiffness), DoubleDouble::from(self.epsilon), DoubleDouble::from(2.0));
        let tension = if gamma <= -eps {
            DoubleDouble::ZERO
        } else if gamma <= eps {
            k / (two * eps) * (gamma + eps).square()
        } else {
            two * k * gamma
        };
        DoubleDouble::from(self.mu) * (a.square() - b.square()) / a + root_two * tension
    }

    /// Error of an answer: of both diagonals, as a part of the diagonal.
    pub fn error(&self, answer: &Statics) -> f64 {
        let (a, b) = self.stretches();
        let length = |i: usize, j: usize| {
            let [dx, dy] = [0, 1].map(|axis| DoubleDouble::difference(answer.x[i][axis], answer.x[j][axis]));
            (dx.square() + dy.square()).sqrt() / DoubleDouble::from(2.0).sqrt()
        };
        (length(0, 2) - a).abs().value().max((length(1, 3) - b).abs().value())
    }
}

/// The pins that hold a homogeneous deformation `x = F X` exactly, however soft they are: each stands off its node by the force
/// it must give there, divided by its stiffness.
///
/// In the interior the nodal forces of a constant stress cancel; at the boundary they are `P N` times half the sides there.
pub fn hold_affine(problem: &mut Problem, f: [[f64; 2]; 2], stiffness: f64) {
    let (mu, kappa) = (problem.material.value("mu"), problem.material.value("kappa"));
    let j = f[0][0] * f[1][1] - f[0][1] * f[1][0];
    let c = (kappa * j.ln() - mu) / j;
    let p = [
        [mu * f[0][0] + c * f[1][1], mu * f[0][1] - c * f[1][0]],
        [mu * f[1][0] - c * f[0][1], mu * f[1][1] + c * f[0][0]],
    ];
    let nodes = &problem.mesh.nodes;
    let mut forces = vec![[0.0; 2]; nodes.len()];
    for [from, to] in boundary(problem) {
        let [dx, dy] = [0, 1].map(|axis| nodes[to][axis] - nodes[from][axis]);
        // The outward normal of a side walked with the body on its left, times its length.
        let normal = [dy, -dx];
        for node in [from, to] {
            for axis in 0..2 {
                forces[node][axis] += 0.5 * (p[axis][0] * normal[0] + p[axis][1] * normal[1]);
            }
        }
    }
    let mut held: Vec<usize> = boundary(problem).iter().map(|side| side[0]).collect();
    held.sort_unstable();
    problem.pins.clear();
    for node in held {
        let [x, y] = affine(f, problem.mesh.nodes[node]);
        let target = [x + forces[node][0] / stiffness, y + forces[node][1] / stiffness];
        problem.pins.push(crate::problem::file::PinData { node, target, stiffness });
    }
}

/// `F X`.
pub fn affine(f: [[f64; 2]; 2], p: [f64; 2]) -> [f64; 2] {
    [f[0][0] * p[0] + f[0][1] * p[1], f[1][0] * p[0] + f[1][1] * p[1]]
}

/// Largest distance from `F X`, as a part of the body length.
pub fn affine_error(problem: &Problem, f: [[f64; 2]; 2]) -> impl Fn(&Statics) -> f64 + 'static {
    let expected: Vec<[f64; 2]> = problem.mesh.nodes.iter().map(|p| affine(f, *p)).collect();
    let size = super::measure::size(problem);
    move |answer| {
        let distance = answer.x.iter().zip(&expected).map(|(p, q)| (p[0] - q[0]).hypot(p[1] - q[1]));
        distance.fold(0.0, f64::max) / size
    }
}

/// Sides that belong to one triangle only, in its sense of rotation.
fn boundary(problem: &Problem) -> Vec<[usize; 2]> {
    let sides: Vec<[usize; 2]> =
        problem.mesh.triangles.iter().flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]]).collect();
    sides.iter().copied().filter(|[a, b]| !sides.contains(&[*b, *a])).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_have_all_digits() {
        let found = root(|x| x.square() - DoubleDouble::from(2.0), 0.0, 2.0);
        assert!((found - DoubleDouble::from(2.0).sqrt()).abs().value() < 1e-30);
    }

    #[test]
    fn without_an_element_the_square_stays_as_it_is() {
        let square = Diagonal { mu: 1.0, kappa: 3.0, stiffness: 0.0, epsilon: 0.1, alpha: 1.0 };
        let (a, b) = square.stretches();
        assert!((a - DoubleDouble::ONE).abs().value() < 1e-28 && (b - DoubleDouble::ONE).abs().value() < 1e-28);
    }
}
