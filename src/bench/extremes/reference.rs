//! Answers with 25 digits and more, to measure the solver's against.
//!
//! The gradient of eq. 1 is written here once more, from the paper, in double-double arithmetic and straight from the problem
//! file; nothing is shared with the solver but the arithmetic. Newton's method starts at the solver's answer; its matrix is a
//! difference quotient of that gradient, so an error in the solver's Hessian cannot hide either.

use crate::physics::DoubleDouble;
use crate::problem::Problem;
use nalgebra::{DMatrix, DVector};

/// An equilibrium to some 25 digits, and how hard it was to find.
pub struct Reference {
    pub x: Vec<[f64; 2]>,
    /// Tension of every element.
    pub tensions: Vec<f64>,
    /// Ratio of the largest to the smallest eigenvalue of the Hessian; without those of free rigid motions.
    pub condition: f64,
}

/// Newton steps at most: the start is an answer already.
const STEPS: usize = 12;
/// A step below this part of the body ends the search.
const CONVERGED: f64 = 1e-24;
const CONVERGED_FREE: f64 = 1e-17;
/// Step of the difference quotients, as a part of the body: half of the digits.
const DIFFERENCE: f64 = 1e-15;
/// Stiffness, as a part of the shear modulus, that holds free rigid motions while a step is computed.
const HELD: f64 = 1e-10;
/// Below this part of the largest an eigenvalue counts as that of a free rigid motion, where there is one.
const RIGID: f64 = 1e-11;
/// Width of a point, as a part of an element's rest length: segments are `sqrt(d^2 + w^2)` long. It is part of the model.
const POINT: f64 = 1e-9;

/// The equilibrium near `from`; `None` where Newton's method does not converge to one.
pub fn near(problem: &Problem, from: &[[f64; 2]], rigid_motions: usize) -> Option<Reference> {
    let terms = terms(problem);
    let size = size(problem);
    let mut x: Vec<DoubleDouble> = from.iter().flatten().map(|&v| v.into()).collect();
    for _ in 0..STEPS {
        let gradient = gradient(&terms, &x);
        let hessian = self::hessian(&terms, &x, DIFFERENCE * size);
        let held = HELD * problem.material.value("mu");
        let mut matrix = hessian.clone();
        if rigid_motions > 0 {
            (0..matrix.nrows()).for_each(|d| matrix[(d, d)] += held);
        }
        let right = DVector::from_iterator(x.len(), gradient.iter().map(|g| g.value()));
        let step = matrix.lu().solve(&right)?;
        x.iter_mut().zip(step.iter()).for_each(|(x, s)| *x = *x - DoubleDouble::from(*s));
        if !x.iter().all(|v| v.is_finite()) {
            return None;
        }
        // Held too weakly, a free motion drifts; what matters there does not.
        let small = if rigid_motions > 0 { CONVERGED_FREE } else { CONVERGED };
        if step.amax() <= small * size {
            let tensions = terms.iter().filter_map(|t| t.tension(&x)).collect();
            let x: Vec<[f64; 2]> = x.chunks_exact(2).map(|p| [p[0].value(), p[1].value()]).collect();
            return Some(Reference { x, tensions, condition: condition(hessian, rigid_motions) });
        }
    }
    None
}

fn condition(hessian: DMatrix<f64>, rigid_motions: usize) -> f64 {
    let mut values: Vec<f64> = hessian.symmetric_eigenvalues().iter().map(|v| v.abs()).collect();
    values.sort_by(f64::total_cmp);
    let largest = values.last().copied().unwrap_or(1.0);
    let free = values.iter().take(rigid_motions).filter(|v| **v < RIGID * largest).count();
    largest / values.get(free).copied().unwrap_or(1.0).max(f64::MIN_POSITIVE)
}

fn size(problem: &Problem) -> f64 {
    let spread = |axis: usize| {
        let values = problem.mesh.nodes.iter().map(|p| p[axis]);
        values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
    };
    spread(0).max(spread(1))
}

