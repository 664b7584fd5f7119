//! Triangular solves with a factor that is stored in panels: dense columns of the same structure (supernodes).
//!
//! Several right-hand sides stand side by side, row after row, so that each value of the factor is read once for all of them.
//! Going forward, a panel is passed over for a group of right-hand sides that are zero so far in all its rows: one that begins in
//! a few nodes only climbs the elimination tree from there.

use super::wide::{self, Work, multiply_add};
use std::ops::Range;

/// The structure of the panels, and their places in the values of the factor.
#[derive(Clone, Debug, Default)]
pub(super) struct Panels {
    /// Original index of every row of the factor.
    order: Vec<u32>,
    panels: Vec<Panel>,
    /// Rows below the diagonal block of each panel.
    rows: Vec<u32>,
}

/// Columns `first .. first + width`; values column after column, each of `width + below` rows.
#[derive(Clone, Copy, Debug)]
struct Panel {
    first: u32,
    width: u32,
    /// Its rows below the diagonal block begin here, and so many.
    rows: u32,
    below: u32,
    values: u32,
    /// The panel that holds its first row below: the next one up the elimination tree.
    parent: u32,
}

/// Right-hand sides that are carried side by side, at most.
const WIDE: usize = 12;
/// Rows or columns of a panel that are worked on at once.
const BLOCK: usize = 4;

/// Memory of a solve, kept between solves.
#[derive(Clone, Debug, Default)]
pub(super) struct Memory {
    /// A group of right-hand sides in the factor's order, row after row.
    side: Vec<f64>,
    /// Whether a panel has to be looked at, for the first and the last of them.
    touched: Vec<[bool; 2]>,
}

impl Panels {
    /// `order` (see there), and of each panel the first column, the rows below and where its values begin.
    pub fn new<'a>(order: Vec<u32>, panels: impl Iterator<Item = (usize, usize, &'a [usize], usize)>) -> Self {
        let mut out = Self { order, ..Self::default() };
        let mut panel_of = vec![0_u32; out.order.len()];
        for (first, width, below, values) in panels {
            panel_of[first..first + width].fill(out.panels.len() as u32);
            out.panels.push(Panel {
                first: first as u32,
                width: width as u32,
                rows: out.rows.len() as u32,
                below: below.len() as u32,
                values: values as u32,
                parent: 0,
            });
            out.rows.extend(below.iter().map(|&row| row as u32));
        }
        for panel in &mut out.panels {
            panel.parent = out.rows.get(panel.rows as usize).map_or(0, |&row| panel_of[row as usize]);
        }
        out
    }

    /// Memory for any number of right-hand sides.
    pub fn memory(&self) -> Memory {
        Memory { side: vec![0.0; WIDE * self.order.len()], touched: vec![[false; 2]; self.panels.len()] }
    }

    /// Solves `L L^T z = rhs` in place for the right-hand sides `columns`, of which row `i` of number `c` stands at
    /// `i layout[0] + c layout[1]`.
    pub fn solve(
        &self,
        factor: &[f64],
        rhs: &mut [f64],
        columns: Range<usize>,
        layout: [usize; 2],
        memory: &mut Memory,
    ) {
        wide::run(Solve { panels: self, factor, rhs, columns, layout, memory });
    }
}

struct Solve<'a> {
    panels: &'a Panels,
    factor: &'a [f64],
    rhs: &'a mut [f64],
    columns: Range<usize>,
    layout: [usize; 2],
    memory: &'a mut Memory,
}

impl Work for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn run<const FUSED: bool>(self) {
        let Solve { panels, factor, rhs, columns, layout, memory } = self;
        let mut first = columns.start;
        while first < columns.end {
            let count = (columns.end - first).min(WIDE);
            let group = Group { panels, factor, first, count, layout };
            match count {
                1 => group.solve::<FUSED, 1, 1, 0>(rhs, memory),
                2 => group.solve::<FUSED, 2, 2, 0>(rhs, memory),
                3 | 4 => group.solve::<FUSED, 4, 4, 0>(rhs, memory),
                5..=8 => group.solve::<FUSED, 8, 8, 0>(rhs, memory),
                _ => group.solve::<FUSED, 12, 8, 4>(rhs, memory),
            }
            first += count;
        }
    }
}

