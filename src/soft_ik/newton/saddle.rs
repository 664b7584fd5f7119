//! The linear system of a Newton step in the contractions.
//!
//! Minimising `O(x, beta)` subject to `g(x, beta) = dE/dx = 0` has the Lagrangian `L = O - p g`, `p = H^-1 dO/dx`. With the state
//! in equilibrium, a step solves
//!
//! ```text
//! [ L_xx  A^T  H ] [ dx   ]     [  0  ]        A = L_beta,x       B = g_beta (rows, transposed)
//! [ A     W    B ] [ dbeta] = - [ L_beta ]     W = L_beta,beta, diagonal, damping included
//! [ H     B^T  0 ] [ -dp  ]     [  0  ]
//! ```
//!
//! Every winch of one element is eliminated by its own row, `dbeta = -(L_beta + u z)/W` with `u = [A_j, B_j]`, `z = [dx, -dp]`;
//! what is left has the sparsity of `H` twice over and is factorised. A winch of several elements would couple all their nodes:
//! it stays as a border. So the reduced Hessian of `O` in the contractions, a dense matrix of the fibres, never appears.
//! Gauss-Newton leaves out what `p` multiplies: `L_xx = Q`, `A = 0`, `W` of the explicit terms alone; its reduced Hessian is
//! never negative. The exact one is positive definite where the saddle-point matrix has as many negative eigenvalues as there
//! are coordinates.

use super::rows::{Rows, Stencils};
use crate::physics::indefinite::Indefinite;
use crate::physics::pattern::{Pattern, Scatter, Slots};
use crate::soft_ik::Question;
use nalgebra::{DMatrix, DVector};

/// The second derivatives in use.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    Exact,
    GaussNewton,
}

/// The optimality conditions linearised at an equilibrium.
#[derive(Default)]
pub(super) struct Local {
    /// `H`, as the model stores it.
    pub hessian: Vec<f64>,
    /// `d(H p)/dx`, likewise.
    pub bend: Vec<f64>,
    /// `dO/dbeta`.
    pub gradient: Vec<f64>,
    pub rows: Rows,
}

/// A step of all winches.
pub(super) struct Step {
    pub beta: Vec<f64>,
    /// First-order displacement.
    pub x: Vec<f64>,
    /// `dO/dbeta . dbeta` and half of `dbeta (reduced Hessian) dbeta`, both without damping.
    pub slope: f64,
    pub curvature: f64,
}

/// The reduced Hessian is not positive definite, or the system could not be solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct NotConvex;

/// Structure, factor and buffers.
pub(super) struct Saddle {
    pattern: Pattern,
    factor: Indefinite,
    pub stencils: Stencils,
    /// Where each stored value of the model's Hessian lands: positions with positions, multipliers with positions, and the mirror
    /// of the latter.
    places: Vec<[u32; 3]>,
    /// Slots of the winches of one element.
    slots: Slots,
    /// Where the weights of the targets land: target, row, column, product of the weights of two of its nodes.
    weights: Vec<(usize, u32, f64)>,
    base: Vec<f64>,
    values: Vec<f64>,
    z: Vec<f64>,
    rest: Vec<f64>,
    product: Vec<f64>,
}

impl Saddle {
    /// `None` only where the factor would not fit into memory.
    pub fn new(question: &Question) -> Option<Self> {
        let stencils = Stencils::new(question);
        let model = &*question.model;
        let nodes = model.dimension() / 2;
        let twice = |list: &[usize]| list.iter().flat_map(|n| [2 * n, 2 * n + 1]).collect::<Vec<usize>>();
        let single: Vec<Vec<usize>> = (0..stencils.count())
            .map(|j| if is_single(question, j) { twice(stencils.nodes(j)) } else { Vec::new() })
            .collect();
        let coupled = coupled(model.pattern());
        let pairs: Vec<Vec<usize>> = coupled.iter().map(|pair| twice(pair)).collect();
        let held: Vec<Vec<usize>> = question.objective.targets.iter().map(|t| twice(&t.nodes)).collect();
        let all = pairs.iter().chain(&single).chain(&held).map(|s| s.as_slice());
        let pattern = Pattern::new(2 * nodes, all);
        let slots = pattern.slots(single.iter().map(|s| s.as_slice()));
        let factor = Indefinite::new(&pattern)?;
        let mut places = Vec::with_capacity(model.pattern().nonzeros());
        let spread = |d: usize| 4 * (d / 2) + d % 2;
        for column in 0..model.dimension() {
            let range = model.pattern().column_starts()[column]..model.pattern().column_starts()[column + 1];
            for &row in &model.pattern().row_indices()[range] {
                let (r, c) = (spread(row), spread(column));
                places.push([(r, c), (r + 2, c), (c + 2, r)].map(|(r, c)| pattern.entry(r, c) as u32));
            }
        }
        let mut weights = Vec::new();
        for (k, target) in question.objective.targets.iter().enumerate() {
            for (a, (&n, v)) in target.nodes.iter().zip(&target.weights).enumerate() {
                for (&m, w) in target.nodes[..=a].iter().zip(&target.weights) {
                    for axis in 0..2 {
                        weights.push((k, pattern.entry(4 * n + axis, 4 * m + axis) as u32, v * w));
                    }
                }
            }
        }
        let n = pattern.dimension();
        let (base, values) = (vec![0.0; pattern.nonzeros()], vec![0.0; pattern.nonzeros()]);
        let (z, rest, product) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        Some(Self { pattern, factor, stencils, places, slots, weights, base, values, z, rest, product })
    }

