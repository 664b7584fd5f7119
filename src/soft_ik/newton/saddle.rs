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

use super::form::{Form, NotConvex};
use super::rows::{Rows, Stencils};
use crate::physics::Energy;
use crate::physics::indefinite::Indefinite;
use crate::physics::pattern::{Pattern, Scatter, Slots};
use crate::soft_ik::Question;
use nalgebra::{Cholesky, Dyn};

/// The optimality conditions linearised at an equilibrium.
#[derive(Default)]
pub(super) struct Local {
    /// `H`, as the model stores it.
    pub hessian: Vec<f64>,
    /// `d(H p)/dx`, likewise: exact, and without the concave part of the elements' own law.
    pub bend: [Vec<f64>; 2],
    /// `dO/dbeta`.
    pub gradient: Vec<f64>,
    pub rows: Rows,
}

impl Local {
    /// `L_xx dx`.
    pub fn lagrangian_product(&self, question: &Question, form: Form, dx: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; dx.len()];
        if let Some(k) = form.index() {
            question.model.pattern().multiply(&self.bend[k], dx, &mut out);
            out.iter_mut().for_each(|v| *v = -*v);
        }
        question.objective.add_position_curvature(dx, &mut out);
        out
    }
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

/// Structure, factor and buffers.
pub(super) struct Saddle {
    pub(super) coordinates: usize,
    /// Empty, as all that stands in it, where there is no factor.
    pub(super) pattern: Pattern,
    /// None where there are few winches: all of them stand on the border, and what is left is solved with the factor of `H` alone.
    pub(super) factor: Option<Indefinite>,
    /// Whether each winch is eliminated by its own row.
    pub(super) eliminated: Vec<bool>,
    pub(super) stencils: Stencils,
    /// Where each stored value of the model's Hessian lands: positions with positions, multipliers with positions, and the mirror
    /// of the latter.
    pub(super) places: Vec<[u32; 3]>,
    /// Slots of the winches of one element.
    pub(super) slots: Slots,
    /// Slots of all elements in the model's own pattern.
    pub(super) element_slots: Slots,
    /// Where the weights of the targets land: target, row, column, product of the weights of two of its nodes.
    pub(super) weights: Vec<(usize, u32, f64)>,
    pub(super) base: Vec<f64>,
    pub(super) values: Vec<f64>,
    /// Of the last factorisation: its form, the damped weight of every winch (infinite where it is held), the free winches of several
    /// elements, the solutions for their rows, and their Schur complement.
    pub(super) form: Form,
    pub(super) weights_now: Vec<f64>,
    pub(super) border: Vec<usize>,
    pub(super) columns: Vec<f64>,
    /// Whether the columns of few winches are those of the matrix assembled last.
    pub(super) fresh: bool,
    pub(super) schur: Option<Cholesky<f64, Dyn>>,
    pub(super) z: Vec<f64>,
    pub(super) rest: Vec<f64>,
    pub(super) product: Vec<f64>,
}

