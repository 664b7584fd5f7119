//! The fixed sparsity pattern of the Hessian, and where each local block lands in it.
//!
//! The Hessian is stored as the lower triangle of a scalar compressed-column matrix of size `2n`, built of 2 x 2 node
//! blocks. A slot names a block; adding a block to a slot touches four (diagonal: three) values. Nodes stand in an order of the
//! pattern's own: that in which a factorisation eliminates them.

/// Lower triangle, compressed columns. `values` live apart, one vector per matrix.
#[derive(Clone, Debug)]
pub struct Pattern {
    nodes: usize,
    /// The node of every block column, and the block column of every node.
    order: Vec<u32>,
    rank: Vec<u32>,
    /// For block column `j`: the block rows `i >= j`, ascending; the first is `j`.
    block_start: Vec<usize>,
    block_rows: Vec<usize>,
    column_starts: Vec<usize>,
    row_indices: Vec<usize>,
}

/// Where the blocks of one term's stencils land: for stencil `k` with `m` nodes, `m (m + 1) / 2` slots, pairs `(a, b)`
/// with `a >= b` in stencil positions, row by row.
#[derive(Clone, Debug, Default)]
pub struct Slots {
    starts: Vec<usize>,
    slots: Vec<Slot>,
}

#[derive(Clone, Copy, Debug)]
struct Slot {
    /// Index of the value at the block's top left entry.
    base: u32,
    /// Distance from the first to the second scalar column's entry in the same block row.
    stride: u32,
    /// The block is stored transposed (the stencil's order is not the node order).
    transposed: bool,
}

/// Receives local Hessian blocks and adds them to the global values.
pub struct Scatter<'a> {
    slots: &'a Slots,
    values: &'a mut [f64],
}