    /// Puts in what does not depend on which winches are free.
    pub fn assemble(&mut self, question: &Question, local: &Local, form: Form) {
        self.base.fill(0.0);
        let bend = (form == Form::Exact).then_some(&local.bend);
        for (k, (place, h)) in self.places.iter().zip(&local.hessian).enumerate() {
            let [xx, px, xp] = place.map(|p| p as usize);
            if let Some(bend) = bend {
                self.base[xx] -= bend[k];
            }
            self.base[px] += h;
            if xp != px {
                self.base[xp] += h;
            }
        }
        for (i, q) in question.objective.rest_weights.iter().enumerate() {
            for axis in 0..2 {
                self.base[self.pattern.diagonal(4 * i + axis)] += q;
            }
        }
        for &(target, entry, product) in &self.weights {
            self.base[entry as usize] += question.objective.targets[target].weight * product;
        }
    }

    /// The step that minimises the quadratic model with winches `fixed` moved by what stands there and all others free, each
    /// damped by `damping`. Needs [`Self::assemble`] in the same form.
    pub fn solve(
        &mut self,
        question: &Question,
        local: &Local,
        form: Form,
        damping: &[f64],
        fixed: &[Option<f64>],
    ) -> Result<(Step, Vec<f64>), NotConvex> {
        let exact = form == Form::Exact;
        let rows = &local.rows;
        let weight = |j: usize| rows.explicit[j] + if exact { rows.change[j] } else { 0.0 };
        self.values.copy_from_slice(&self.base);
        self.z.fill(0.0);
        let mut border = Vec::new();
        for j in 0..fixed.len() {
            let w = weight(j) + damping[j];
            match fixed[j] {
                Some(moved) => {
                    if moved != 0.0 {
                        rows.add(&self.stencils, j, -moved, &mut self.z, exact);
                    }
                }
                None if !is_single(question, j) => border.push(j),
                None if w > 0.0 => {
                    rows.add(&self.stencils, j, local.gradient[j] / w, &mut self.z, exact);
                    self.eliminate(rows, j, w, exact);
                }
                None => return Err(NotConvex),
            }
        }
        let inertia = self.factor.factorize(&self.pattern, &self.values);
        if inertia.singular > 0 || inertia.negative != self.pattern.dimension() / 2 {
            return Err(NotConvex);
        }
        self.rest.copy_from_slice(&self.z);
        let of_border = self.solve_border(rows, local, &border, |j| weight(j) + damping[j], exact)?;
        let mut beta = vec![0.0; fixed.len()];
        let mut slopes = vec![0.0; fixed.len()];
        let (mut slope, mut curvature) = (0.0, 0.0);
        let mut next = of_border.iter();
        for j in 0..fixed.len() {
            let along = rows.product(&self.stencils, j, &self.z, exact);
            beta[j] = match fixed[j] {
                Some(moved) => moved,
                None if !is_single(question, j) => *next.next().unwrap_or(&0.0),
                None => -(local.gradient[j] + along) / (weight(j) + damping[j]),
            };
            let by_model = along + weight(j) * beta[j];
            slopes[j] = local.gradient[j] + by_model + damping[j] * beta[j];
            slope += local.gradient[j] * beta[j];
            curvature += 0.5 * beta[j] * by_model;
        }
        let x = self.z.chunks_exact(4).flat_map(|c| [c[0], c[1]]).collect();
        if !(slope + curvature).is_finite() {
            return Err(NotConvex);
        }
        Ok((Step { beta, x, slope, curvature }, slopes))
    }