impl Saddle {
    /// Puts in what does not depend on which winches are free.
    pub fn assemble(&mut self, question: &Question, local: &Local, form: Form) {
        self.fresh = false;
        if self.factor.is_none() {
            return;
        }
        self.base.fill(0.0);
        let bend = form.index().map(|k| &local.bend[k]);
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

    /// Factorises the system with winches `held` where they are and all others free, each damped by `damping`. Needs
    /// [`Self::assemble`] in the same form.
    ///
    /// # Errors
    /// [`NotConvex`] where the reduced Hessian is not positive definite.
    pub fn factorize(
        &mut self,
        question: &mut Question,
        local: &Local,
        form: Form,
        damping: &[f64],
        held: &[bool],
    ) -> Result<(), NotConvex> {
        let rows = &local.rows;
        self.form = form;
        if self.factor.is_some() {
            self.values.copy_from_slice(&self.base);
        }
        self.weights_now.clear();
        self.border.clear();
        for j in 0..held.len() {
            let w = rows.weight(j, form) + damping[j];
            self.weights_now.push(if held[j] { f64::INFINITY } else { w });
            if held[j] {
                continue;
            }
            if !self.eliminated[j] {
                self.border.push(j);
            } else if w > 0.0 {
                self.eliminate(rows, j, w, form);
            } else {
                return Err(NotConvex);
            }
        }
        if let Some(factor) = &mut self.factor {
            let inertia = factor.factorize(&self.pattern, &self.values);
            if inertia.singular > 0 || inertia.negative != self.coordinates {
                return Err(NotConvex);
            }
        }
        self.factorize_border(question, local)
    }

    /// The Newton step from a point at which the model has these `slopes`, with the last factor: the step, zero for held winches, and
    /// the first-order displacement in `z`.
    ///
    /// # Errors
    /// [`NotConvex`] where the system could not be solved.
    pub fn solve(&mut self, rows: &Rows, slopes: &[f64]) -> Result<Vec<f64>, NotConvex> {
        let form = self.form;
        self.z.fill(0.0);
        for (j, (w, g)) in self.weights_now.iter().zip(slopes).enumerate() {
            if w.is_finite() && self.eliminated[j] {
                rows.add(&self.stencils, j, g / w, &mut self.z, form);
            }
        }
        self.rest.copy_from_slice(&self.z);
        self.refined();
        let of_border = self.solve_border(rows, slopes);
        let mut step = vec![0.0; slopes.len()];
        for (&j, d) in self.border.iter().zip(&of_border) {
            step[j] = *d;
        }
        for (j, (w, g)) in self.weights_now.iter().zip(slopes).enumerate() {
            if w.is_finite() && self.eliminated[j] {
                step[j] = -(g + rows.product(&self.stencils, j, &self.z, form)) / w;
            }
        }
        if step.iter().all(|d| d.is_finite()) { Ok(step) } else { Err(NotConvex) }
    }

    /// The change of the slopes of the undamped model by the step found last, winch by winch.
    pub fn change_of_slopes(&self, rows: &Rows, step: &[f64]) -> Vec<f64> {
        let form = self.form;
        let change = |(j, d): (usize, &f64)| rows.product(&self.stencils, j, &self.z, form) + rows.weight(j, form) * d;
        step.iter().enumerate().map(change).collect()
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
        let rows = &local.rows;
        // dx = -H^-1 B^T dbeta, then -dp = -H^-1 (L_xx dx + A^T dbeta).
        self.z.fill(0.0);
        for (j, d) in beta.iter().enumerate().filter(|(_, d)| **d != 0.0) {
            rows.add(&self.stencils, j, -d, &mut self.z, Form::GaussNewton);
        }
        let mut x = vec![0.0; self.coordinates()];
        take(&self.z, &mut x, 2);
        question.model.solve(&mut x);
        self.z.fill(0.0);
        if form != Form::GaussNewton {
            for (j, d) in beta.iter().enumerate().filter(|(_, d)| **d != 0.0) {
                rows.add(&self.stencils, j, *d, &mut self.z, form);
            }
        }
        let mut p = local.lagrangian_product(question, form, &x);
        for (p, z) in p.chunks_exact_mut(2).zip(self.z.chunks_exact(4)) {
            p[0] = -p[0] - z[0];
            p[1] = -p[1] - z[1];
        }
        question.model.solve(&mut p);
        put(&x, &mut self.z, 0);
        put(&p, &mut self.z, 2);
        let (mut slope, mut curvature) = (0.0, 0.0);
        let slopes = (0..beta.len())
            .map(|j| {
                let by_model = rows.product(&self.stencils, j, &self.z, form) + rows.weight(j, form) * beta[j];
                slope += local.gradient[j] * beta[j];
                curvature += 0.5 * beta[j] * by_model;
                local.gradient[j] + by_model + damping[j] * beta[j]
            })
            .collect();
        (Step { beta, x, slope, curvature }, slopes)
    }

    /// Takes `concave_e G_e G_e^T` of every element out of a second derivative as the model stores it.
    pub fn remove_concave(&self, question: &Question, x: &[f64], concave: &[f64], values: &mut [f64]) {
        let contractile = &question.model.contractile;
        let mut scatter = Scatter::new(&self.element_slots, values);
        let mut gradient = vec![0.0; x.len()];
        for (k, (element, amount)) in contractile.elements.iter().zip(concave).enumerate() {
            if *amount == 0.0 {
                continue;
            }
            let nodes = contractile.stencil(k);
            element.add_length_gradient(x, 1.0, &mut gradient);
            scatter.add(k, |a, b| {
                let (i, j) = (2 * nodes[a], 2 * nodes[b]);
                let (u, v) = ([gradient[i], gradient[i + 1]], [gradient[j], gradient[j + 1]]);
                [-amount * u[0] * v[0], -amount * u[0] * v[1], -amount * u[1] * v[0], -amount * u[1] * v[1]]
            });
            for &n in nodes {
                gradient[2 * n] = 0.0;
                gradient[2 * n + 1] = 0.0;
            }
        }
    }

    /// Factorisations that each call of [`Self::factorize`] takes.
    pub fn cost(&self) -> usize {
        self.factor.is_some() as usize
    }

    /// Coordinates of the body.
    pub fn coordinates(&self) -> usize {
        self.coordinates
    }

    /// Subtracts `u u^T / w` of winch `j`.
    fn eliminate(&mut self, rows: &Rows, j: usize, w: f64, form: Form) {
        let entries = self.stencils.entries(j);
        let force = &rows.force[entries.clone()];
        let bend = form.index().map(|k| &rows.bend[k][entries]);
        let entry = |k: usize| match (k % 2, bend) {
            (0, None) => [0.0; 2],
            (0, Some(bend)) => [bend[k], bend[k + 1]],
            _ => [force[k - 1], force[k]],
        };
        Scatter::new(&self.slots, &mut self.values).add(j, |a, b| {
            let (u, v) = (entry(a), entry(b));
            [u[0] * v[0] / -w, u[0] * v[1] / -w, u[1] * v[0] / -w, u[1] * v[1] / -w]
        });
    }

    /// `z = K^-1 z`, once refined: pivots were free within panels only.
    fn refined(&mut self) {
        let Some(factor) = &mut self.factor else { return };
        factor.solve_many(&mut self.z, 1);
        self.pattern.multiply(&self.values, &self.z, &mut self.product);
        for (p, r) in self.product.iter_mut().zip(&self.rest) {
            *p = r - *p;
        }
        factor.solve_many(&mut self.product, 1);
        for (z, p) in self.z.iter_mut().zip(&self.product) {
            *z += p;
        }
    }
}

/// The positions (`at` 0) or multipliers (2) of a vector over both.
pub(super) fn take(both: &[f64], part: &mut [f64], at: usize) {
    for (part, both) in part.chunks_exact_mut(2).zip(both.chunks_exact(4)) {
        part.copy_from_slice(&both[at..at + 2]);
    }
}

pub(super) fn put(part: &[f64], both: &mut [f64], at: usize) {
    for (part, both) in part.chunks_exact(2).zip(both.chunks_exact_mut(4)) {
        both[at..at + 2].copy_from_slice(part);
    }
}