impl Pattern {
    /// The pattern in which every pair of nodes of a stencil is coupled, and every node with itself.
    pub fn new<'a>(nodes: usize, stencils: impl Iterator<Item = &'a [usize]>) -> Self {
        let mut pairs: Vec<(usize, usize)> = (0..nodes).map(|i| (i, i)).collect();
        for stencil in stencils {
            for (k, &a) in stencil.iter().enumerate() {
                for &b in &stencil[..k] {
                    pairs.push((a.min(b), a.max(b)));
                }
            }
        }
        Self::of((0..nodes as u32).collect(), pairs)
    }

    /// This pattern with its nodes in another order: `order[k]` is the `k`-th. Every node occurs once.
    pub fn reordered(&self, order: &[usize]) -> Self {
        let order: Vec<u32> = order.iter().map(|&n| n as u32).collect();
        let rank = inverse(&order);
        let column = |j: usize| self.block_rows[self.block_start[j]..self.block_start[j + 1]].iter();
        let place = |k: usize| rank[self.order[k] as usize] as usize;
        let pairs = (0..self.nodes).flat_map(|j| column(j).map(move |&i| (i, j)));
        let pairs = pairs.map(|(i, j)| (place(i).min(place(j)), place(i).max(place(j)))).collect();
        Self::of(order, pairs)
    }

    /// Of pairs of block columns and rows.
    fn of(order: Vec<u32>, mut pairs: Vec<(usize, usize)>) -> Self {
        let nodes = order.len();
        pairs.sort_unstable();
        pairs.dedup();
        let mut block_start = vec![0; nodes + 1];
        for &(j, _) in &pairs {
            block_start[j + 1] += 1;
        }
        for j in 0..nodes {
            block_start[j + 1] += block_start[j];
        }
        let block_rows: Vec<usize> = pairs.into_iter().map(|(_, i)| i).collect();
        let mut column_starts = vec![0];
        let mut row_indices = Vec::new();
        for j in 0..nodes {
            let rows = &block_rows[block_start[j]..block_start[j + 1]];
            for second in 0..2 {
                for &i in rows {
                    for r in 0..2 {
                        if 2 * i + r >= 2 * j + second {
                            row_indices.push(2 * i + r);
                        }
                    }
                }
                column_starts.push(row_indices.len());
            }
        }
        let rank = inverse(&order);
        Self { nodes, order, rank, block_start, block_rows, column_starts, row_indices }
    }

    /// The degree of freedom of every scalar row.
    pub fn unknowns(&self) -> impl Iterator<Item = usize> {
        self.order.iter().flat_map(|&n| [2 * n as usize, 2 * n as usize + 1])
    }

    /// The block column of every node.
    pub fn ranks(&self) -> &[u32] {
        &self.rank
    }

    pub fn dimension(&self) -> usize {
        2 * self.nodes
    }

    /// Number of stored values (lower triangle).
    pub fn nonzeros(&self) -> usize {
        self.row_indices.len()
    }

    pub fn column_starts(&self) -> &[usize] {
        &self.column_starts
    }

    pub fn row_indices(&self) -> &[usize] {
        &self.row_indices
    }

    /// The slots of a term. Panics if a stencil is not part of the pattern (a caller's mistake).
    pub fn slots<'a>(&self, stencils: impl Iterator<Item = &'a [usize]>) -> Slots {
        let mut out = Slots { starts: vec![0], slots: Vec::new() };
        for stencil in stencils {
            for (a, &i) in stencil.iter().enumerate() {
                for &j in &stencil[..=a] {
                    out.slots.push(self.slot(i, j));
                }
            }
            out.starts.push(out.slots.len());
        }
        out
    }

    /// Index of the diagonal value of degree of freedom `d`.
    pub fn diagonal(&self, d: usize) -> usize {
        self.column_starts[2 * self.rank[d / 2] as usize + d % 2]
    }

    /// Index of the value at (`row`, `column`) or its mirror, whichever is stored. Panics if the pattern has none (a caller's
    /// mistake).
    pub fn entry(&self, row: usize, column: usize) -> usize {
        let (row, column) = (row.max(column), row.min(column));
        let start = self.column_starts[column];
        let rows = &self.row_indices[start..self.column_starts[column + 1]];
        start + rows.binary_search(&row).expect("entry is part of the pattern")
    }

    fn slot(&self, i: usize, j: usize) -> Slot {
        let [i, j] = [i, j].map(|n| self.rank[n] as usize);
        let (row, column) = (i.max(j), i.min(j));
        let range = self.block_start[column]..self.block_start[column + 1];
        let blocks = range.len();
        let k = self.block_rows[range].binary_search(&row).expect("stencil is part of the pattern");
        let base = self.column_starts[2 * column] + 2 * k;
        Slot { base: base as u32, stride: (2 * blocks - 1) as u32, transposed: i < j }
    }

    /// `y = H v` for the symmetric matrix with these lower-triangle values, block by block.
    pub fn multiply(&self, values: &[f64], v: &[f64], y: &mut [f64]) {
        y.fill(0.0);
        for column in 0..self.nodes {
            let blocks = self.block_start[column]..self.block_start[column + 1];
            let count = blocks.len();
            let (first, next) = (self.column_starts[2 * column], self.column_starts[2 * column + 1]);
            // The second scalar column lacks the entry above its diagonal.
            let (left, right) = (&values[first..next], &values[next..next + 2 * count - 1]);
            let n = 2 * self.order[column] as usize;
            let [vx, vy] = [v[n], v[n + 1]];
            let mut sum = [left[0] * vx + left[1] * vy, left[1] * vx + right[0] * vy];
            let below = left[2..].chunks_exact(2).zip(right[1..].chunks_exact(2));
            for (&row, (l, r)) in self.block_rows[blocks][1..].iter().zip(below) {
                let m = 2 * self.order[row] as usize;
                y[m] += l[0] * vx + r[0] * vy;
                y[m + 1] += l[1] * vx + r[1] * vy;
                let [wx, wy] = [v[m], v[m + 1]];
                sum[0] += l[0] * wx + l[1] * wy;
                sum[1] += r[0] * wx + r[1] * wy;
            }
            y[n] += sum[0];
            y[n + 1] += sum[1];
        }
    }
}

fn inverse(order: &[u32]) -> Vec<u32> {
    let mut rank = vec![0; order.len()];
    for (k, &n) in order.iter().enumerate() {
        rank[n as usize] = k as u32;
    }
    rank
}

