//! The seam: where the felt is cut around it, and where it is left open to turn and stuff the body.

use crate::design::Design;
use crate::fabrication::cables::holes;
use crate::outline::polygon::{bounding_box, distance_to_segment, length, lerp};
use crate::outline::{Outline, Point};
use i_overlay::mesh::float::outline::offset::OutlineOffset;
use i_overlay::mesh::float::style::{LineJoin, OutlineStyle};

/// Length of a round join's chords over its radius, rad: at 8 mm of allowance they stay within 0.01 mm of the arc.
const ROUND_JOIN: f64 = 0.1;
/// Places at which the start of a turning gap is tried, around the outline.
const GAP_CANDIDATES: usize = 1000;
/// What bulging by its own length costs a turning gap, against lying at the top of the body instead of at its bottom. A
/// gap that bulges by 5 % of its length may be a quarter of the body lower than a straight one.
const GAP_STRAIGHTNESS: f64 = 5.0;
/// What a hole or pin in its way costs a turning gap, on the same scale.
const GAP_OBSTACLE: f64 = 0.5;
/// How near a hole or pin is in the way, mm: the width of a finger's grip on the seam.
const GAP_CLEARANCE_MM: f64 = 4.0;

/// The outline grown by a seam allowance, round at the corners. Each shape is an outer polygon (counter-clockwise)
/// followed by what is cut out of it; the body's own holes shrink, and a notch narrower than twice the allowance closes.
pub fn grown(outline: &Outline, allowance_mm: f64) -> Vec<Vec<Vec<Point>>> {
    let contours: Vec<Vec<Point>> = outline.polygons().map(Vec::from).collect();
    if allowance_mm <= 0.0 {
        return vec![contours];
    }
    contours.outline(&OutlineStyle::new(allowance_mm).line_join(LineJoin::Round(ROUND_JOIN)))
}

/// The seam around the outer polygon, open at the turning gap.
#[derive(Clone, Debug, PartialEq)]
pub struct Seam {
    /// From one end of the gap around the body to the other; closed (first point repeated) without a gap.
    pub stitches: Vec<Point>,
    /// The stretch left open, from end to end; empty without a gap.
    pub gap: Vec<Point>,
    pub gap_mm: f64,
}

/// The seam of a design, its turning gap away from the holes of its cables and from its pins.
pub fn of(design: &Design) -> Seam {
    let pins = design.pins.iter().map(|p| design.mesh.position(&p.at, &design.mesh.nodes));
    let obstacles: Vec<Point> = holes(design).into_iter().chain(pins).collect();
    seam(&design.outline.outer, design.turning_gap_mm(), &obstacles)
}

/// Leaves `gap_mm` of the polygon open on the stretch that is straightest and nearest to the bottom, away from
/// `obstacles`.
fn seam(polygon: &[Point], gap_mm: f64, obstacles: &[Point]) -> Seam {
    let ring = Ring::new(polygon);
    let mut closed = polygon.to_vec();
    closed.extend(polygon.first());
    if gap_mm <= 0.0 {
        return Seam { stitches: closed, gap: Vec::new(), gap_mm: 0.0 };
    }
    let step = ring.length() / GAP_CANDIDATES as f64;
    let costs: Vec<f64> = (0..GAP_CANDIDATES).map(|i| gap_cost(&ring, i as f64 * step, gap_mm, obstacles)).collect();
    let start = middle_of_best(&costs) * step;
    let gap = ring.stretch(start, gap_mm);
    let mut stitches = ring.stretch(start + gap_mm, ring.length() - gap_mm);
    // The same two points, whatever rounding does on the way around.
    let last = stitches.len() - 1;
    (stitches[0], stitches[last]) = (gap[gap.len() - 1], gap[0]);
    Seam { stitches, gap, gap_mm }
}

/// Bulge over the chord and mean height over the body, both relative, and a fine for obstacles.
fn gap_cost(ring: &Ring, start: f64, gap_mm: f64, obstacles: &[Point]) -> f64 {
    let stretch = ring.stretch(start, gap_mm);
    let (a, b) = (stretch[0], stretch[stretch.len() - 1]);
    let bulge = stretch.iter().map(|p| distance_to_segment(a, b, *p)).fold(0.0, f64::max);
    let height = stretch.windows(2).map(|s| length(s[0], s[1]) * 0.5 * (s[0][1] + s[1][1])).sum::<f64>() / gap_mm;
    let blocked =
        obstacles.iter().any(|o| stretch.windows(2).any(|s| distance_to_segment(s[0], s[1], *o) < GAP_CLEARANCE_MM));
    GAP_STRAIGHTNESS * bulge / gap_mm
        + (height - ring.bottom) / (ring.top - ring.bottom)
        + if blocked { GAP_OBSTACLE } else { 0.0 }
}

/// The middle of the run of equally good places around the best one, so that a gap is centred on its straight stretch.
fn middle_of_best(costs: &[f64]) -> f64 {
    /// Below what tells two places apart.
    const SAME: f64 = 1e-6;
    let n = costs.len();
    let best = (0..n).min_by(|&a, &b| costs[a].total_cmp(&costs[b])).unwrap_or(0);
    let good = |i: usize| costs[i % n] <= costs[best] + SAME;
    let after = (1..n).take_while(|k| good(best + k)).count();
    let before = (1..n - after).take_while(|k| good(best + n - k)).count();
    best as f64 + 0.5 * (after as f64 - before as f64)
}

