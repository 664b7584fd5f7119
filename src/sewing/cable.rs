//! One cable: how many holes it has, how it turns, whether it stays inside the body.

use super::{Breach, Place, Rig, Rules};
use crate::outline::{Point, polygon};

/// Rounding that an angle may exceed its rule by, degrees.
const ROUNDING_DEGREES: f64 = 1e-6;

/// Angle between the pieces `ab` and `bc`, degrees, 0 to 180; 0 where a piece has no length.
pub fn turn(a: Point, b: Point, c: Point) -> f64 {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - b[0], c[1] - b[1]]);
    (u[0] * v[1] - u[1] * v[0]).atan2(u[0] * v[0] + u[1] * v[1]).abs().to_degrees()
}

/// Sum of all turns of a cable, degrees.
pub fn turning(points: &[Point]) -> f64 {
    points.windows(3).map(|p| turn(p[0], p[1], p[2])).sum()
}

/// Number of holes and turns of every cable.
pub(super) fn judge(rules: &Rules, rigs: &[Rig], found: &mut Vec<Breach>) {
    for (winch, rig) in rigs.iter().enumerate() {
        for (cable, points) in rig.cables.iter().enumerate() {
            let at = Place { winch, cable };
            let holes = points.len().saturating_sub(2);
            if holes > rules.most_holes {
                found.push(Breach::ManyHoles { at, holes, most: rules.most_holes });
            }
            for (k, p) in points.windows(3).enumerate() {
                let degrees = turn(p[0], p[1], p[2]);
                if degrees > rules.turn_degrees + ROUNDING_DEGREES {
                    found.push(Breach::SharpTurn { at, hole: k + 1, degrees, most: rules.turn_degrees });
                }
            }
            let degrees = turning(points);
            if degrees > rules.turning_degrees + ROUNDING_DEGREES {
                found.push(Breach::Turning { at, degrees, most: rules.turning_degrees });
            }
        }
    }
}

/// Length of the piece from `a` to `b` that lies outside of the body, mm; `rings` are its polygons (outer and holes) in the same pose.
///
/// Exact: the piece is cut where it crosses the rings, and the middle of each part is inside or outside.
pub fn outside<'a>(rings: impl Iterator<Item = &'a [Point]> + Clone, a: Point, b: Point) -> f64 {
    let mut cuts = vec![0.0, 1.0];
    for (p, q) in rings.clone().flat_map(polygon::sides) {
        cuts.extend(crossing(a, b, p, q));
    }
    cuts.sort_by(f64::total_cmp);
    let inside = |p: Point| rings.clone().filter(|ring| polygon::contains(ring, p)).count() % 2 == 1;
    let parts = cuts.windows(2).filter(|c| c[1] > c[0] && !inside(polygon::lerp(a, b, 0.5 * (c[0] + c[1]))));
    // From 0, as a sum of nothing is -0.
    parts.fold(0.0, |sum, c| sum + (c[1] - c[0])) * polygon::length(a, b)
}

/// The parameter on `ab` at which it crosses `pq`, where it does.
fn crossing(a: Point, b: Point, p: Point, q: Point) -> Option<f64> {
    let (d, e, w) = ([b[0] - a[0], b[1] - a[1]], [q[0] - p[0], q[1] - p[1]], [p[0] - a[0], p[1] - a[1]]);
    let across = d[0] * e[1] - d[1] * e[0];
    let t = (w[0] * e[1] - w[1] * e[0]) / across;
    let s = (w[0] * d[1] - w[1] * d[0]) / across;
    ((0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&s)).then_some(t)
}
