//! Curves to polygons.

use crate::outline::Point;
use usvg::Transform;
use usvg::tiny_skia_path::{Path, PathSegment};

/// Most pieces a single curve is cut into: stops absurd input, not reached at the reader's tolerance in sane drawings.
const MAX_PIECES: f64 = 2000.0;

/// The closed contours of a path as polygons, transformed, y up.
///
/// A curve cut into n equal steps of its parameter lies within `max |B''| / (8 n^2)` of the polygon.
pub(super) fn flatten(path: &Path, transform: Transform, tolerance: f64) -> Vec<Vec<Point>> {
    let at = |p: usvg::tiny_skia_path::Point| -> Point {
        let [x, y] = [f64::from(p.x), f64::from(p.y)];
        let row = |a: f32, b: f32, c: f32| f64::from(a) * x + f64::from(b) * y + f64::from(c);
        [row(transform.sx, transform.kx, transform.tx), -row(transform.ky, transform.sy, transform.ty)]
    };
    let steps = |second: f64| (second / (8.0 * tolerance)).sqrt().ceil().clamp(1.0, MAX_PIECES) as usize;
    let bend = |a: Point, b: Point, c: Point| (a[0] - 2.0 * b[0] + c[0]).hypot(a[1] - 2.0 * b[1] + c[1]);
    let mut contours: Vec<Vec<Point>> = Vec::new();
    let mut contour: Vec<Point> = Vec::new();
    for segment in path.segments() {
        let from = contour.last().copied().unwrap_or_default();
        match segment {
            PathSegment::MoveTo(p) => {
                contours.push(std::mem::replace(&mut contour, vec![at(p)]));
            }
            PathSegment::LineTo(p) => contour.push(at(p)),
            PathSegment::QuadTo(p1, p2) => {
                let (b, c) = (at(p1), at(p2));
                let n = steps(2.0 * bend(from, b, c));
                contour.extend((1..=n).map(|i| bernstein([from, b, b, c], i as f64 / n as f64, true)));
            }
            PathSegment::CubicTo(p1, p2, p3) => {
                let (b, c, d) = (at(p1), at(p2), at(p3));
                let n = steps(6.0 * bend(from, b, c).max(bend(b, c, d)));
                contour.extend((1..=n).map(|i| bernstein([from, b, c, d], i as f64 / n as f64, false)));
            }
            PathSegment::Close => {
                // What follows without a new start begins where this contour began.
                let start = contour.first().copied().unwrap_or_default();
                contours.push(std::mem::replace(&mut contour, vec![start]));
            }
        }
    }
    contours.push(contour);
    contours.retain(|c| c.len() >= 3);
    contours
}

/// A Bezier curve at `t`: cubic, or quadratic with its middle control point given twice.
fn bernstein(p: [Point; 4], t: f64, quadratic: bool) -> Point {
    let s = 1.0 - t;
    let w = if quadratic {
        [s * s, 2.0 * s * t, 0.0, t * t]
    } else {
        [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
    };
    [0, 1].map(|axis| (0..4).map(|i| w[i] * p[i][axis]).sum())
}
