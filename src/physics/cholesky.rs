//! Sparse Cholesky factorisation. Only this file and [`super::indefinite`] name faer.
//!
//! Symbolic analysis (approximate minimum degree on the fixed pattern) once per topology; numeric factorisation and
//! solves (our own, `super::panels`) without allocation afterwards. Sequential, so that the same input gives the same bits.

use super::panels::{Memory, Panels};
use super::pattern::Pattern;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::linalg::{SupernodalThreshold, SymbolicSupernodalParams};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side, Spec};
use std::ops::Range;

/// In which order unknowns are eliminated.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Ordering {
    /// Approximate minimum degree on the scalar pattern.
    #[default]
    MinimumDegree,
    /// Approximate minimum degree on the nodes; both unknowns of a node stay together.
    NodeMinimumDegree,
    /// As the nodes are numbered.
    Natural,
    /// Node `order[k]` is eliminated as the `k`-th. Every node occurs once.
    Nodes(Vec<usize>),
    /// As the pattern has them: nothing is moved before a factorisation.
    Given,
}

/// How the numeric factorisation walks through the factor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Kernel {
    /// Chosen by the arithmetic per stored value.
    #[default]
    Automatic,
    /// One column at a time.
    Simplicial,
    /// Dense panels of columns with the same structure. Two of `n` columns in all, of which a fraction `z` of the entries
    /// would be zero, are merged where `n <= at most` and `z < below` for one `(at most, below)`; no entry: the library's own.
    Supernodal(&'static [(usize, f64)]),
}

/// How a factorisation is computed: the same factor up to order and rounding, at different cost.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Variant {
    pub ordering: Ordering,
    pub kernel: Kernel,
}

/// A factorisation `H = L L^T` that is computed again and again on one pattern.
pub struct Cholesky {
    symbolic: SymbolicCholesky<usize>,
    factor: Vec<f64>,
    memory: MemBuffer,
    /// Right-hand sides for which `memory` suffices.
    columns: usize,
    /// The degree of freedom of every row of the pattern.
    unknowns: Vec<u32>,
    /// The panels of a supernodal factor, with which we solve ourselves.
    panels: Option<Panels>,
    sides: Memory,
    valid: bool,
}

/// The matrix is not (numerically) positive definite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the matrix is not positive definite")]
pub struct NotPositiveDefinite;

impl Cholesky {
    /// The pattern in the order of elimination that `bench linear` finds the fastest, or near it, at every size, with the symbolic
    /// analysis of it. A matrix that is assembled in this pattern is factorised as it stands, without being permuted first.
    pub fn ordered(pattern: &Pattern) -> Option<(Pattern, Self)> {
        let order: Vec<u32> = pattern.unknowns().step_by(2).map(|d| (d / 2) as u32).collect();
        let order: Vec<usize> = node_minimum_degree(pattern)?.into_iter().map(|k| order[k] as usize).collect();
        let pattern = pattern.reordered(&order);
        let cholesky = Self::with(&pattern, &Variant { ordering: Ordering::Given, kernel: Kernel::Supernodal(&[]) })?;
        Some((pattern, cholesky))
    }

    /// The symbolic analysis of a pattern as it is; `None` only if the factor would not fit into memory.
    pub fn new(pattern: &Pattern) -> Option<Self> {
        Self::with(pattern, &Variant { ordering: Ordering::NodeMinimumDegree, kernel: Kernel::Supernodal(&[]) })
    }

    /// Symbolic analysis; `None` only if the factor would not fit into memory. Panics where an order of nodes is not a
    /// permutation (a caller's mistake).
    pub fn with(pattern: &Pattern, variant: &Variant) -> Option<Self> {
        let symbolic = analyse(pattern, variant)?;
        let factor = vec![0.0; symbolic.len_val()];
        let unknowns: Vec<u32> = pattern.unknowns().map(|d| d as u32).collect();
        let panels = panels_of(&symbolic, &unknowns);
        let memory = MemBuffer::new(Default::default());
        let sides = panels.as_ref().map(Panels::memory).unwrap_or_default();
        let mut this = Self { symbolic, factor, memory, columns: 0, unknowns, panels, sides, valid: false };
        this.reserve(1);
        Some(this)
    }

