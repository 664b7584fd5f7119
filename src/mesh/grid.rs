//! Distances to many segments, by a grid of square cells.

use crate::outline::{Point, polygon};

/// Segments in square cells, each in every cell that its box touches.
pub(super) struct Grid {
    segments: Vec<(Point, Point)>,
    low: Point,
    cell: f64,
    size: [usize; 2],
    /// Segments of cell `i`: `items[starts[i]..starts[i + 1]]`.
    starts: Vec<usize>,
    items: Vec<usize>,
}

impl Grid {
    /// About as many cells as segments.
    pub fn new(segments: Vec<(Point, Point)>) -> Self {
        let ends: Vec<Point> = segments.iter().flat_map(|&(a, b)| [a, b]).collect();
        let (low, high) = polygon::bounding_box(&ends);
        let extent = [high[0] - low[0], high[1] - low[1]].map(|v| if v.is_finite() { v.max(0.0) } else { 0.0 });
        let cells = segments.len().clamp(1, 1 << 20) as f64;
        let cell = (extent[0] * extent[1] / cells).sqrt().max(extent[0].max(extent[1]) / cells).max(f64::MIN_POSITIVE);
        let size = extent.map(|v| (v / cell) as usize + 1);
        let mut grid = Self { segments, low, cell, size, starts: vec![0; size[0] * size[1] + 1], items: Vec::new() };
        let boxes: Vec<[[usize; 2]; 2]> =
            grid.segments.iter().map(|&(a, b)| grid.cells(polygon::bounding_box(&[a, b]))).collect();
        let each = |range: &[[usize; 2]; 2], mut put: Box<dyn FnMut(usize) + '_>| {
            for y in range[0][1]..=range[1][1] {
                for x in range[0][0]..=range[1][0] {
                    put(y * size[0] + x);
                }
            }
        };
        for range in &boxes {
            each(range, Box::new(|i| grid.starts[i + 1] += 1));
        }
        for i in 1..grid.starts.len() {
            grid.starts[i] += grid.starts[i - 1];
        }
        let mut next = grid.starts.clone();
        grid.items = vec![0; next.last().copied().unwrap_or(0)];
        for (k, range) in boxes.iter().enumerate() {
            each(
                range,
                Box::new(|i| {
                    grid.items[next[i]] = k;
                    next[i] += 1;
                }),
            );
        }
        grid
    }

    fn cells(&self, (low, high): (Point, Point)) -> [[usize; 2]; 2] {
        [low, high].map(|p| {
            [0, 1].map(|axis| {
                let i = ((p[axis] - self.low[axis]) / self.cell).floor();
                if i > 0.0 { (i as usize).min(self.size[axis] - 1) } else { 0 }
            })
        })
    }

    /// Distance from `p` to the nearest segment; infinite for none.
    pub fn distance(&self, p: Point) -> f64 {
        let [x, y] = self.cells((p, p))[0];
        // How far outside the grid: what the rings of cells around the nearest cell do not cover.
        let mut nearest = f64::INFINITY;
        for ring in 0..=self.size[0].max(self.size[1]) {
            // Everything in farther rings is at least this far.
            if (ring as f64 - 1.0) * self.cell > nearest {
                break;
            }
            let (x0, x1, y0, y1) = (x.saturating_sub(ring), x + ring, y.saturating_sub(ring), y + ring);
            for j in y0..=y1.min(self.size[1] - 1) {
                for i in x0..=x1.min(self.size[0] - 1) {
                    if i.abs_diff(x).max(j.abs_diff(y)) != ring {
                        continue;
                    }
                    let cell = j * self.size[0] + i;
                    for &k in &self.items[self.starts[cell]..self.starts[cell + 1]] {
                        let (a, b) = self.segments[k];
                        nearest = nearest.min(polygon::distance_to_segment(a, b, p));
                    }
                }
            }
        }
        nearest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_agrees_with_all_pairs() {
        let point = |k: f64| [100.0 * (12.9898 * k).sin(), 60.0 * (78.233 * k).sin()];
        let segments: Vec<(Point, Point)> = (0..300)
            .map(|k| {
                let a = point(f64::from(k));
                let d = point(f64::from(k) + 0.5);
                (a, [a[0] + 0.1 * d[0], a[1] + 0.1 * d[1]])
            })
            .collect();
        let grid = Grid::new(segments.clone());
        for k in 0..500 {
            let p = point(f64::from(k) + 0.25).map(|v| 1.7 * v);
            let slow =
                segments.iter().map(|&(a, b)| polygon::distance_to_segment(a, b, p)).fold(f64::INFINITY, f64::min);
            assert_eq!(grid.distance(p), slow, "{p:?}");
        }
        assert_eq!(Grid::new(Vec::new()).distance([1.0, 2.0]), f64::INFINITY);
        assert_eq!(Grid::new(vec![([1.0, 1.0], [1.0, 1.0])]).distance([1.0, 3.0]), 2.0);
    }
}
