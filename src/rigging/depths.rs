//! How deep points lie in a body, for searches that ask millions of times and mostly need to know whether that is enough.
//!
//! A depth changes by no more than the way between two points. So a depth that is known at the middle of a cell bounds all others in it from
//! below, and most questions end there.

use crate::outline::{Point, polygon};
use crate::sewing::Body;
use std::sync::OnceLock;

/// Cells along the longer side of the body.
const ACROSS: f64 = 96.0;
/// Steps along a piece after which it is looked at exactly.
const STEPS: usize = 32;
/// Shortest of these steps, mm.
const SHORTEST_MM: f64 = 0.5;

/// The depths in the less deep of two bodies.
pub(super) struct Depths<'a> {
    pub bodies: [Body<'a>; 2],
    low: Point,
    cell: f64,
    columns: usize,
    rows: usize,
    /// Depths at the middles of cells, worked out when they are asked for.
    middles: Vec<OnceLock<f64>>,
}

impl<'a> Depths<'a> {
    pub fn new(bodies: [Body<'a>; 2]) -> Self {
        let (low, high) = bodies[0].bounding_box();
        let [width, height] = [high[0] - low[0], high[1] - low[1]];
        let cell = width.max(height) / ACROSS;
        let count = |length: f64| if cell > 0.0 && cell.is_finite() { (length / cell) as usize + 1 } else { 0 };
        let (columns, rows) = (count(width), count(height));
        Self { bodies, low, cell, columns, rows, middles: vec![OnceLock::new(); columns * rows] }
    }

    /// Distance to the nearer seam, negative outside of a body, mm.
    pub fn exact(&self, p: Point) -> f64 {
        self.bodies[0].depth(p).min(self.bodies[1].depth(p))
    }

    /// A depth that `p` has at least.
    fn at_least(&self, p: Point) -> f64 {
        let [i, j] = [0, 1].map(|axis| (p[axis] - self.low[axis]) / self.cell);
        if !(i >= 0.0 && j >= 0.0 && i < self.columns as f64 && j < self.rows as f64) {
            return f64::NEG_INFINITY;
        }
        let (i, j) = (i as usize, j as usize);
        let middle = [self.low[0] + (i as f64 + 0.5) * self.cell, self.low[1] + (j as f64 + 0.5) * self.cell];
        let depth = *self.middles[j * self.columns + i].get_or_init(|| self.exact(middle));
        depth - polygon::length(middle, p)
    }

    /// The depth of `p` where that is less than `enough`; what it has at least elsewhere.
    pub fn up_to(&self, p: Point, enough: f64) -> f64 {
        let least = self.at_least(p);
        if least >= enough { least } else { self.exact(p) }
    }

    /// Whether the piece from `a` to `b` is known to be inside; where not, it has to be looked at exactly.
    pub fn holds(&self, a: Point, b: Point) -> bool {
        let whole = polygon::length(a, b);
        let mut gone = 0.0;
        for _ in 0..STEPS {
            let depth = self.at_least(polygon::lerp(a, b, if whole > 0.0 { gone / whole } else { 0.0 }));
            if depth < SHORTEST_MM {
                return false;
            }
            // No seam is nearer than that.
            gone += depth;
            if gone > whole {
                return true;
            }
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::Outline;
    use crate::random::Random;
    use crate::sewing;

    /// A ring with a hole, and another a little smaller.
    fn outlines() -> [Outline; 2] {
        [1.0, 0.97].map(|scale| {
            let ring = |radius: f64, turn: f64| -> Vec<Point> {
                let angle = |k: i32| turn * std::f64::consts::TAU * f64::from(k) / 60.0;
                let wave = |k: i32| radius * (1.0 + 0.2 * (5.0 * angle(k)).sin());
                (0..60).map(|k| [wave(k) * angle(k).cos(), wave(k) * angle(k).sin()]).collect()
            };
            Outline { outer: ring(100.0 * scale, 1.0), holes: vec![ring(30.0 / scale, -1.0)] }
        })
    }

    #[test]
    fn what_is_enough_is_a_bound_and_what_is_not_is_exact() {
        let outlines = outlines();
        let depths = Depths::new([Body::new(&outlines[0]), Body::new(&outlines[1])]);
        let random = &mut Random::new(5);
        let mut bounded = 0;
        for _ in 0..3000 {
            let p = [random.between(-130.0, 130.0), random.between(-130.0, 130.0)];
            let exact = depths.exact(p);
            for enough in [1.3, 5.3, 12.3] {
                let told = depths.up_to(p, enough);
                assert!(told == exact || (told >= enough && told <= exact), "{p:?}: {told} for {exact}");
                bounded += usize::from(told != exact);
            }
        }
        assert!(bounded > 2000, "{bounded}");
    }

    #[test]
    fn what_holds_a_piece_has_nothing_of_it_outside() {
        let outlines = outlines();
        let depths = Depths::new([Body::new(&outlines[0]), Body::new(&outlines[1])]);
        let random = &mut Random::new(6);
        let mut held = 0;
        for _ in 0..3000 {
            let [a, b] = [(); 2].map(|()| [random.between(-110.0, 110.0), random.between(-110.0, 110.0)]);
            if depths.holds(a, b) {
                held += 1;
                assert!(outlines.iter().all(|outline| sewing::outside(outline.polygons(), a, b) == 0.0));
            }
        }
        assert!(held > 200, "{held}");
    }
}