    /// Factorises the matrix with these lower-triangle values. After an error there is no factor to solve with.
    ///
    /// # Errors
    /// The matrix is not positive definite.
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
        let n = self.symbolic.nrows();
        if let Some(panels) = &self.panels {
            panels.solve(&self.factor, &mut rhs[..n * columns], 0..columns, [1, n], &mut self.sides);
            return;
        }
        self.reserve(columns);
        let mut ordered: Vec<f64> = Vec::with_capacity(n * columns);
        for column in rhs.chunks_exact(n).take(columns) {
            ordered.extend(self.unknowns.iter().map(|&d| column[d as usize]));
        }
        LltRef::new(&self.symbolic, &self.factor).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(&mut ordered, n, columns),
            Par::Seq,
            MemStack::new(&mut self.memory),
        );
        for (column, ordered) in rhs.chunks_exact_mut(n).zip(ordered.chunks_exact(n)) {
            for (&d, v) in self.unknowns.iter().zip(ordered) {
                column[d as usize] = *v;
            }
        }
    }

    /// Solves in place for the right-hand sides `solved` of `columns` that are stored row after row.
    pub fn solve_rows(&mut self, rhs: &mut [f64], columns: usize, solved: Range<usize>) {
        assert!(self.valid, "solve without a factorisation");
        if let Some(panels) = &self.panels {
            panels.solve(&self.factor, rhs, solved, [columns, 1], &mut self.sides);
            return;
        }
        for c in solved {
            let mut column: Vec<f64> = rhs.iter().skip(c).step_by(columns).copied().collect();
            self.solve(&mut column);
            for (v, z) in rhs.iter_mut().skip(c).step_by(columns).zip(column) {
                *v = z;
            }
        }
    }

    /// Whether there is a factor to solve with.
    pub fn is_valid(&self) -> bool {
        self.valid
    }

    /// Stored values of the factor (with supernodes, some of them are zeros).
    pub fn factor_nonzeros(&self) -> usize {
        self.factor.len()
    }

    /// Whether the numeric factorisation works on panels.
    pub fn is_supernodal(&self) -> bool {
        matches!(self.symbolic.raw(), SymbolicCholeskyRaw::Supernodal(_))
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

/// The structure of the factor in this variant; `None` where it would not fit into memory.
pub(super) fn analyse(pattern: &Pattern, variant: &Variant) -> Option<SymbolicCholesky<usize>> {
    let n = pattern.dimension();
    // The library's identity expects the upper triangle.
    let upper = (variant.ordering == Ordering::Given).then(|| transposed(pattern));
    let (starts, rows) = match &upper {
        Some((starts, rows)) => (&starts[..], &rows[..]),
        None => (pattern.column_starts(), pattern.row_indices()),
    };
    let structure = SymbolicSparseColMatRef::new_checked(n, n, starts, None, rows);
    let rank = |node: usize| pattern.ranks()[node] as usize;
    let nodes = match &variant.ordering {
        Ordering::NodeMinimumDegree => Some(node_minimum_degree(pattern)?),
        Ordering::Nodes(order) => Some(order.iter().map(|&node| rank(node)).collect()),
        Ordering::Natural => Some((0..n / 2).map(rank).collect()),
        Ordering::MinimumDegree | Ordering::Given => None,
    };
    // Both unknowns of a node one after the other.
    let forward: Vec<usize> = nodes.iter().flatten().flat_map(|i| [2 * i, 2 * i + 1]).collect();
    let mut inverse = vec![0; forward.len()];
    for (k, &i) in forward.iter().enumerate() {
        inverse[i] = k;
    }
    let ordering = match variant.ordering {
        Ordering::MinimumDegree => SymmetricOrdering::Amd,
        Ordering::Given => SymmetricOrdering::Identity,
        _ => SymmetricOrdering::Custom(PermRef::new_checked(&forward, &inverse, n)),
    };
    let mut parameters = CholeskySymbolicParams::default();
    match variant.kernel {
        Kernel::Automatic => {}
        Kernel::Simplicial => parameters.supernodal_flop_ratio_threshold = SupernodalThreshold::FORCE_SIMPLICIAL,
        Kernel::Supernodal(relax) => {
            parameters.supernodal_flop_ratio_threshold = SupernodalThreshold::FORCE_SUPERNODAL;
            if !relax.is_empty() {
                parameters.supernodal_params = SymbolicSupernodalParams { relax: Some(relax) };
            }
        }
    }
    factorize_symbolic_cholesky(structure, Side::Lower, ordering, parameters).ok()
}

/// The panels of a supernodal factor with at most `2^32` values.
fn panels_of(symbolic: &SymbolicCholesky<usize>, unknowns: &[u32]) -> Option<Panels> {
    let SymbolicCholeskyRaw::Supernodal(raw) = symbolic.raw() else { return None };
    if u32::try_from(symbolic.len_val().max(raw.row_idx().len())).is_err() {
        return None;
    }
    let order = match symbolic.perm() {
        Some(perm) => perm.arrays().0.iter().map(|&i| unknowns[i]).collect(),
        None => unknowns.to_vec(),
    };
    let panels = (0..raw.n_supernodes()).map(|s| {
        let (first, end) = (raw.supernode_begin()[s], raw.supernode_end()[s]);
        (first, end - first, raw.supernode(s).pattern(), raw.col_ptr_for_val()[s])
    });
    Some(Panels::new(order, panels))
}

/// The upper triangle of a pattern: starts of its columns and their rows, ascending.
fn transposed(pattern: &Pattern) -> (Vec<usize>, Vec<usize>) {
    let n = pattern.dimension();
    let mut starts = vec![0; n + 1];
    for &row in pattern.row_indices() {
        starts[row + 1] += 1;
    }
    for row in 0..n {
        starts[row + 1] += starts[row];
    }
    let (mut next, mut rows) = (starts.clone(), vec![0; pattern.nonzeros()]);
    for column in 0..n {
        for &row in &pattern.row_indices()[pattern.column_starts()[column]..pattern.column_starts()[column + 1]] {
            rows[next[row]] = column;
            next[row] += 1;
        }
    }
    (starts, rows)
}

/// Approximate minimum degree on the graph of the nodes: the order of elimination of the pattern's block columns.
fn node_minimum_degree(pattern: &Pattern) -> Option<Vec<usize>> {
    let nodes = pattern.dimension() / 2;
    let (mut starts, mut rows) = (vec![0], Vec::new());
    for node in 0..nodes {
        let column = pattern.column_starts()[2 * node]..pattern.column_starts()[2 * node + 1];
        rows.extend(pattern.row_indices()[column].iter().filter(|&row| row % 2 == 0).map(|row| row / 2));
        starts.push(rows.len());
    }
    let (mut forward, mut inverse) = (vec![0; nodes], vec![0; nodes]);
    let mut memory = MemBuffer::try_new(amd::order_maybe_unsorted_scratch::<usize>(nodes, rows.len())).ok()?;
    let structure = SymbolicSparseColMatRef::new_checked(nodes, nodes, &starts, None, &rows);
    let stack = MemStack::new(&mut memory);
    amd::order_maybe_unsorted(&mut forward, &mut inverse, structure, amd::Control::default(), stack).ok()?;
    Some(forward)
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

    /// A grid, which fills in, with stencils of three nodes.
    fn grid(side: usize) -> (Pattern, Vec<f64>) {
        let corner = |i: usize, j: usize| i * side + j;
        let cells = (1..side).flat_map(|i| (1..side).map(move |j| (i, j)));
        let stencils: Vec<[usize; 3]> = cells
            .flat_map(|(i, j)| {
                let [a, b, c, d] = [corner(i - 1, j - 1), corner(i, j - 1), corner(i, j), corner(i - 1, j)];
                [[a, b, c], [c, d, a]]
            })
            .collect();
        let pattern = Pattern::new(side * side, stencils.iter().map(|s| s.as_slice()));
        let (pattern, _) = Cholesky::ordered(&pattern).unwrap();
        let slots = pattern.slots(stencils.iter().map(|s| s.as_slice()));
        let mut values = vec![0.0; pattern.nonzeros()];
        let mut scatter = Scatter::new(&slots, &mut values);
        for k in 0..stencils.len() {
            scatter.add(k, |a, b| if a == b { [2.1, 0.3, 0.3, 2.2] } else { [-0.9, 0.1, 0.2, -0.7] });
        }
        (0..pattern.dimension()).for_each(|d| values[pattern.diagonal(d)] += 5.0);
        (pattern, values)
    }

    /// Any number of them, dense ones and such that begin in few nodes, stored by columns and by rows.
    #[test]
    fn right_hand_sides_side_by_side_are_solved_as_alone() {
        let (pattern, values) = grid(17);
        let variant = Variant { ordering: Ordering::Given, kernel: Kernel::Supernodal(&[]) };
        let mut cholesky = Cholesky::with(&pattern, &variant).unwrap();
        cholesky.factorize(&pattern, &values).unwrap();
        let n = pattern.dimension();
        for columns in [1, 2, 3, 4, 5, 8, 9, 10, 12, 13, 27] {
            let few = |i: usize, c: usize| c % 3 == 2 || (i + 7 * c) % n < 6;
            let b = |i: usize, c: usize| if few(i, c) { (0.7 * (i + 31 * c) as f64).sin() } else { 0.0 };
            let mut by_column: Vec<f64> = (0..columns).flat_map(|c| (0..n).map(move |i| b(i, c))).collect();
            let mut by_row: Vec<f64> = (0..n).flat_map(|i| (0..columns).map(move |c| b(i, c))).collect();
            cholesky.solve_many(&mut by_column, columns);
            cholesky.solve_rows(&mut by_row, columns, 0..columns);
            let mut y = vec![0.0; n];
            for c in 0..columns {
                let z = &by_column[c * n..(c + 1) * n];
                pattern.multiply(&values, z, &mut y);
                for i in 0..n {
                    assert_eq!(z[i], by_row[i * columns + c], "{columns} columns");
                    assert!((y[i] - b(i, c)).abs() < 1e-12, "{columns} columns: {i} of {c}");
                }
            }
        }
    }

    #[test]
    fn every_variant_solves_the_same_system() {
        let (pattern, values) = chain(60);
        let n = pattern.dimension();
        let b: Vec<f64> = (0..n).map(|i| (i as f64 * 0.3).cos()).collect();
        let back = Ordering::Nodes((0..n / 2).rev().collect());
        let orderings =
            [Ordering::MinimumDegree, Ordering::NodeMinimumDegree, Ordering::Natural, back, Ordering::Given];
        for ordering in orderings {
            for kernel in
                [Kernel::Automatic, Kernel::Simplicial, Kernel::Supernodal(&[]), Kernel::Supernodal(&[(8, 1.0)])]
            {
                let variant = Variant { ordering: ordering.clone(), kernel };
                let mut cholesky = Cholesky::with(&pattern, &variant).unwrap();
                cholesky.factorize(&pattern, &values).unwrap();
                let (mut z, mut y) = (b.clone(), vec![0.0; n]);
                cholesky.solve(&mut z);
                pattern.multiply(&values, &z, &mut y);
                assert!(y.iter().zip(&b).all(|(y, b)| (y - b).abs() < 1e-12), "{variant:?}");
                // A chain has no fill.
                assert!(
                    kernel != Kernel::Simplicial || cholesky.factor_nonzeros() == pattern.nonzeros(),
                    "{variant:?}"
                );
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
