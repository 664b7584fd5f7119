//! A path with few points along a polygon or a freehand line.

use super::{PathPoint, Primitive};
use crate::outline::simplify::simplify;
use crate::outline::{Point, polygon};

/// Simplifications tried in turn, in units of the tolerance: the curve through few points may stay nearer than its chords.
const COARSENESS: [f64; 6] = [8.0, 4.0, 2.0, 1.0, 0.5, 0.25];
/// A bend sharper than this, seen over [`CORNER_REACH`] to both sides, is a corner, rad.
const CORNER: f64 = 0.9;
/// In units of the tolerance.
const CORNER_REACH: f64 = 5.0;

impl Primitive {
    /// A closed path along a line drawn by hand; its ends are joined. `None` for a line that encloses nothing.
    ///
    /// The path strays from the line by no more than `tolerance`, mm.
    pub fn along(line: &[Point], tolerance: f64) -> Option<Self> {
        let mut ring: Vec<Point> = line.to_vec();
        ring.dedup();
        if ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        let enclosed = polygon::signed_area(&ring).abs() > tolerance * tolerance;
        (ring.len() >= 3 && enclosed).then(|| path(&ring, tolerance))
    }
}

/// The path with the fewest points found that strays from a ring by no more than `tolerance`.
pub(super) fn path(ring: &[Point], tolerance: f64) -> Primitive {
    let corners = Corners::of(ring, CORNER_REACH * tolerance);
    for coarseness in COARSENESS {
        let points = simplify(ring, coarseness * tolerance);
        if points.len() < 3 {
            continue;
        }
        let points = points.into_iter().map(|at| PathPoint { at, corner: corners.is_sharp(at) }).collect();
        let path = Primitive::Path { points };
        let drawn = path.polygon();
        let near = |a: &[Point], b: &[Point]| a.iter().all(|&p| polygon::distance(b, p) <= tolerance);
        if near(ring, &drawn) && near(&drawn, ring) {
            return path;
        }
    }
    let corner = |at| PathPoint { at, corner: true };
    Primitive::Path { points: simplify(ring, tolerance).into_iter().map(corner).collect() }
}

/// A ring by arc length, to see how it bends.
struct Corners<'a> {
    ring: &'a [Point],
    reach: f64,
}

impl<'a> Corners<'a> {
    fn of(ring: &'a [Point], reach: f64) -> Self {
        Self { ring, reach }
    }

    /// Whether the ring has a corner at one of its points.
    fn is_sharp(&self, at: Point) -> bool {
        let Some(i) = self.ring.iter().position(|&p| p == at) else { return false };
        let n = self.ring.len();
        let ahead = self.walk(at, (1..n).map(|k| (i + k) % n));
        let behind = self.walk(at, (1..n).map(|k| (i + n - k) % n));
        let (a, b) = ([at[0] - behind[0], at[1] - behind[1]], [ahead[0] - at[0], ahead[1] - at[1]]);
        let turn = (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
        turn.abs() > CORNER
    }

    /// The place that is reached along points of the ring.
    fn walk(&self, from: Point, along: impl Iterator<Item = usize>) -> Point {
        let (mut here, mut left) = (from, self.reach);
        for k in along {
            let step = polygon::length(here, self.ring[k]);
            if step >= left {
                return polygon::lerp(here, self.ring[k], left / step);
            }
            left -= step;
            here = self.ring[k];
        }
        here
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn points(path: &Primitive) -> &[PathPoint] {
        let Primitive::Path { points } = path else { panic!("not a path") };
        points
    }

    #[test]
    fn a_circle_needs_few_points_and_a_square_four_corners() {
        let circle: Vec<Point> = (0..300)
            .map(|i| {
                let (sin, cos) = (TAU * f64::from(i) / 300.0).sin_cos();
                [100.0 * cos, 100.0 * sin]
            })
            .collect();
        let path = Primitive::along(&circle, 0.5).unwrap();
        assert!(points(&path).len() < 20 && points(&path).iter().all(|p| !p.corner), "{}", points(&path).len());
        let side = |k: usize, t: f64| [[t, 0.0], [100.0, t], [100.0 - t, 100.0], [0.0, 100.0 - t]][k];
        let square: Vec<Point> = (0..4).flat_map(|k| (0..50).map(move |i| side(k, 2.0 * f64::from(i)))).collect();
        let path = Primitive::along(&square, 0.5).unwrap();
        assert!(points(&path).len() == 4 && points(&path).iter().all(|p| p.corner), "{path:?}");
    }

    #[test]
    fn a_line_that_encloses_nothing_is_none() {
        assert_eq!(Primitive::along(&[], 1.0), None);
        assert_eq!(Primitive::along(&[[0.0, 0.0], [50.0, 0.0], [100.0, 0.0]], 1.0), None);
        assert_eq!(Primitive::along(&[[3.0, 3.0]; 20], 1.0), None);
    }
}