/// Right-hand sides that are carried together.
struct Group<'a> {
    panels: &'a Panels,
    factor: &'a [f64],
    first: usize,
    count: usize,
    layout: [usize; 2],
}

impl Group<'_> {
    /// `N = A + B` side by side. Going forward, the first `A` and the last `B` are looked at apart: they may be zero in different
    /// panels.
    #[inline(always)]
    fn solve<const FUSED: bool, const N: usize, const A: usize, const B: usize>(
        &self,
        rhs: &mut [f64],
        memory: &mut Memory,
    ) {
        let Panels { order, panels, .. } = self.panels;
        let Memory { side, touched: flags } = memory;
        let side = &mut side.as_chunks_mut::<N>().0[..order.len()];
        let [by_row, by_column] = self.layout;
        let place = |row: u32| row as usize * by_row + self.first * by_column;
        for (lanes, &row) in side.iter_mut().zip(order) {
            let from = rhs[place(row)..].iter().step_by(by_column);
            *lanes = [0.0; N];
            for (lane, v) in lanes[..self.count].iter_mut().zip(from) {
                *lane = *v;
            }
        }
        flags.fill([false; 2]);
        for (k, panel) in panels.iter().enumerate() {
            let mut touched = flags[k];
            for lanes in &side[panel.first as usize..][..panel.width as usize] {
                touched[0] |= lanes[..A].iter().any(|v| *v != 0.0);
                touched[1] |= lanes[A..].iter().any(|v| *v != 0.0);
            }
            if touched == [false; 2] {
                continue;
            }
            if panel.below > 0 {
                let parent = &mut flags[panel.parent as usize];
                *parent = [parent[0] | touched[0], parent[1] | touched[1]];
            }
            let dense = self.panels.dense(panel, self.factor);
            if touched[0] {
                forward::<FUSED, N, 0, A>(&dense, side);
            }
            if B > 0 && touched[1] {
                forward::<FUSED, N, A, B>(&dense, side);
            }
        }
        for panel in panels.iter().rev() {
            backward::<FUSED, N>(&self.panels.dense(panel, self.factor), side);
        }
        for (lanes, &row) in side.iter().zip(order) {
            let to = rhs[place(row)..].iter_mut().step_by(by_column);
            for (lane, v) in lanes[..self.count].iter().zip(to) {
                *v = *lane;
            }
        }
    }
}

/// A panel with its values: columns of `height` rows, the diagonal block first.
struct Dense<'a> {
    first: usize,
    width: usize,
    height: usize,
    values: &'a [f64],
    rows: &'a [u32],
}

impl Panels {
    #[inline(always)]
    fn dense<'a>(&'a self, panel: &Panel, factor: &'a [f64]) -> Dense<'a> {
        let (width, height) = (panel.width as usize, (panel.width + panel.below) as usize);
        Dense {
            first: panel.first as usize,
            width,
            height,
            values: &factor[panel.values as usize..][..width * height],
            rows: &self.rows[panel.rows as usize..][..panel.below as usize],
        }
    }
}

/// `y - a x`.
#[inline(always)]
fn take<const FUSED: bool, const N: usize>(y: &mut [f64; N], a: f64, x: &[f64; N]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y = multiply_add::<FUSED>(-a, *x, *y);
    }
}

