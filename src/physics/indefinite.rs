//! Factorisation of sparse symmetric matrices that are not definite: `P K P^T = L B L^T`, `B` of blocks of one and two.
//!
//! Pivots are chosen within the dense panels of the factor (Bunch and Kaufman, SIAM J. Numer. Anal. 8, 1971), so that the
//! symbolic analysis is done once for a pattern. What that leaves of accuracy where a panel offers no good pivot is for the
//! caller to mend: by a step of iterative refinement, or by more weight on the diagonal.

use super::cholesky::{Kernel, Ordering, Variant, analyse};
use super::pattern::Pattern;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::supernodal::SupernodalIntranodeLbltRef;
use faer::sparse::linalg::cholesky::{IntranodeLbltRef, SymbolicCholesky, SymbolicCholeskyRaw};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side, Spec};

/// A factorisation `L B L^T` that is computed again and again on one pattern.
pub struct Indefinite {
    symbolic: SymbolicCholesky<usize>,
    factor: Vec<f64>,
    subdiagonal: Vec<f64>,
    forward: Vec<usize>,
    inverse: Vec<usize>,
    memory: MemBuffer,
    columns: usize,
}

/// How many eigenvalues of a matrix are negative (Sylvester's law of inertia: as many as of `B`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Inertia {
    pub negative: usize,
    /// Zero or not finite.
    pub singular: usize,
}

impl Indefinite {
    /// Symbolic analysis; `None` only if the factor would not fit into memory.
    pub fn new(pattern: &Pattern) -> Option<Self> {
        let variant = Variant { ordering: Ordering::NodeMinimumDegree, kernel: Kernel::Supernodal(&[]) };
        let symbolic = analyse(pattern, &variant)?;
        let n = pattern.dimension();
        let mut this = Self {
            factor: vec![0.0; symbolic.len_val()],
            subdiagonal: vec![0.0; n],
            forward: vec![0; n],
            inverse: vec![0; n],
            symbolic,
            memory: MemBuffer::new(Default::default()),
            columns: 0,
        };
        this.reserve(1);
        Some(this)
    }

    /// Factorises the matrix with these lower-triangle values. A singular matrix leaves a factor of no use.
    pub fn factorize(&mut self, pattern: &Pattern, values: &[f64]) -> Inertia {
        let n = pattern.dimension();
        if !values.iter().all(|v| v.is_finite()) {
            return Inertia { negative: 0, singular: n };
        }
        let structure =
            SymbolicSparseColMatRef::new_checked(n, n, pattern.column_starts(), None, pattern.row_indices());
        self.symbolic.factorize_numeric_intranode_lblt(
            &mut self.factor,
            &mut self.subdiagonal,
            &mut self.forward,
            &mut self.inverse,
            SparseColMatRef::new(structure, values),
            Side::Lower,
            Par::Seq,
            MemStack::new(&mut self.memory),
            Spec::default(),
        );
        self.inertia()
    }

    /// Counted on `B`: a block of two has one eigenvalue of each sign, as a pivot of one would have been taken otherwise, unless
    /// its determinant says otherwise.
    fn inertia(&self) -> Inertia {
        let SymbolicCholeskyRaw::Supernodal(symbolic) = self.symbolic.raw() else {
            return Inertia { negative: 0, singular: self.forward.len() };
        };
        let factor = SupernodalIntranodeLbltRef::new(symbolic, &self.factor, &self.subdiagonal, self.permutation());
        let mut count = Inertia { negative: 0, singular: 0 };
        for s in 0..symbolic.n_supernodes() {
            let (start, end) = (symbolic.supernode_begin()[s], symbolic.supernode_end()[s]);
            let panel = factor.supernode(s).val();
            let mut j = 0;
            while j < end - start {
                let (a, off) = (panel[(j, j)], self.subdiagonal[start + j]);
                if off == 0.0 {
                    count.negative += (a < 0.0) as usize;
                    count.singular += (a == 0.0 || !a.is_finite()) as usize;
                    j += 1;
                } else {
                    let b = panel[(j + 1, j + 1)];
                    let determinant = a * b - off * off;
                    count.negative += if determinant < 0.0 { 1 } else { 2 * (a < 0.0) as usize };
                    count.singular += if determinant.is_finite() && determinant != 0.0 { 0 } else { 2 };
                    j += 2;
                }
            }
        }
        count
    }