/// One term of the energy with all its figures in two words.
enum Term {
    Triangle {
        nodes: [usize; 3],
        inverse: [DoubleDouble; 4],
        area: DoubleDouble,
        mu: DoubleDouble,
        kappa: DoubleDouble,
    },
    Element {
        nodes: Vec<usize>,
        stiffness: DoubleDouble,
        epsilon: DoubleDouble,
        alpha: DoubleDouble,
        point: DoubleDouble,
    },
    Pin {
        node: usize,
        at: [DoubleDouble; 2],
        stiffness: DoubleDouble,
    },
    Weight {
        node: usize,
        force: [DoubleDouble; 2],
    },
}

fn terms(problem: &Problem) -> Vec<Term> {
    let mut terms = Vec::new();
    let [mu, kappa] = [problem.material.value("mu"), problem.material.value("kappa")].map(DoubleDouble::from);
    for t in &problem.mesh.triangles {
        let [p, q, r] = t.map(|n| problem.mesh.nodes[n]);
        let d =
            [0, 1].map(|axis| [DoubleDouble::difference(q[axis], p[axis]), DoubleDouble::difference(r[axis], p[axis])]);
        let twice = d[0][0] * d[1][1] - d[0][1] * d[1][0];
        let inverse = [d[1][1] / twice, -d[1][0] / twice, -d[0][1] / twice, d[0][0] / twice];
        let area = twice * DoubleDouble::from(0.5);
        terms.push(Term::Triangle { nodes: *t, inverse, area, mu, kappa });
        if let (Some(g), Some(density)) = (problem.gravity, problem.surface_density) {
            let mass = area * DoubleDouble::from(density) / DoubleDouble::from(3.0);
            let force = g.map(|g| mass * DoubleDouble::from(g));
            terms.extend(t.iter().map(|&node| Term::Weight { node, force }));
        }
    }
    let contractions = problem.contractions.clone().unwrap_or_else(|| vec![0.0; problem.elements.len()]);
    for (e, c) in problem.elements.iter().zip(contractions) {
        let point = DoubleDouble::from(POINT * e.alpha0).square();
        let [stiffness, epsilon] = [e.stiffness, e.epsilon].map(DoubleDouble::from);
        // The rest length as the solver has it, one word: rounding of what is given is not its error.
        let alpha = DoubleDouble::from(e.alpha0 - c);
        terms.push(Term::Element { nodes: e.routing.clone(), stiffness, epsilon, alpha, point });
    }
    for pin in problem.pins.iter().filter(|p| p.stiffness > 0.0) {
        terms.push(Term::Pin {
            node: pin.node,
            at: pin.target.map(DoubleDouble::from),
            stiffness: pin.stiffness.into(),
        });
    }
    terms
}

impl Term {
    fn nodes(&self) -> &[usize] {
        match self {
            Self::Triangle { nodes, .. } => nodes,
            Self::Element { nodes, .. } => nodes,
            Self::Pin { node, .. } | Self::Weight { node, .. } => std::slice::from_ref(node),
        }
    }

    fn is_linear(&self) -> bool {
        matches!(self, Self::Weight { .. })
    }

    /// The gradient by the coordinates of its nodes, in their order (a node may occur more than once).
    fn gradient(&self, x: &[[DoubleDouble; 2]]) -> Vec<[DoubleDouble; 2]> {
        match self {
            Self::Triangle { inverse, area, mu, kappa, .. } => triangle(x, inverse, *area, *mu, *kappa),
            Self::Element { .. } => self.pull(x).1,
            Self::Pin { at, stiffness, .. } => vec![[0, 1].map(|axis| *stiffness * (x[0][axis] - at[axis]))],
            Self::Weight { force, .. } => vec![force.map(|f| -f)],
        }
    }

