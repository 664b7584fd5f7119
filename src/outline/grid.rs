//! Which sides of a set of polygons are near a point: sides sorted into square cells.

use super::{Point, polygon};

/// Most cells along a side of the grid: memory stays small however fine the polygons are.
const MAX_CELLS: f64 = 512.0;

/// The sides of polygons in cells of a size of its own choice.
pub(super) struct Grid {
    low: Point,
    cell: f64,
    columns: usize,
    rows: usize,
    cells: Vec<Vec<(Point, Point)>>,
}

impl Grid {
    pub fn new<'a>(rings: impl Iterator<Item = &'a [Point]> + Clone) -> Self {
        let (low, high) = rings.clone().fold(([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]), |(l, h), ring| {
            let (low, high) = polygon::bounding_box(ring);
            ([l[0].min(low[0]), l[1].min(low[1])], [h[0].max(high[0]), h[1].max(high[1])])
        });
        let sides: usize = rings.clone().map(<[Point]>::len).sum();
        let size = (high[0] - low[0]).max(high[1] - low[1]);
        let across = (2.0 * sides as f64).sqrt().clamp(1.0, MAX_CELLS);
        let cell = if size.is_finite() && size > 0.0 { size / across } else { 1.0 };
        let count = |axis: usize| ((high[axis] - low[axis]) / cell).max(0.0) as usize + 1;
        let (columns, rows) = (count(0), count(1));
        let mut grid = Self { low, cell, columns, rows, cells: vec![Vec::new(); columns * rows] };
        for (a, b) in rings.flat_map(polygon::sides) {
            let (from, to) = ([a[0].min(b[0]), a[1].min(b[1])], [a[0].max(b[0]), a[1].max(b[1])]);
            grid.visit(from, to, |cell| cell.push((a, b)));
        }
        grid
    }

    /// Calls `f` with every cell that the box touches.
    fn visit(&mut self, from: Point, to: Point, mut f: impl FnMut(&mut Vec<(Point, Point)>)) {
        let (i, j) = (self.range(0, from, to), self.range(1, from, to));
        for row in j {
            for column in i.clone() {
                f(&mut self.cells[row * self.columns + column]);
            }
        }
    }

    fn range(&self, axis: usize, from: Point, to: Point) -> std::ops::RangeInclusive<usize> {
        let last = [self.columns, self.rows][axis] - 1;
        let at = |p: Point| (((p[axis] - self.low[axis]) / self.cell).max(0.0) as usize).min(last);
        at(from)..=at(to)
    }

    /// Whether a side passes within `reach` of `p`.
    pub fn is_near(&self, p: Point, reach: f64) -> bool {
        self.distance_up_to(p, reach) <= reach
    }

    /// Distance from `p` to the nearest side.
    pub fn distance(&self, p: Point) -> f64 {
        let mut reach = self.cell;
        for _ in 0..64 {
            let found = self.distance_up_to(p, reach);
            if found.is_finite() {
                return found;
            }
            reach *= 2.0;
        }
        f64::INFINITY
    }

    /// Distance from `p` to the nearest side, where that is at most `reach`; infinite elsewhere.
    pub fn distance_up_to(&self, p: Point, reach: f64) -> f64 {
        let (from, to) = ([p[0] - reach, p[1] - reach], [p[0] + reach, p[1] + reach]);
        let mut nearest = f64::INFINITY;
        for row in self.range(1, from, to) {
            for column in self.range(0, from, to) {
                let sides = self.cells[row * self.columns + column].iter().copied();
                nearest = nearest.min(polygon::nearest(sides, p));
            }
        }
        if nearest <= reach { nearest } else { f64::INFINITY }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_of_a_plain_search() {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / 200.0;
        let ring: Vec<Point> =
            (0..200).map(|i| [(3.0 + (5.0 * angle(i)).sin()) * angle(i).cos(), 3.0 * angle(i).sin()]).collect();
        let grid = Grid::new(std::iter::once(ring.as_slice()));
        for i in -10..=10 {
            for j in -10..=10 {
                let p = [0.5 * f64::from(i), 0.5 * f64::from(j)];
                let exact = polygon::distance(&ring, p);
                assert_eq!(grid.distance(p), exact);
                for reach in [0.1, 1.0, 10.0] {
                    let found = grid.distance_up_to(p, reach);
                    assert_eq!(found, if exact <= reach { exact } else { f64::INFINITY }, "{p:?} {reach}");
                }
            }
        }
    }
}
