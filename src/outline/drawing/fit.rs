//! A path with few points along a polygon or a freehand line.

use super::primitive::segment;
use super::{PathPoint, Primitive};
use crate::outline::simplify::simplify;
use crate::outline::{Point, polygon};

/// Where the fit begins: the simplification of the line, in units of the tolerance.
const COARSENESS: f64 = 4.0;
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

/// A path with few points that strays from a ring by no more than `tolerance`.
///
/// It begins with the points that a coarse simplification leaves. Where a segment strays too far, the point farthest from its
/// chord is put in; where the chord itself is near enough and only the curve swings out, its sharper end becomes a corner.
pub(super) fn path(ring: &[Point], tolerance: f64) -> Primitive {
    let corners = Corners::of(ring, CORNER_REACH * tolerance);
    let kept = simplify(ring, COARSENESS * tolerance);
    // They come in the order of the ring, from anywhere on it.
    let mut round = ring.iter().enumerate().cycle().take(2 * ring.len());
    let mut places: Vec<usize> = kept.iter().filter_map(|p| round.find(|(_, q)| *q == p)).map(|(i, _)| i).collect();
    places.sort_unstable();
    places.dedup();
    for k in 0.. {
        if places.len() >= 3 || k >= ring.len() {
            break;
        }
        if let Err(at) = places.binary_search(&k) {
            places.insert(at, k);
        }
    }
    let mut sharp: Vec<bool> = places.iter().map(|&i| corners.turn(i) > CORNER).collect();
    // Each round adds a point or a corner.
    loop {
        let points: Vec<PathPoint> =
            places.iter().zip(&sharp).map(|(&i, &corner)| PathPoint { at: ring[i], corner }).collect();
        let mut added = Vec::new();
        for i in 0..places.len() {
            let stretch = Stretch::of(ring, places[i], places[(i + 1) % places.len()]);
            let mut drawn = segment(&points, i);
            drawn.push(points[(i + 1) % points.len()].at);
            if stretch.strays(&drawn) <= tolerance {
                continue;
            }
            match stretch.farthest_from_chord() {
                Some((at, distance)) if distance > tolerance => added.push(at),
                _ => {
                    let ends = [i, (i + 1) % places.len()];
                    let open = ends.into_iter().filter(|&e| !sharp[e]);
                    let turn = |e: &usize| corners.turn(places[*e]);
                    if let Some(end) = open.max_by(|a, b| turn(a).total_cmp(&turn(b))) {
                        sharp[end] = true;
                    }
                }
            }
        }
        let unchanged = added.is_empty() && points.iter().zip(&sharp).all(|(p, &s)| p.corner == s);
        if unchanged {
            return Primitive::Path { points };
        }
        for at in added {
            if let Err(k) = places.binary_search(&at) {
                places.insert(k, at);
                sharp.insert(k, corners.turn(at) > CORNER);
            }
        }
    }
}

/// The points of a ring from one to another.
struct Stretch<'a> {
    ring: &'a [Point],
    places: Vec<usize>,
}

impl<'a> Stretch<'a> {
    fn of(ring: &'a [Point], from: usize, to: usize) -> Self {
        let to = if to <= from { to + ring.len() } else { to };
        Self { ring, places: (from..=to).map(|i| i % ring.len()).collect() }
    }

    fn points(&self) -> Vec<Point> {
        self.places.iter().map(|&i| self.ring[i]).collect()
    }

    /// The farthest that a line between the same ends is from this one.
    fn strays(&self, line: &[Point]) -> f64 {
        let own = self.points();
        let away = |points: &[Point], line: &[Point]| {
            let to_line = |p: &Point| {
                let sides = line.windows(2).map(|w| polygon::distance_to_segment(w[0], w[1], *p));
                sides.fold(f64::INFINITY, f64::min)
            };
            points.iter().map(to_line).fold(0.0, f64::max)
        };
        away(&own, line).max(away(line, &own))
    }

    fn farthest_from_chord(&self) -> Option<(usize, f64)> {
        let (from, to) = (self.ring[*self.places.first()?], self.ring[*self.places.last()?]);
        let inner = self.places.get(1..self.places.len() - 1)?;
        let away = |&i: &usize| (i, polygon::distance_to_segment(from, to, self.ring[i]));
        inner.iter().map(away).max_by(|a, b| a.1.total_cmp(&b.1))
    }
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

    /// How sharply the ring bends at one of its points, rad.
    fn turn(&self, i: usize) -> f64 {
        let n = self.ring.len();
        let at = self.ring[i];
        let ahead = self.walk(at, (1..n).map(|k| (i + k) % n));
        let behind = self.walk(at, (1..n).map(|k| (i + n - k) % n));
        let (a, b) = ([at[0] - behind[0], at[1] - behind[1]], [ahead[0] - at[0], ahead[1] - at[1]]);
        (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]).abs()
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