/// A closed polygon by arc length.
struct Ring<'a> {
    points: &'a [Point],
    /// Arc length at each point, and around.
    at: Vec<f64>,
    bottom: f64,
    top: f64,
}

impl<'a> Ring<'a> {
    fn new(points: &'a [Point]) -> Self {
        let mut at = vec![0.0];
        for i in 0..points.len() {
            at.push(at[i] + length(points[i], points[(i + 1) % points.len()]));
        }
        let (low, high) = bounding_box(points);
        Self { points, at, bottom: low[1], top: high[1] }
    }

    fn length(&self) -> f64 {
        self.at[self.points.len()]
    }

    /// The points from arc length `start` over `length`: both ends and the corners between.
    fn stretch(&self, start: f64, length: f64) -> Vec<Point> {
        let n = self.points.len();
        let start = start.rem_euclid(self.length());
        let end = start + length;
        let mut points = vec![self.point(start)];
        let first = self.at.partition_point(|&s| s <= start);
        for i in first..first + n {
            let s = self.at[i % n] + if i >= n { self.length() } else { 0.0 };
            if s >= end {
                break;
            }
            points.push(self.points[i % n]);
        }
        points.push(self.point(end.rem_euclid(self.length())));
        points
    }

    fn point(&self, s: f64) -> Point {
        let n = self.points.len();
        let i = self.at.partition_point(|&at| at <= s).clamp(1, n) - 1;
        let (a, b) = (self.points[i], self.points[(i + 1) % n]);
        let span = self.at[i + 1] - self.at[i];
        let t = if span > 0.0 { (s - self.at[i]) / span } else { 0.0 };
        lerp(a, b, t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::polygon::signed_area as area;
    use std::f64::consts::PI;

    fn square(side: f64) -> Vec<Point> {
        vec![[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]]
    }

    fn along(line: &[Point]) -> f64 {
        line.windows(2).map(|s| length(s[0], s[1])).sum()
    }

    /// Steiner's formula: a convex polygon of area A and perimeter P grows by r to A + P r + pi r^2.
    #[test]
    fn growth_follows_steiners_formula() {
        for allowance in [2.0, 8.0, 15.0] {
            let shapes = grown(&Outline { outer: square(100.0), holes: vec![] }, allowance);
            assert_eq!((shapes.len(), shapes[0].len()), (1, 1));
            let expected = 100.0 * 100.0 + 400.0 * allowance + PI * allowance * allowance;
            let missing = expected - area(&shapes[0][0]);
            assert!((-0.05..0.005 * PI * allowance * allowance).contains(&missing), "{allowance} mm: {missing} mm^2");
        }
    }

    #[test]
    fn holes_shrink_and_close() {
        let hole = vec![[30.0, 30.0], [30.0, 70.0], [70.0, 70.0], [70.0, 30.0]];
        let outline = Outline { outer: square(100.0), holes: vec![hole] };
        let shapes = grown(&outline, 8.0);
        assert_eq!((shapes.len(), shapes[0].len()), (1, 2));
        assert!((area(&shapes[0][1]) + 24.0 * 24.0).abs() < 1e-3, "{}", area(&shapes[0][1]));
        assert_eq!(grown(&outline, 21.0)[0].len(), 1);
        assert_eq!(grown(&outline, 0.0), vec![vec![outline.outer.clone(), outline.holes[0].clone()]]);
    }

    #[test]
    fn the_gap_lies_in_the_middle_of_the_bottom() {
        let seam = seam(&square(120.0), 50.0, &[]);
        assert!((along(&seam.gap) - 50.0).abs() < 1e-9 && (along(&seam.stitches) - 430.0).abs() < 1e-9);
        let mid = 0.5 * (seam.gap[0][0] + seam.gap[1][0]);
        assert!(seam.gap.len() == 2 && (mid - 60.0).abs() < 0.5 && seam.gap[0][1].abs() < 1e-12, "{:?}", seam.gap);
        assert_eq!((seam.stitches.first(), seam.stitches.last()), (seam.gap.last(), seam.gap.first()));
        assert_eq!(seam.stitches.len(), 6);
    }

    #[test]
    fn the_gap_keeps_away_from_obstacles_and_fits_small_bodies() {
        let blocked = seam(&square(120.0), 50.0, &[[40.0, 0.0], [80.0, 0.0]]);
        let clear = |p: Point| blocked.gap.windows(2).all(|s| distance_to_segment(s[0], s[1], p) >= GAP_CLEARANCE_MM);
        assert!(clear([40.0, 0.0]) && clear([80.0, 0.0]), "{:?}", blocked.gap);
        let closed = seam(&square(20.0), 0.0, &[]);
        assert!(closed.gap.is_empty() && along(&closed.stitches) == 80.0);
    }

    #[test]
    fn a_bottom_that_is_flat_enough_beats_a_straight_top() {
        // A half disc standing on its round side: its upper edge is straight, its bottom is flat enough.
        let arc: Vec<Point> =
            (0..=40).map(|i| PI * (1.0 + f64::from(i) / 40.0)).map(|t| [100.0 * t.cos(), 100.0 * t.sin()]).collect();
        let seam = seam(&arc, 50.0, &[]);
        let height = seam.gap.iter().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max);
        assert!(height < -90.0, "{:?}", seam.gap);
    }
}
