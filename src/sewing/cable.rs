//! One cable: how many holes it has, and how it turns.

use super::{Breach, Place, Rig, Rules};
use crate::outline::Point;

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
