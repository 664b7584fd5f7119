//! Sparse Cholesky factorisation, the only file that names faer.
//!
//! Symbolic analysis (approximate minimum degree on the fixed pattern) once per topology; numeric factorisation and
//! solves without allocation afterwards. Sequential, so that the same input gives the same bits.

use super::pattern::Pattern;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side, Spec};

/// A factorisation `H = L L^T` that is computed again and again on one pattern.
pub struct Cholesky {
    symbolic: SymbolicCholesky<usize>,
    factor: Vec<f64>,
    memory: MemBuffer,
    /// Right-hand sides for which `memory` suffices.
    columns: usize,
    valid: bool,
}

/// The matrix is not (numerically) positive definite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the matrix is not positive definite")]
pub struct NotPositiveDefinite;

impl Cholesky {
    /// Symbolic analysis; `None` only if the factor would not fit into memory.
    pub fn new(pattern: &Pattern) -> Option<Self> {
        let n = pattern.dimension();
        let structure =
            SymbolicSparseColMatRef::new_checked(n, n, pattern.column_starts(), None, pattern.row_indices());
        let symbolic = factorize_symbolic_cholesky(
            structure,
            Side::Lower,
            SymmetricOrdering::Amd,
            CholeskySymbolicParams::default(),
        )
        .ok()?;
        let factor = vec![0.0; symbolic.len_val()];
        let mut this = Self { symbolic, factor, memory: MemBuffer::new(Default::default()), columns: 0, valid: false };
        this.reserve(1);
        Some(this)
    }

    /// Factorises the matrix with these lower-triangle values. After an error there is no factor to solve with.
    pub fn factorize(&mut self, pattern: &Pattern, values: &[f64]) -> Result<(), NotPositiveDefinite> {
        self.valid = false;
        if !values.iter().all(|v| v.is_finite()) {
            return Err(NotPositiveDefinite);
        }
        let n = pattern.dimension();
        let structure =
            SymbolicSparseColMatRef::new_checked(n, n, pattern.column_starts(), None, pattern.row_indices());
        self.symbolic
            .factorize_numeric_llt(
                &mut self.factor,
                SparseColMatRef::new(structure, values),
                Side::Lower,
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut self.memory),
                Spec::default(),
            )
            .map_err(|_| NotPositiveDefinite)?;
        self.valid = true;
        Ok(())
    }

    /// Solves `H z = rhs` in place for one right-hand side. Panics without a factor (a caller's mistake).
    pub fn solve(&mut self, rhs: &mut [f64]) {
        self.solve_many(rhs, 1);
    }

    /// Solves in place for `columns` right-hand sides, stored column after column.
    pub fn solve_many(&mut self, rhs: &mut [f64], columns: usize) {
        assert!(self.valid, "solve without a factorisation");
        if columns == 0 {
            return;
        }
        self.reserve(columns);
        let n = self.symbolic.nrows();
        LltRef::new(&self.symbolic, &self.factor).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(rhs, n, columns),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
    }

    fn reserve(&mut self, columns: usize) {
        if columns > self.columns {
            let need =
                self.symbolic
                    .factorize_numeric_llt_scratch::<f64>(Par::Seq, Spec::default())
                    .or(self.symbolic.solve_in_place_scratch::<f64>(columns, Par::Seq));
            self.memory = MemBuffer::new(need);
            self.columns = columns;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::pattern::Scatter;
    use super::*;

    fn chain(nodes: usize) -> (Pattern, Vec<f64>) {
        let stencils: Vec<[usize; 2]> = (1..nodes).map(|i| [i - 1, i]).collect();
        let pattern = Pattern::new(nodes, stencils.iter().map(|s| s.as_slice()));
        let slots = pattern.slots(stencils.iter().map(|s| s.as_slice()));
        let mut values = vec![0.0; pattern.nonzeros()];
        let mut scatter = Scatter::new(&slots, &mut values);
        for k in 0..stencils.len() {
            scatter.add(k, |a, b| if a == b { [2.0, 0.3, 0.3, 1.5] } else { [-0.9, 0.1, 0.2, -0.7] });
        }
        for d in 0..pattern.dimension() {
            values[pattern.diagonal(d)] += 1.0;
        }
        (pattern, values)
    }

    #[test]
    fn solves_several_right_hand_sides() {
        let (pattern, values) = chain(40);
        let mut cholesky = Cholesky::new(&pattern).unwrap();
        cholesky.factorize(&pattern, &values).unwrap();
        let n = pattern.dimension();
        let b: Vec<f64> = (0..3 * n).map(|i| (i as f64 * 0.7).sin()).collect();
        let mut z = b.clone();
        cholesky.solve_many(&mut z, 3);
        for c in 0..3 {
            let mut y = vec![0.0; n];
            pattern.multiply(&values, &z[c * n..(c + 1) * n], &mut y);
            for i in 0..n {
                assert!((y[i] - b[c * n + i]).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn an_indefinite_matrix_is_refused() {
        let (pattern, mut values) = chain(5);
        let mut cholesky = Cholesky::new(&pattern).unwrap();
        values[pattern.diagonal(4)] = -3.0;
        assert_eq!(cholesky.factorize(&pattern, &values), Err(NotPositiveDefinite));
        values[pattern.diagonal(4)] = f64::NAN;
        assert_eq!(cholesky.factorize(&pattern, &values), Err(NotPositiveDefinite));
    }
}
