//! Level lines of a sampled field (marching squares), to a fraction of a sample.

use super::Point;

/// Samples on a square grid, row by row from the top.
pub(super) struct Field {
    pub width: usize,
    pub height: usize,
    pub values: Vec<f32>,
}

const NONE: u32 = u32::MAX;

impl Field {
    /// The field outside its samples counts as 0.
    fn at(&self, x: isize, y: isize) -> f64 {
        if x < 0 || y < 0 || x as usize >= self.width || y as usize >= self.height {
            return 0.0;
        }
        f64::from(self.values[y as usize * self.width + x as usize])
    }

    /// How steep the field is about a point (samples, y up), by differences over so many samples each way, per sample.
    pub fn slope(&self, [x, y]: Point, reach: isize) -> f64 {
        let (x, y) = ((x - 0.5).round() as isize, (-y - 0.5).round() as isize);
        let across = self.at(x + reach, y) - self.at(x - reach, y);
        let down = self.at(x, y + reach) - self.at(x, y - reach);
        across.hypot(down) / (2 * reach) as f64
    }

    /// Each value averaged with its neighbours (weights 1 2 1 along each axis), `passes` times.
    pub fn blurred(mut self, passes: usize) -> Self {
        for _ in 0..passes {
            for (stride, count, line, lines) in
                [(1, self.width, self.width, self.height), (self.width, self.height, 1, self.width)]
            {
                for start in (0..lines).map(|k| k * line) {
                    let mut before = self.values[start];
                    for i in 0..count {
                        let at = start + i * stride;
                        let after = self.values[if i + 1 < count { at + stride } else { at }];
                        let here = self.values[at];
                        self.values[at] = 0.25 * before + 0.5 * here + 0.25 * after;
                        before = here;
                    }
                }
            }
        }
        self
    }

    /// Closed polygons around what is at or above `level`, in samples, y up, the first sample's centre at (0.5, -0.5).
    ///
    /// Walked counter-clockwise around a cell, each crossed side leads either out of the area or into it. A side that
    /// leads out of one cell leads into its neighbour, so joining "out" to "in" in every cell gives closed lines. In a
    /// saddle the mean of the four corners decides whether its middle belongs to the area.
    pub fn contours(&self, level: f64) -> Vec<Vec<Point>> {
        // Cells lie between sample centres, with a frame of zeros around; sides are numbered 2 k (to the right of corner
        // k) and 2 k + 1 (below corner k).
        let columns = self.width + 2;
        let corner = |x: isize, y: isize| (y + 1) as usize * columns + (x + 1) as usize;
        let mut next = vec![NONE; 2 * columns * (self.height + 2)];
        for y in -1..self.height as isize {
            for x in -1..self.width as isize {
                let v = [self.at(x, y), self.at(x, y + 1), self.at(x + 1, y + 1), self.at(x + 1, y)];
                let inside = v.map(|v| v >= level);
                if inside == [inside[0]; 4] {
                    continue;
                }
                let side = [2 * corner(x, y) + 1, 2 * corner(x, y + 1), 2 * corner(x + 1, y) + 1, 2 * corner(x, y)];
                let out = |k: usize| inside[k] && !inside[(k + 1) % 4];
                let enters = |k: usize| !inside[k] && inside[(k + 1) % 4];
                let middle = 0.25 * v.iter().sum::<f64>() >= level;
                for k in (0..4).filter(|&k| out(k)) {
                    let order = if middle { [1, 2, 3] } else { [3, 2, 1] };
                    if let Some(to) = order.into_iter().map(|d| (k + d) % 4).find(|&to| enters(to)) {
                        next[side[k]] = side[to] as u32;
                    }
                }
            }
        }
        self.lines(&mut next, columns, level)
    }

    /// Follows the joined sides.
    fn lines(&self, next: &mut [u32], columns: usize, level: f64) -> Vec<Vec<Point>> {
        let point = |side: usize| -> Point {
            let (k, down) = (side / 2, side % 2);
            let (x, y) = ((k % columns) as isize - 1, (k / columns) as isize - 1);
            let (a, b) = (self.at(x, y), self.at(x + 1 - down as isize, y + down as isize));
            let t = if a == b { 0.5 } else { ((level - a) / (b - a)).clamp(0.0, 1.0) };
            let (dx, dy) = if down == 1 { (0.0, t) } else { (t, 0.0) };
            [x as f64 + 0.5 + dx, -(y as f64 + 0.5 + dy)]
        };
        let mut contours = Vec::new();
        for start in 0..next.len() {
            let mut side = start;
            let mut line = Vec::new();
            while next[side] != NONE {
                line.push(point(side));
                side = std::mem::replace(&mut next[side], NONE) as usize;
            }
            if line.len() >= 3 {
                contours.push(line);
            }
        }
        contours
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::polygon;

    #[test]
    fn a_disc_is_traced_to_a_fraction_of_a_sample() {
        let (n, r) = (80, 30.3);
        let centre = [40.2, -39.6];
        let mut values = Vec::new();
        for y in 0..n {
            for x in 0..n {
                let p = [x as f64 + 0.5, -(y as f64 + 0.5)];
                values.push((r - polygon::length(p, centre) + 0.5).clamp(0.0, 1.0) as f32);
            }
        }
        let field = Field { width: n, height: n, values };
        let contours = field.contours(0.5);
        assert_eq!(contours.len(), 1);
        for p in &contours[0] {
            assert!((polygon::length(*p, centre) - r).abs() < 0.12, "{p:?}");
        }
        assert!((polygon::signed_area(&contours[0]).abs() / (std::f64::consts::PI * r * r) - 1.0).abs() < 2e-3);
    }

    #[test]
    fn areas_at_the_rim_close_and_saddles_part_or_join() {
        let full = Field { width: 4, height: 3, values: vec![1.0; 12] };
        let contours = full.contours(0.5);
        assert_eq!(contours.len(), 1);
        let (low, high) = polygon::bounding_box(&contours[0]);
        assert_eq!((low, high), ([0.0, -3.0], [4.0, 0.0]));
        let saddle = Field { width: 2, height: 2, values: vec![1.0, 0.0, 0.0, 1.0] };
        assert_eq!(saddle.contours(0.6).len(), 2);
        assert_eq!(saddle.contours(0.4).len(), 1);
    }
}
