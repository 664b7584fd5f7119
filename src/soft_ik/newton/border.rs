//! The winches that are not eliminated: a dense border of the saddle-point matrix, as wide as there are free winches on it.

use super::form::NotConvex;
use super::rows::Rows;
use super::saddle::{Local, Saddle, put, take};
use crate::soft_ik::Question;
use nalgebra::{DMatrix, DVector};

impl Saddle {
    /// The Schur complement of the border: dense, as wide as there are free winches on it.
    pub(super) fn factorize_border(&mut self, question: &mut Question, local: &Local) -> Result<(), NotConvex> {
        self.schur = None;
        let width = self.border.len();
        if width == 0 {
            return Ok(());
        }
        let rows = &local.rows;
        self.solve_columns(question, local);
        let mut schur = DMatrix::zeros(width, width);
        for (a, &j) in self.border.iter().enumerate() {
            for (b, &k) in self.border.iter().enumerate() {
                schur[(a, b)] = -rows.product(&self.stencils, j, self.column(b, k), self.form);
            }
            schur[(a, a)] += self.weights_now[j];
        }
        let schur = 0.5 * (&schur + schur.transpose());
        self.schur = Some(schur.cholesky().ok_or(NotConvex)?);
        Ok(())
    }

    /// The solution for the row of winch `j`, the `a`-th on the border.
    fn column(&self, a: usize, j: usize) -> &[f64] {
        let (n, k) = (self.z.len(), if self.factor.is_some() { a } else { j });
        &self.columns[k * n..(k + 1) * n]
    }

    /// `K^-1 u` for the winches on the border; for few winches, of all, which neither bounds nor damping change.
    fn solve_columns(&mut self, question: &mut Question, local: &Local) {
        let rows = &local.rows;
        let n = self.z.len();
        if let Some(factor) = &mut self.factor {
            self.columns.clear();
            self.columns.resize(n * self.border.len(), 0.0);
            for (&j, column) in self.border.iter().zip(self.columns.chunks_exact_mut(n)) {
                rows.add(&self.stencils, j, 1.0, column, self.form);
            }
            factor.solve_many(&mut self.columns, self.border.len());
            return;
        }
        if self.fresh {
            return;
        }
        self.fresh = true;
        let count = self.stencils.count();
        // K [dx, -dp] = u is H dx = u_p, then H (-dp) = u_x - L_xx dx.
        let mut sides = vec![0.0; n / 2 * count];
        self.columns.clear();
        self.columns.resize(n * count, 0.0);
        let columns = self.columns.chunks_exact_mut(n);
        for ((j, column), side) in columns.enumerate().zip(sides.chunks_exact_mut(n / 2)) {
            rows.add(&self.stencils, j, 1.0, column, self.form);
            take(column, side, 2);
        }
        question.model.solve_many(&mut sides, count);
        for (column, side) in self.columns.chunks_exact_mut(n).zip(sides.chunks_exact_mut(n / 2)) {
            let bent = local.lagrangian_product(question, self.form, side);
            let (x, p) = (side.chunks_exact_mut(2), bent.chunks_exact(2));
            for ((side, p), column) in x.zip(p).zip(column.chunks_exact_mut(4)) {
                let u = [column[0], column[1]];
                column[..2].copy_from_slice(side);
                side.copy_from_slice(&[u[0] - p[0], u[1] - p[1]]);
            }
        }
        question.model.solve_many(&mut sides, count);
        for (column, side) in self.columns.chunks_exact_mut(n).zip(sides.chunks_exact(n / 2)) {
            put(side, column, 2);
        }
    }

    /// The steps of the winches on the border; mends `z` for them.
    pub(super) fn solve_border(&mut self, rows: &Rows, slopes: &[f64]) -> Vec<f64> {
        let Some(schur) = &self.schur else { return Vec::new() };
        let rhs = self.border.iter().map(|&j| -slopes[j] - rows.product(&self.stencils, j, &self.z, self.form));
        let moved = schur.solve(&DVector::from_iterator(self.border.len(), rhs));
        let mut z = std::mem::take(&mut self.z);
        let n = z.len();
        for (a, (&j, d)) in self.border.iter().zip(moved.iter()).enumerate() {
            let k = if self.factor.is_some() { a } else { j };
            for (z, c) in z.iter_mut().zip(&self.columns[k * n..(k + 1) * n]) {
                *z -= d * c;
            }
        }
        self.z = z;
        moved.iter().copied().collect()
    }
}