    /// Solves in place for `columns` right-hand sides, stored column after column.
    pub fn solve_many(&mut self, rhs: &mut [f64], columns: usize) {
        if columns == 0 {
            return;
        }
        self.reserve(columns);
        let n = self.symbolic.nrows();
        let permutation = PermRef::new_checked(&self.forward, &self.inverse, n);
        IntranodeLbltRef::new(&self.symbolic, &self.factor, &self.subdiagonal, permutation).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(rhs, n, columns),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
    }

    fn permutation(&self) -> PermRef<'_, usize> {
        PermRef::new_checked(&self.forward, &self.inverse, self.forward.len())
    }

    fn reserve(&mut self, columns: usize) {
        if columns > self.columns {
            let need = self
                .symbolic
                .factorize_numeric_intranode_lblt_scratch::<f64>(Par::Seq, Spec::default())
                .or(self.symbolic.solve_in_place_scratch::<f64>(columns, Par::Seq));
            self.memory = MemBuffer::new(need);
            self.columns = columns;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    /// A saddle-point matrix on a grid of nodes: alternately positive, negative and without a diagonal.
    fn saddle(side: usize) -> (Pattern, Vec<f64>) {
        let at = |i: usize, j: usize| i * side + j;
        let mut stencils: Vec<Vec<usize>> = Vec::new();
        for i in 0..side {
            for j in 0..side {
                if i + 1 < side {
                    stencils.push(vec![at(i, j), at(i + 1, j)]);
                }
                if j + 1 < side {
                    stencils.push(vec![at(i, j), at(i, j + 1)]);
                }
            }
        }
        let pattern = Pattern::new(side * side, stencils.iter().map(|s| s.as_slice()));
        let mut values: Vec<f64> = (0..pattern.nonzeros()).map(|k| (k as f64 * 1.7).sin()).collect();
        for d in 0..pattern.dimension() {
            values[pattern.diagonal(d)] = [4.0, 0.0, -3.0, 0.0][d % 4];
        }
        (pattern, values)
    }

    #[test]
    fn solves_an_indefinite_system_and_counts_its_eigenvalues() {
        let (pattern, values) = saddle(7);
        let n = pattern.dimension();
        let mut dense = DMatrix::zeros(n, n);
        for column in 0..n {
            let stored = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
            for (&row, value) in pattern.row_indices()[stored.clone()].iter().zip(&values[stored]) {
                dense[(row, column)] = *value;
                dense[(column, row)] = *value;
            }
        }
        let mut factor = Indefinite::new(&pattern).unwrap();
        let inertia = factor.factorize(&pattern, &values);
        let negative = dense.symmetric_eigenvalues().iter().filter(|v| **v < 0.0).count();
        assert_eq!(inertia, Inertia { negative, singular: 0 });
        let b: Vec<f64> = (0..2 * n).map(|i| (i as f64 * 0.7).cos()).collect();
        let mut z = b.clone();
        factor.solve_many(&mut z, 2);
        for c in 0..2 {
            let mut y = vec![0.0; n];
            pattern.multiply(&values, &z[c * n..(c + 1) * n], &mut y);
            for i in 0..n {
                assert!((y[i] - b[c * n + i]).abs() < 1e-9, "row {i}: {} is not {}", y[i], b[c * n + i]);
            }
        }
    }

    #[test]
    fn a_matrix_that_is_not_finite_is_singular() {
        let (pattern, mut values) = saddle(3);
        values[3] = f64::NAN;
        let n = pattern.dimension();
        assert_eq!(Indefinite::new(&pattern).unwrap().factorize(&pattern, &values).singular, n);
    }
}