impl<'a> Scatter<'a> {
    pub fn new(slots: &'a Slots, values: &'a mut [f64]) -> Self {
        Self { slots, values }
    }

    /// Adds `block(p)` for each of the stencil's `pairs[p] = (a, b)`: all positions `a >= b`, row by row.
    #[inline(always)]
    pub fn add_all<const P: usize>(
        &mut self,
        stencil: usize,
        pairs: [(usize, usize); P],
        block: impl Fn(usize) -> [f64; 4],
    ) {
        let slots: &'a Slots = self.slots;
        let slots = &slots.slots[slots.starts[stencil]..][..P];
        for (p, (slot, (a, b))) in slots.iter().zip(pairs).enumerate() {
            self.add_block(slot, a == b, block(p));
        }
    }

    #[inline(always)]
    fn add_block(&mut self, slot: &Slot, diagonal: bool, m: [f64; 4]) {
        let (base, stride) = (slot.base as usize, slot.stride as usize);
        let [m00, m01, m10, m11] = if slot.transposed { [m[0], m[2], m[1], m[3]] } else { m };
        let first = &mut self.values[base..base + 2];
        first[0] += m00;
        first[1] += m10;
        // The second column of a diagonal block starts one entry later: its top entry is above the diagonal.
        let second = &mut self.values[base + stride..base + stride + 2];
        if !diagonal {
            second[0] += m01;
        }
        second[1] += m11;
    }

    /// Adds `block(a, b)` (row-major 2 x 2, derivative by node `a` then node `b`) for all stencil positions `a >= b`.
    #[inline]
    pub fn add(&mut self, stencil: usize, mut block: impl FnMut(usize, usize) -> [f64; 4]) {
        let slots = self.slots;
        let range = slots.starts[stencil]..slots.starts[stencil + 1];
        let (mut a, mut b) = (0, 0);
        for slot in &slots.slots[range] {
            let m = block(a, b);
            self.add_block(slot, a == b, m);
            if a == b {
                a += 1;
                b = 0;
            } else {
                b += 1;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_land_where_a_dense_matrix_says() {
        let stencils: [&[usize]; 3] = [&[2, 0, 1], &[3, 1], &[3]];
        let plain = Pattern::new(4, stencils.iter().copied());
        for pattern in [plain.reordered(&[2, 0, 3, 1]), plain.reordered(&[3, 1, 0, 2]).reordered(&[1, 3, 2, 0]), plain]
        {
            check(&pattern, &stencils);
        }
    }

    fn check(pattern: &Pattern, stencils: &[&[usize]]) {
        let slots = pattern.slots(stencils.iter().copied());
        let mut values = vec![0.0; pattern.nonzeros()];
        let mut dense = [[0.0; 8]; 8];
        // A symmetric quadratic form per stencil, with entries that tell every pair apart.
        let entry = |i: usize, j: usize| (1 + i.min(j)) as f64 + 0.1 * (1 + i.max(j)) as f64;
        let mut scatter = Scatter::new(&slots, &mut values);
        for (k, stencil) in stencils.iter().enumerate() {
            scatter.add(k, |a, b| {
                let (i, j) = (2 * stencil[a], 2 * stencil[b]);
                [entry(i, j), entry(i, j + 1), entry(i + 1, j), entry(i + 1, j + 1)]
            });
            for &i in *stencil {
                for &j in *stencil {
                    for r in 0..2 {
                        for c in 0..2 {
                            dense[2 * i + r][2 * j + c] += entry(2 * i + r, 2 * j + c);
                        }
                    }
                }
            }
        }
        for (d, row) in dense.iter().enumerate() {
            assert_eq!(values[pattern.diagonal(d)], row[d]);
        }
        let v: Vec<f64> = (0..8).map(|i| (i as f64).sin() + 0.3).collect();
        let mut y = vec![0.0; 8];
        pattern.multiply(&values, &v, &mut y);
        for (i, row) in dense.iter().enumerate() {
            let expected: f64 = row.iter().zip(&v).map(|(d, v)| d * v).sum();
            assert!((y[i] - expected).abs() < 1e-12, "row {i}: {} is not {expected}", y[i]);
        }
    }
}