/// `z := L^-1 z` for the columns of one panel and the lanes `FROM .. FROM + W`: the diagonal block, then what it takes from the
/// rows below.
#[inline(always)]
fn forward<const FUSED: bool, const N: usize, const FROM: usize, const W: usize>(panel: &Dense, side: &mut [[f64; N]]) {
    let Dense { first, width, height, values, rows } = *panel;
    let (_, rest) = side.split_at_mut(first);
    let (own, below) = rest.split_at_mut(width);
    for (j, column) in values.chunks_exact(height).enumerate() {
        let (done, open) = own.split_at_mut(j + 1);
        let z = part_mut::<N, FROM, W>(&mut done[j]);
        let inverse = column[j].recip();
        for v in z.iter_mut() {
            *v *= inverse;
        }
        for (v, l) in open.iter_mut().zip(&column[j + 1..width]) {
            take::<FUSED, W>(part_mut::<N, FROM, W>(v), *l, z);
        }
    }
    let base = first + width;
    let blocks = rows.chunks_exact(BLOCK);
    let tail = blocks.remainder();
    for (b, rows) in blocks.enumerate() {
        let mut sums = [[0.0; W]; BLOCK];
        for (column, z) in values.chunks_exact(height).zip(own.iter()) {
            let l = &column[width + b * BLOCK..][..BLOCK];
            for (sum, l) in sums.iter_mut().zip(l) {
                take::<FUSED, W>(sum, *l, part::<N, FROM, W>(z));
            }
        }
        for (sum, &row) in sums.iter().zip(rows) {
            for (v, s) in part_mut::<N, FROM, W>(&mut below[row as usize - base]).iter_mut().zip(sum) {
                *v += s;
            }
        }
    }
    let done = rows.len() - tail.len();
    for (i, &row) in tail.iter().enumerate() {
        let mut sum = [0.0; W];
        for (column, z) in values.chunks_exact(height).zip(own.iter()) {
            take::<FUSED, W>(&mut sum, column[width + done + i], part::<N, FROM, W>(z));
        }
        for (v, s) in part_mut::<N, FROM, W>(&mut below[row as usize - base]).iter_mut().zip(&sum) {
            *v += s;
        }
    }
}

/// The lanes `FROM .. FROM + W`.
#[inline(always)]
fn part<const N: usize, const FROM: usize, const W: usize>(lanes: &[f64; N]) -> &[f64; W] {
    lanes[FROM..].first_chunk().expect("the lanes are there")
}

#[inline(always)]
fn part_mut<const N: usize, const FROM: usize, const W: usize>(lanes: &mut [f64; N]) -> &mut [f64; W] {
    lanes[FROM..].first_chunk_mut().expect("the lanes are there")
}

/// `z := L^-T z` for the columns of one panel.
#[inline(always)]
fn backward<const FUSED: bool, const N: usize>(panel: &Dense, side: &mut [[f64; N]]) {
    let Dense { first, width, height, values, rows } = *panel;
    let (_, rest) = side.split_at_mut(first);
    let (own, below) = rest.split_at_mut(width);
    let base = first + width;
    let mut j = 0;
    while j + BLOCK <= width {
        let columns: [&[f64]; BLOCK] = std::array::from_fn(|k| &values[(j + k) * height + width..][..rows.len()]);
        let mut sums = [[0.0; N]; BLOCK];
        for (i, &row) in rows.iter().enumerate() {
            let x = &below[row as usize - base];
            for (sum, column) in sums.iter_mut().zip(&columns) {
                take::<FUSED, N>(sum, column[i], x);
            }
        }
        for (v, sum) in own[j..j + BLOCK].iter_mut().zip(&sums) {
            for (v, s) in v.iter_mut().zip(sum) {
                *v += s;
            }
        }
        j += BLOCK;
    }
    for j in j..width {
        let column = &values[j * height + width..][..rows.len()];
        let mut sum = [0.0; N];
        for (l, &row) in column.iter().zip(rows) {
            take::<FUSED, N>(&mut sum, *l, &below[row as usize - base]);
        }
        for (v, s) in own[j].iter_mut().zip(&sum) {
            *v += s;
        }
    }
    for j in (0..width).rev() {
        let column = &values[j * height..][..width];
        let (open, done) = own.split_at_mut(j + 1);
        let z = &mut open[j];
        for (x, l) in done.iter().zip(&column[j + 1..]) {
            take::<FUSED, N>(z, *l, x);
        }
        let inverse = column[j].recip();
        for v in z.iter_mut() {
            *v *= inverse;
        }
    }
}
