//! How wide the body is on the way from one place to another: whether a housing gets in.

use crate::outline::polygon::length;
use crate::outline::{Outline, Point};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Cells along the longer side of the body: a way is found wider or narrower by at most a cell's diagonal.
const CELLS: f64 = 160.0;

/// The depth of a body in cells.
pub struct Access {
    low: Point,
    cell: f64,
    columns: usize,
    /// Distance of a cell's middle to the seam, mm; negative outside.
    depth: Vec<f64>,
    /// The cells inside, the deepest first.
    discs: Vec<usize>,
}

impl Access {
    pub fn new(outline: &Outline) -> Self {
        let (low, high) = outline.bounding_box();
        let [w, h] = [high[0] - low[0], high[1] - low[1]];
        let cell = (w.max(h) / CELLS).max(f64::MIN_POSITIVE);
        let count = |side: f64| (side / cell).ceil().max(1.0) as usize;
        let (columns, rows) = (count(w), count(h));
        let near = outline.near();
        let mut access = Self { low, cell, columns, depth: Vec::new(), discs: Vec::new() };
        let signed = |p: Point| if outline.contains(p) { near.distance(p) } else { -near.distance(p) };
        access.depth = (0..columns * rows).map(|i| signed(access.middle(i))).collect();
        access.discs = (0..columns * rows).filter(|&i| access.depth[i] > 0.0).collect();
        access.discs.sort_by(|&i, &j| access.depth[j].total_cmp(&access.depth[i]));
        access
    }

    fn index(&self, p: Point) -> usize {
        let rows = self.depth.len() / self.columns;
        let at = |k: usize, count: usize| (((p[k] - self.low[k]) / self.cell).max(0.0) as usize).min(count - 1);
        at(1, rows) * self.columns + at(0, self.columns)
    }

    fn neighbours(&self, i: usize) -> impl Iterator<Item = usize> + use<> {
        let (columns, rows) = (self.columns as i64, (self.depth.len() / self.columns) as i64);
        let (x, y) = (i as i64 % columns, i as i64 / columns);
        let steps = [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)];
        steps.into_iter().filter_map(move |(dx, dy)| {
            let (x, y) = (x + dx, y + dy);
            ((0..columns).contains(&x) && (0..rows).contains(&y)).then_some((y * columns + x) as usize)
        })
    }

    /// For each cell the flat width of the body, mm, at the narrowest place of the widest way to `from`; what is around `from` itself within
    /// `free_mm` does not count. 0 outside of the body.
    pub fn ways(&self, from: Point, free_mm: f64) -> Vec<f64> {
        let start = self.index(from);
        let mut widest = vec![0.0_f64; self.depth.len()];
        let mut open = BinaryHeap::new();
        // Not-negative floats are ordered as their bits are.
        let mut push = |open: &mut BinaryHeap<(u64, Reverse<usize>)>, i: usize, width: f64| {
            if width > widest[i] {
                widest[i] = width;
                open.push((width.to_bits(), Reverse(i)));
            }
        };
        let reach = (free_mm / self.cell).ceil() as i64;
        let best = self.around(start, reach).into_iter().map(|i| self.depth[i]).fold(self.depth[start], f64::max);
        push(&mut open, start, 2.0 * best.max(0.0));
        while let Some((bits, Reverse(i))) = open.pop() {
            let width = f64::from_bits(bits);
            for j in self.neighbours(i) {
                let near_start = self.steps(start, j) <= reach;
                let own = if near_start { 2.0 * best } else { 2.0 * self.depth[j] };
                if self.depth[j] > 0.0 {
                    push(&mut open, j, width.min(own));
                }
            }
        }
        widest
    }

    /// The widest of the ways that end within `reach_mm` of a place.
    pub fn to(&self, ways: &[f64], place: Point, reach_mm: f64) -> f64 {
        let reach = (reach_mm / self.cell).ceil() as i64;
        self.around(self.index(place), reach).into_iter().map(|i| ways[i]).fold(0.0, f64::max)
    }

    /// Radius of the largest disc in the body that covers a place, mm, to a cell's diagonal (local thickness; Hildebrand and Rüegsegger 1997).
    pub fn thickness(&self, place: Point) -> f64 {
        let slack = std::f64::consts::SQRT_2 * self.cell;
        let covers = |i: usize| length(self.middle(i), place) <= self.depth[i] + slack;
        self.discs.iter().find(|&&i| covers(i)).map_or(0.0, |&i| self.depth[i])
    }

    /// Radius of the largest disc in the body, mm.
    pub fn thickest(&self) -> f64 {
        self.discs.first().map_or(f64::MIN_POSITIVE, |&i| self.depth[i])
    }

    fn middle(&self, i: usize) -> Point {
        let [column, row] = [i % self.columns, i / self.columns].map(|k| k as f64 + 0.5);
        [self.low[0] + self.cell * column, self.low[1] + self.cell * row]
    }

    fn steps(&self, i: usize, j: usize) -> i64 {
        let (columns, i, j) = (self.columns as i64, i as i64, j as i64);
        (i % columns - j % columns).abs().max((i / columns - j / columns).abs())
    }

    fn around(&self, i: usize, reach: i64) -> Vec<usize> {
        let (columns, rows) = (self.columns as i64, (self.depth.len() / self.columns) as i64);
        let (x, y) = (i as i64 % columns, i as i64 / columns);
        let (xs, ys) =
            ((x - reach).max(0)..=(x + reach).min(columns - 1), (y - reach).max(0)..=(y + reach).min(rows - 1));
        ys.flat_map(|y| xs.clone().map(move |x| (y * columns + x) as usize)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_is_as_wide_as_its_narrowest_place() {
        // Two rooms of 60 mm with a passage of 20 mm between them.
        let outer = vec![
            [0.0, 0.0],
            [60.0, 0.0],
            [60.0, 20.0],
            [100.0, 20.0],
            [100.0, 0.0],
            [160.0, 0.0],
            [160.0, 60.0],
            [100.0, 60.0],
            [100.0, 40.0],
            [60.0, 40.0],
            [60.0, 60.0],
            [0.0, 60.0],
        ];
        let access = Access::new(&Outline { outer, holes: vec![] });
        let ways = access.ways([30.0, 30.0], 5.0);
        assert!((access.to(&ways, [130.0, 30.0], 2.0) - 20.0).abs() < 2.0);
        assert!((access.to(&ways, [30.0, 30.0], 2.0) - 60.0).abs() < 2.0);
    }

    #[test]
    fn thickness_is_that_of_the_disc_and_not_of_the_place() {
        // A square of 100 mm with a limb of 20 mm at its right side.
        let outer = vec![
            [0.0, 0.0],
            [100.0, 0.0],
            [100.0, 40.0],
            [180.0, 40.0],
            [180.0, 60.0],
            [100.0, 60.0],
            [100.0, 100.0],
            [0.0, 100.0],
        ];
        let access = Access::new(&Outline { outer, holes: vec![] });
        let diagonal = std::f64::consts::SQRT_2 * access.cell;
        assert!((access.thickest() - 50.0).abs() < 2.0 * diagonal);
        for (place, radius) in [([50.0, 0.0], 50.0), ([150.0, 40.0], 10.0), ([180.0, 50.0], 10.0)] {
            assert!(
                (access.thickness(place) - radius).abs() < 2.0 * diagonal,
                "{place:?}: {}",
                access.thickness(place)
            );
        }
    }
}
