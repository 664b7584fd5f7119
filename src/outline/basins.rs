//! Where a drawn line all but encloses an area: basins of the distance to it.
//!
//! On a raster, pixels are taken from the farthest from the line to the nearest. Those that touch form lakes; when a lake meets the sea (what
//! is outside), the pixel where they meet is the middle of the widest opening of what the lake fills, and its distance to the line half the
//! opening's width. The distances are exact for the raster (Felzenszwalb and Huttenlocher 2012); all takes `n log n` of its pixels.

use super::regions::Shapes;
use super::{Point, polygon};

/// Pixels along the longer side: an opening's place is known to 0.2 % of the size.
const PIXELS: f64 = 500.0;
/// Pixels of sea around the drawing.
const MARGIN: usize = 2;

/// An area that is all but enclosed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Basin {
    /// The middle of its widest opening.
    pub at: Point,
    /// The width of that.
    pub opening: f64,
    /// The farthest that a place in it lies from the line.
    pub depth: f64,
    /// Area of what lies farther from the line than half the opening.
    pub area: f64,
}

/// The basins of a drawing, the largest first.
pub(super) fn basins(shapes: &Shapes) -> Vec<Basin> {
    let (low, high) = super::regions::bounding_box(shapes);
    let size = (high[0] - low[0]).max(high[1] - low[1]);
    let pixel = size / PIXELS;
    if !(pixel.is_finite() && pixel > 0.0) {
        return Vec::new();
    }
    let across = |axis: usize| ((high[axis] - low[axis]) / pixel).ceil() as usize + 2 * MARGIN + 1;
    let raster = Raster { low, pixel, width: across(0), height: across(1) };
    let distances = distances(&raster.covered(shapes), raster.width, raster.height);
    raster.lakes(&distances)
}

struct Raster {
    low: Point,
    pixel: f64,
    width: usize,
    height: usize,
}

impl Raster {
    /// The middle of a pixel.
    fn at(&self, k: usize) -> Point {
        let along = |i: usize, axis: usize| self.low[axis] + (i as f64 - MARGIN as f64 + 0.5) * self.pixel;
        [along(k % self.width, 0), along(k / self.width, 1)]
    }

    fn cell(&self, p: Point) -> [f64; 2] {
        [0, 1].map(|axis| (p[axis] - self.low[axis]) / self.pixel + MARGIN as f64)
    }

    /// Pixels that a side passes or whose middle is covered.
    fn covered(&self, shapes: &Shapes) -> Vec<bool> {
        let mut covered = vec![false; self.width * self.height];
        let mut mark = |x: f64, y: f64| {
            let (x, y) = (x.max(0.0) as usize, y.max(0.0) as usize);
            if x < self.width && y < self.height {
                covered[y * self.width + x] = true;
            }
        };
        let mut crossings: Vec<Vec<f64>> = vec![Vec::new(); self.height];
        for (a, b) in shapes.iter().flatten().flat_map(|ring| polygon::sides(ring)) {
            let (a, b) = (self.cell(a), self.cell(b));
            let steps = (2.0 * polygon::length(a, b)).ceil().clamp(1.0, 4.0 * PIXELS);
            for i in 0..=steps as usize {
                let [x, y] = polygon::lerp(a, b, i as f64 / steps);
                mark(x, y);
            }
            let (from, to) = (a[1].min(b[1]), a[1].max(b[1]));
            let first = (from - 0.5).ceil().max(0.0) as usize;
            let last = ((to - 0.5).ceil().max(0.0) as usize).min(self.height);
            for (row, line) in crossings.iter_mut().enumerate().take(last).skip(first) {
                line.push(a[0] + (row as f64 + 0.5 - a[1]) / (b[1] - a[1]) * (b[0] - a[0]));
            }
        }
        for (row, line) in crossings.iter_mut().enumerate() {
            line.sort_by(f64::total_cmp);
            for pair in line.chunks_exact(2) {
                let (from, to) = ((pair[0] - 0.5).ceil().max(0.0) as usize, (pair[1] - 0.5).ceil().max(0.0) as usize);
                for x in from..to.min(self.width) {
                    covered[row * self.width + x] = true;
                }
            }
        }
        covered
    }

    fn lakes(&self, distances: &[f64]) -> Vec<Basin> {
        let mut order: Vec<usize> = (0..distances.len()).filter(|&k| distances[k] > 0.0).collect();
        order.sort_by(|&a, &b| distances[b].total_cmp(&distances[a]).then(a.cmp(&b)));
        let on_rim = |k: usize| {
            let (x, y) = (k % self.width, k / self.width);
            x == 0 || y == 0 || x + 1 == self.width || y + 1 == self.height
        };
        // The rim is sea from the beginning: it is lake 0.
        let mut lakes = Lakes::new(distances.len());
        let mut found = Vec::new();
        for k in (0..distances.len()).filter(|&k| on_rim(k)) {
            lakes.parent[k] = k;
            lakes.sea[k] = true;
        }
        for k in order {
            if !on_rim(k) {
                lakes.parent[k] = k;
                lakes.count[k] = 1;
                lakes.depth[k] = distances[k];
            }
            let (x, y) = (k % self.width, k / self.width);
            let neighbours = [
                (x > 0).then(|| k - 1),
                (x + 1 < self.width).then(|| k + 1),
                (y > 0).then(|| k - self.width),
                (y + 1 < self.height).then(|| k + self.width),
            ];
            for other in
                neighbours.into_iter().flatten().filter(|&other| lakes.parent[other] != usize::MAX).collect::<Vec<_>>()
            {
                if let Some((depth, count)) = lakes.join(k, other) {
                    let area = count as f64 * self.pixel * self.pixel;
                    let [opening, depth] = [2.0 * distances[k], depth].map(|v| v * self.pixel);
                    found.push(Basin { at: self.at(k), opening, depth, area });
                }
            }
        }
        found.sort_by(|a: &Basin, b| b.area.total_cmp(&a.area));
        found
    }
}

