//! Angles and circles of triangles.

use super::triangulate::doubled_area;
use crate::outline::Point;

/// Squared length of side `k`, from corner `k` to the next.
pub(super) fn side2(p: [Point; 3], k: usize) -> f64 {
    let (a, b) = (p[k], p[(k + 1) % 3]);
    (b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)
}

/// The angle at `p` from `q` to `r`, rad, with its sign.
pub(super) fn angle_at(p: Point, q: Point, r: Point) -> f64 {
    let dot = (q[0] - p[0]) * (r[0] - p[0]) + (q[1] - p[1]) * (r[1] - p[1]);
    doubled_area(p, q, r).atan2(dot)
}

/// Centre and radius of the circle through three points.
pub(super) fn circumcircle([a, b, c]: [Point; 3]) -> (Point, f64) {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let d = 2.0 * doubled_area(a, b, c);
    let (uu, vv) = (u[0] * u[0] + u[1] * u[1], v[0] * v[0] + v[1] * v[1]);
    let (x, y) = ((v[1] * uu - u[1] * vv) / d, (u[0] * vv - v[0] * uu) / d);
    ([a[0] + x, a[1] + y], x.hypot(y))
}