    /// Tension and gradient of an element.
    fn pull(&self, x: &[[DoubleDouble; 2]]) -> (DoubleDouble, Vec<[DoubleDouble; 2]>) {
        let Self::Element { stiffness, epsilon, alpha, point, .. } = self else {
            return (DoubleDouble::ZERO, Vec::new());
        };
        let mut by_length = vec![[DoubleDouble::ZERO; 2]; x.len()];
        let mut length = DoubleDouble::ZERO;
        for k in 1..x.len() {
            let d = [0, 1].map(|axis| x[k][axis] - x[k - 1][axis]);
            let l = (d[0].square() + d[1].square() + *point).sqrt();
            length = length + l;
            for axis in 0..2 {
                by_length[k][axis] = by_length[k][axis] + d[axis] / l;
                by_length[k - 1][axis] = by_length[k - 1][axis] - d[axis] / l;
            }
        }
        let gamma = length - *alpha;
        let two = DoubleDouble::from(2.0);
        let tension = if gamma <= -*epsilon {
            DoubleDouble::ZERO
        } else if gamma <= *epsilon {
            *stiffness / (two * *epsilon) * (gamma + *epsilon).square()
        } else {
            two * *stiffness * gamma
        };
        let gradient = by_length.iter().map(|g| g.map(|v| v * tension)).collect();
        (tension, gradient)
    }

    fn tension(&self, x: &[DoubleDouble]) -> Option<f64> {
        matches!(self, Self::Element { .. }).then(|| self.pull(&gather(self.nodes(), x)).0.value())
    }
}

/// `A P b_a` with `P = mu F + (kappa ln J - mu) F^-T`.
fn triangle(
    x: &[[DoubleDouble; 2]],
    inverse: &[DoubleDouble; 4],
    area: DoubleDouble,
    mu: DoubleDouble,
    kappa: DoubleDouble,
) -> Vec<[DoubleDouble; 2]> {
    // Columns of the deformed edges, then F = d D^-1, entries by row and column.
    let edge = |k: usize, row: usize| x[k][row] - x[0][row];
    let f = |row: usize, column: usize| edge(1, row) * inverse[2 * column] + edge(2, row) * inverse[2 * column + 1];
    let f = [[f(0, 0), f(0, 1)], [f(1, 0), f(1, 1)]];
    let j = f[0][0] * f[1][1] - f[0][1] * f[1][0];
    let c = (kappa * j.ln() - mu) / j;
    let cofactor = [[f[1][1], -f[1][0]], [-f[0][1], f[0][0]]];
    let p = [0, 1].map(|row| [0, 1].map(|column| area * (mu * f[row][column] + c * cofactor[row][column])));
    let by = |corner: usize| [0, 1].map(|row| p[row][0] * inverse[corner] + p[row][1] * inverse[2 + corner]);
    let (second, third) = (by(0), by(1));
    vec![[0, 1].map(|row| -(second[row] + third[row])), second, third]
}

fn gather(nodes: &[usize], x: &[DoubleDouble]) -> Vec<[DoubleDouble; 2]> {
    nodes.iter().map(|&n| [x[2 * n], x[2 * n + 1]]).collect()
}

fn gradient(terms: &[Term], x: &[DoubleDouble]) -> Vec<DoubleDouble> {
    let mut out = vec![DoubleDouble::ZERO; x.len()];
    for term in terms {
        for (&n, g) in term.nodes().iter().zip(term.gradient(&gather(term.nodes(), x))) {
            for axis in 0..2 {
                out[2 * n + axis] = out[2 * n + axis] + g[axis];
            }
        }
    }
    out
}

fn hessian(terms: &[Term], x: &[DoubleDouble], h: f64) -> DMatrix<f64> {
    let mut out = DMatrix::zeros(x.len(), x.len());
    for term in terms.iter().filter(|t| !t.is_linear()) {
        let nodes = term.nodes();
        let mut at = gather(nodes, x);
        for (b, &column) in nodes.iter().enumerate() {
            for axis in 0..2 {
                let here = at[b][axis];
                at[b][axis] = here + DoubleDouble::from(h);
                let plus = term.gradient(&at);
                at[b][axis] = here - DoubleDouble::from(h);
                let minus = term.gradient(&at);
                at[b][axis] = here;
                for ((&row, p), m) in nodes.iter().zip(&plus).zip(&minus) {
                    for i in 0..2 {
                        out[(2 * row + i, 2 * column + axis)] += (p[i] - m[i]).value() / (2.0 * h);
                    }
                }
            }
        }
    }
    (&out + out.transpose()) * 0.5
}