/// Sets of pixels that touch.
struct Lakes {
    parent: Vec<usize>,
    sea: Vec<bool>,
    count: Vec<usize>,
    depth: Vec<f64>,
}

impl Lakes {
    fn new(n: usize) -> Self {
        Self { parent: vec![usize::MAX; n], sea: vec![false; n], count: vec![0; n], depth: vec![0.0; n] }
    }

    fn root(&mut self, mut k: usize) -> usize {
        while self.parent[k] != k {
            self.parent[k] = self.parent[self.parent[k]];
            k = self.parent[k];
        }
        k
    }

    /// Joins two sets; where a lake meets the sea, how deep it is and how many pixels it has.
    fn join(&mut self, a: usize, b: usize) -> Option<(f64, usize)> {
        let (a, b) = (self.root(a), self.root(b));
        if a == b {
            return None;
        }
        let lake = match (self.sea[a], self.sea[b]) {
            (true, false) => Some((self.depth[b], self.count[b])),
            (false, true) => Some((self.depth[a], self.count[a])),
            _ => None,
        };
        let (low, high) = if self.count[a] < self.count[b] { (a, b) } else { (b, a) };
        self.parent[low] = high;
        self.count[high] += self.count[low];
        self.depth[high] = self.depth[high].max(self.depth[low]);
        self.sea[high] |= self.sea[low];
        lake
    }
}

/// The distance of each pixel to the nearest covered one, in pixels.
fn distances(covered: &[bool], width: usize, height: usize) -> Vec<f64> {
    // Farther than any, and small enough that its square keeps its digits.
    let far = (width + height) as f64;
    let mut squares: Vec<f64> = covered.iter().map(|&c| if c { 0.0 } else { far * far }).collect();
    for (stride, count, line, lines) in [(1, width, width, height), (width, height, 1, width)] {
        for start in (0..lines).map(|k| k * line) {
            let values: Vec<f64> = (0..count).map(|i| squares[start + i * stride]).collect();
            for (i, square) in lower_envelope(&values).into_iter().enumerate() {
                squares[start + i * stride] = square;
            }
        }
    }
    squares.into_iter().map(f64::sqrt).collect()
}

/// `min over j of (i - j)^2 + f(j)` for every `i`: the lower envelope of parabolas.
fn lower_envelope(f: &[f64]) -> Vec<f64> {
    let mut hull: Vec<(usize, f64)> = Vec::with_capacity(f.len());
    for (q, &value) in f.iter().enumerate() {
        let mut from = f64::NEG_INFINITY;
        while let Some(&(v, start)) = hull.last() {
            let (a, b) = (q as f64, v as f64);
            from = ((value + a * a) - (f[v] + b * b)) / (2.0 * (a - b));
            if from > start {
                break;
            }
            hull.pop();
            from = f64::NEG_INFINITY;
        }
        hull.push((q, from));
    }
    let mut k = 0;
    (0..f.len())
        .map(|i| {
            while hull.get(k + 1).is_some_and(|next| next.1 < i as f64) {
                k += 1;
            }
            let v = hull[k].0;
            (i as f64 - v as f64).powi(2) + f[v]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_those_of_all_pairs() {
        let covered: Vec<bool> = (0..20 * 13).map(|k| k * k % 37 == 3).collect();
        assert!(covered.contains(&true));
        let found = distances(&covered, 20, 13);
        for (k, found) in found.iter().enumerate() {
            let to = |j: usize| ((k % 20) as f64 - (j % 20) as f64).hypot((k / 20) as f64 - (j / 20) as f64);
            let nearest = (0..covered.len()).filter(|&j| covered[j]).map(to).fold(f64::INFINITY, f64::min);
            assert!((found - nearest).abs() < 1e-9, "{k}");
        }
    }

    /// A ring of radius 100 and width 2 with an opening of 10 at its right.
    #[test]
    fn the_opening_of_a_ring_is_found_with_its_width() {
        let half = (5.0_f64 / 100.0).asin();
        let at = |r: f64, t: f64| [r * t.cos(), r * t.sin()];
        let angle = |i: usize| half + (std::f64::consts::TAU - 2.0 * half) * i as f64 / 300.0;
        let outer = (0..=300).map(|i| at(101.0, angle(i)));
        let inner = (0..=300).rev().map(|i| at(99.0, angle(i)));
        let ring: Vec<Point> = outer.chain(inner).collect();
        let found = basins(&vec![vec![ring]]);
        let Basin { at: [x, y], opening, depth, area } = found[0];
        assert!((x - 100.0).abs() < 2.0 && y.abs() < 1.0, "{found:?}");
        assert!((opening - 10.0).abs() < 1.5 && (depth - 99.0).abs() < 1.0, "{found:?}");
        assert!((area / (std::f64::consts::PI * 94.0 * 94.0) - 1.0).abs() < 0.03, "{found:?}");
    }
}
