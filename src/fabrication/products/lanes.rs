//! Lines that share stretches, drawn side by side.

use crate::outline::Point;
use crate::outline::polygon::length;

/// Distance of lines side by side, mm.
const LANE_MM: f64 = 1.8;
/// Stretches nearer than this, over more than that, would hide each other, mm.
const HIDDEN_MM: f64 = 1.2;
const OVERLAP_MM: f64 = 4.0;
/// Length on which a line goes to its lane, at most and as a part of its piece, mm.
const RAMP_MM: f64 = 4.0;
const RAMP: f64 = 0.25;

/// The pieces of each way as lines from hole to hole, moved aside where they would lie over a piece of another way.
pub fn lanes(ways: &[Vec<Point>]) -> Vec<Vec<Vec<Point>>> {
    let mut taken: Vec<([Point; 2], i32)> = Vec::new();
    let mut drawn = Vec::new();
    for way in ways {
        let mut lines = Vec::new();
        for piece in way.windows(2) {
            let own = [piece[0], piece[1]];
            let used: Vec<i32> = taken.iter().filter(|(other, _)| hides(&own, other)).map(|t| t.1).collect();
            // In the middle, then left and right in turn.
            let lane = (0..)
                .map(|k: i32| if k % 2 == 0 { -k / 2 } else { (k + 1) / 2 })
                .find(|k| !used.contains(k))
                .unwrap_or(0);
            taken.push((own, lane));
            lines.push(aside(own, lane));
        }
        drawn.push(lines);
    }
    drawn
}

/// Whether two pieces run along each other.
fn hides(a: &[Point; 2], b: &[Point; 2]) -> bool {
    let whole = length(a[0], a[1]);
    if whole == 0.0 {
        return false;
    }
    let u = [(a[1][0] - a[0][0]) / whole, (a[1][1] - a[0][1]) / whole];
    let along = |p: Point| (p[0] - a[0][0]) * u[0] + (p[1] - a[0][1]) * u[1];
    let across = |p: Point| (p[0] - a[0][0]) * u[1] - (p[1] - a[0][1]) * u[0];
    let (s, t) = (along(b[0]), along(b[1]));
    let (from, to) = (s.min(t).max(0.0), s.max(t).min(whole));
    if to - from < OVERLAP_MM.min(0.5 * whole) {
        return false;
    }
    let at = |x: f64| across(b[0]) + (across(b[1]) - across(b[0])) * (x - s) / (t - s);
    // Crossing lines are near in one place alone.
    at(from).abs() < HIDDEN_MM && at(to).abs() < HIDDEN_MM
}

fn aside([a, b]: [Point; 2], lane: i32) -> Vec<Point> {
    let whole = length(a, b);
    if lane == 0 || whole == 0.0 {
        return vec![a, b];
    }
    // The same side for both directions.
    let sign = if (a[0], a[1]) <= (b[0], b[1]) { 1.0 } else { -1.0 };
    let u = [(b[0] - a[0]) / whole, (b[1] - a[1]) / whole];
    let off = sign * f64::from(lane) * LANE_MM;
    let ramp = RAMP_MM.min(RAMP * whole);
    let at = |s: f64| [a[0] + s * u[0] - off * u[1], a[1] + s * u[1] + off * u[0]];
    vec![a, at(ramp), at(whole - ramp), b]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_over_each_other_are_drawn_apart_and_crossing_ones_stay() {
        let ways = [
            vec![[0.0, 0.0], [100.0, 0.0]],
            vec![[80.0, 0.3], [20.0, -0.3]],
            vec![[50.0, -40.0], [50.0, 40.0]],
            vec![[10.0, 0.0], [90.0, 0.0]],
        ];
        let drawn = lanes(&ways);
        let heights: Vec<f64> = drawn.iter().map(|lines| lines[0][lines[0].len() / 2][1]).collect();
        assert!(drawn[0][0].len() == 2 && drawn[2][0].len() == 2);
        assert!(
            (heights[1] - heights[3]).abs() > LANE_MM && heights[1].abs() > 1.0 && heights[3].abs() > 1.0,
            "{heights:?}"
        );
        assert_eq!((drawn[1][0][0], drawn[1][0][3]), ([80.0, 0.3], [20.0, -0.3]));
    }
}