    /// The model at a given step of all winches, with two solves by the factor of `H`; returns the step and the slopes of the damped
    /// model there.
    pub fn evaluate(
        &mut self,
        question: &mut Question,
        local: &Local,
        form: Form,
        damping: &[f64],
        beta: Vec<f64>,
    ) -> (Step, Vec<f64>) {
        let exact = form == Form::Exact;
        let rows = &local.rows;
        // dx = -H^-1 B^T dbeta, then -dp = -H^-1 (L_xx dx + A^T dbeta).
        self.z.fill(0.0);
        for (j, d) in beta.iter().enumerate().filter(|(_, d)| **d != 0.0) {
            rows.add(&self.stencils, j, -d, &mut self.z, false);
        }
        let mut x: Vec<f64> = self.z.chunks_exact(4).flat_map(|c| [c[2], c[3]]).collect();
        question.model.solve(&mut x);
        for (z, x) in self.z.chunks_exact_mut(4).zip(x.chunks_exact(2)) {
            z.copy_from_slice(&[x[0], x[1], 0.0, 0.0]);
        }
        self.pattern.multiply(&self.base, &self.z, &mut self.product);
        if exact {
            for (j, d) in beta.iter().enumerate().filter(|(_, d)| **d != 0.0) {
                rows.add(&self.stencils, j, *d, &mut self.product, true);
            }
        }
        let mut p: Vec<f64> = self.product.chunks_exact(4).flat_map(|c| [-c[0], -c[1]]).collect();
        question.model.solve(&mut p);
        for (z, p) in self.z.chunks_exact_mut(4).zip(p.chunks_exact(2)) {
            z[2..].copy_from_slice(p);
        }
        let (mut slope, mut curvature) = (0.0, 0.0);
        let slopes = (0..beta.len())
            .map(|j| {
                let weight = rows.explicit[j] + if exact { rows.change[j] } else { 0.0 };
                let by_model = rows.product(&self.stencils, j, &self.z, exact) + weight * beta[j];
                slope += local.gradient[j] * beta[j];
                curvature += 0.5 * beta[j] * by_model;
                local.gradient[j] + by_model + damping[j] * beta[j]
            })
            .collect();
        (Step { beta, x, slope, curvature }, slopes)
    }

    /// Coordinates of the body.
    pub fn coordinates(&self) -> usize {
        self.pattern.dimension() / 2
    }

    /// Subtracts `u u^T / w` of winch `j`.
    fn eliminate(&mut self, rows: &Rows, j: usize, w: f64, exact: bool) {
        let entries = self.stencils.entries(j);
        let (bend, force) = (&rows.bend[entries.clone()], &rows.force[entries]);
        let entry = |k: usize| {
            let list = if k % 2 == 0 { bend } else { force };
            let on = if k % 2 == 0 && !exact { 0.0 } else { 1.0 };
            [on * list[k - k % 2], on * list[k - k % 2 + 1]]
        };
        Scatter::new(&self.slots, &mut self.values).add(j, |a, b| {
            let (u, v) = (entry(a), entry(b));
            [u[0] * v[0] / -w, u[0] * v[1] / -w, u[1] * v[0] / -w, u[1] * v[1] / -w]
        });
    }

    /// Solves for `z` with a step of refinement, and for the winches on the border, which it returns.
    fn solve_border(
        &mut self,
        rows: &Rows,
        local: &Local,
        border: &[usize],
        weight: impl Fn(usize) -> f64,
        exact: bool,
    ) -> Result<Vec<f64>, NotConvex> {
        self.refined();
        if border.is_empty() {
            return Ok(Vec::new());
        }
        let n = self.z.len();
        let mut columns = vec![0.0; n * border.len()];
        for (&j, column) in border.iter().zip(columns.chunks_exact_mut(n)) {
            rows.add(&self.stencils, j, 1.0, column, exact);
        }
        self.factor.solve_many(&mut columns, border.len());
        let mut schur = DMatrix::zeros(border.len(), border.len());
        let mut rhs = DVector::zeros(border.len());
        for (a, &j) in border.iter().enumerate() {
            for (b, column) in columns.chunks_exact(n).enumerate() {
                schur[(a, b)] = -rows.product(&self.stencils, j, column, exact);
            }
            schur[(a, a)] += weight(j);
            rhs[a] = -local.gradient[j] - rows.product(&self.stencils, j, &self.z, exact);
        }
        let schur = 0.5 * (&schur + schur.transpose());
        let moved = schur.cholesky().ok_or(NotConvex)?.solve(&rhs);
        for (column, d) in columns.chunks_exact(n).zip(moved.iter()) {
            for (z, c) in self.z.iter_mut().zip(column) {
                *z -= d * c;
            }
        }
        Ok(moved.iter().copied().collect())
    }

    /// `z = K^-1 z`, once refined: pivots were free within panels only.
    fn refined(&mut self) {
        self.factor.solve_many(&mut self.z, 1);
        self.pattern.multiply(&self.values, &self.z, &mut self.product);
        for (p, r) in self.product.iter_mut().zip(&self.rest) {
            *p = r - *p;
        }
        self.factor.solve_many(&mut self.product, 1);
        for (z, p) in self.z.iter_mut().zip(&self.product) {
            *z += p;
        }
    }
}

/// Whether winch `j` winds a single element and so can be eliminated.
fn is_single(question: &Question, j: usize) -> bool {
    question.actuation.winches[j].members.len() == 1
}

/// The pairs of nodes that a pattern couples.
fn coupled(pattern: &Pattern) -> Vec<[usize; 2]> {
    let mut pairs = Vec::new();
    for column in (0..pattern.dimension()).step_by(2) {
        let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
        for &row in pattern.row_indices()[range].iter().filter(|row| *row % 2 == 0 && **row > column) {
            pairs.push([column / 2, row / 2]);
        }
    }
    pairs
}
