//! The seam, and where it is left open to turn and stuff the body and to put the winches in.

use super::access::Access;
use crate::design::Design;
use crate::fabrication::cables::holes;
use crate::fabrication::winch;
use crate::outline::Point;
use crate::outline::polygon::{bounding_box, distance_to_segment, length, lerp};

/// Places at which the start of a turning gap is tried, around the outline.
const GAP_CANDIDATES: usize = 1000;
/// What bulging by its own length costs a turning gap, against lying at the top of the body instead of at its bottom. A
/// gap that bulges by 5 % of its length may be a quarter of the body lower than a straight one.
const GAP_STRAIGHTNESS: f64 = 5.0;
/// Least distance of a gap's ends over its length, and what falling short of that costs: a hundredth is worse than anything else.
const GAP_CHORD: f64 = 0.98;
const GAP_BENT: f64 = 1000.0;
/// What a hole or pin in its way costs a turning gap, on the same scale.
const GAP_OBSTACLE: f64 = 0.5;
/// What a way to the winches that is nothing as wide as it should be costs a turning gap, on the same scale: a tenth less is as bad as lying at
/// the top.
const GAP_ACCESS: f64 = 10.0;
/// What lying on a limb as thin as paper costs a turning gap, on the same scale: a limb is awkward to stuff through, and its seam is bent most. One
/// half as thick as the trunk is as bad as lying at the top.
const GAP_ON_LIMB: f64 = 2.5;
/// How thick a body is that is no limb, as a part of its thickest place.
const NO_LIMB: f64 = 0.8;
/// How wide the way should be, over what a housing needs: hands and stuffing go there too.
const GAP_ROOM: f64 = 1.2;
/// How far inside the gap the way begins, over what a housing needs: a gap in a limb is as wide as the limb.
const GAP_REACH: f64 = 0.3;
/// How near a hole or pin is in the way, mm: the width of a finger's grip on the seam.
const GAP_CLEARANCE_MM: f64 = 4.0;

/// The seam around the outer polygon, open at the turning gap.
#[derive(Clone, Debug, PartialEq)]
pub struct Seam {
    /// From one end of the gap around the body to the other; closed (first point repeated) without a gap.
    pub stitches: Vec<Point>,
    /// The stretch left open, from end to end; empty without a gap.
    pub gap: Vec<Point>,
    pub gap_mm: f64,
}

impl Seam {
    /// The middle of the gap; none without one.
    pub fn middle(&self) -> Option<Point> {
        Some(lerp(*self.gap.first()?, *self.gap.last()?, 0.5))
    }
}

/// The seam of a design: its turning gap away from limbs, from the holes of its cables and from its pins, where a housing gets in to every winch.
pub fn seam_of(design: &Design) -> Seam {
    let pins = design.pins.iter().map(|p| design.mesh.position(&p.at, &design.mesh.nodes));
    let obstacles: Vec<Point> = holes(design).into_iter().chain(pins).collect();
    let ways = Ways::of(design);
    seam(&design.outline.outer, design.turning_gap_mm(), &obstacles, |stretch| ways.cost(stretch))
}

/// How wide the body is on the way to its winches.
pub struct Ways {
    access: Access,
    /// For each winch the widest way from every cell.
    to: Vec<Vec<f64>>,
    flat_mm: f64,
}

impl Ways {
    pub fn of(design: &Design) -> Self {
        let access = Access::new(&design.outline);
        let flat_mm = winch::housing(design).flat_mm();
        // Cables pulled by hand have no housings.
        let housed = if design.sewing.housing_mm > 0.0 { design.networks.as_slice() } else { &[] };
        let winches = housed.iter().filter_map(|n| Some(n.winch()?.place(&design.mesh.nodes)));
        let to = winches.map(|place| access.ways(place, 0.5 * flat_mm)).collect();
        Self { access, to, flat_mm }
    }

    /// Flat width of the body on the widest way from a stretch of the seam to each winch, mm.
    pub fn widths(&self, stretch: &[Point]) -> Vec<f64> {
        let middle = stretch[stretch.len() / 2];
        self.to.iter().map(|ways| self.access.to(ways, middle, GAP_REACH * self.flat_mm)).collect()
    }

    /// What a turning gap costs for what lies behind it.
    fn cost(&self, stretch: &[Point]) -> f64 {
        GAP_ACCESS * self.short_of(stretch) + GAP_ON_LIMB * self.on_limb(stretch)
    }

    /// How much of a limb the body is behind a stretch: 0 where it is thick, 1 for paper; the mean of the middle and both halves' middles.
    fn on_limb(&self, stretch: &[Point]) -> f64 {
        let limb = NO_LIMB * self.access.thickest();
        let thin = |part: f64| (1.0 - self.access.thickness(along(stretch, part)) / limb).max(0.0);
        [0.25, 0.5, 0.75].map(thin).iter().sum::<f64>() / 3.0
    }

    /// By which part the ways are short of what a housing needs, their mean: one winch that nothing gets to does not hide the others.
    fn short_of(&self, stretch: &[Point]) -> f64 {
        let wanted = (GAP_ROOM * self.flat_mm).max(f64::MIN_POSITIVE);
        let short = self.widths(stretch).into_iter().map(|width| 1.0 - width.min(wanted) / wanted);
        short.sum::<f64>() / self.to.len().max(1) as f64
    }
}

/// The point at a part of the length of a polyline.
fn along(line: &[Point], part: f64) -> Point {
    let mut left = part * line.windows(2).map(|s| length(s[0], s[1])).sum::<f64>();
    for s in line.windows(2) {
        let step = length(s[0], s[1]);
        if left <= step {
            return lerp(s[0], s[1], left / step.max(f64::MIN_POSITIVE));
        }
        left -= step;
    }
    line[line.len() - 1]
}

/// Leaves `gap_mm` of the polygon open on the stretch that is straightest and nearest to the bottom, away from `obstacles`, where what lies
/// `behind` it costs least.
fn seam(polygon: &[Point], gap_mm: f64, obstacles: &[Point], behind: impl Fn(&[Point]) -> f64) -> Seam {
    let ring = Ring::new(polygon);
    let mut closed = polygon.to_vec();
    closed.extend(polygon.first());
    if gap_mm <= 0.0 {
        return Seam { stitches: closed, gap: Vec::new(), gap_mm: 0.0 };
    }
    let step = ring.length() / GAP_CANDIDATES as f64;
    let cost = |start: f64| {
        let stretch = ring.stretch(start, gap_mm);
        gap_cost(&ring, &stretch, gap_mm, obstacles) + behind(&stretch)
    };
    let costs: Vec<f64> = (0..GAP_CANDIDATES).map(|i| cost(i as f64 * step)).collect();
    let start = middle_of_best(&costs) * step;
    let gap = ring.stretch(start, gap_mm);
    let mut stitches = ring.stretch(start + gap_mm, ring.length() - gap_mm);
    // The same two points, whatever rounding does on the way around.
    let last = stitches.len() - 1;
    (stitches[0], stitches[last]) = (gap[gap.len() - 1], gap[0]);
    Seam { stitches, gap, gap_mm }
}

/// Bulge over the chord and mean height over the body, both relative, and a fine for obstacles.
fn gap_cost(ring: &Ring, stretch: &[Point], gap_mm: f64, obstacles: &[Point]) -> f64 {
    let (a, b) = (stretch[0], stretch[stretch.len() - 1]);
    let bulge = stretch.iter().map(|p| distance_to_segment(a, b, *p)).fold(0.0, f64::max);
    let height = stretch.windows(2).map(|s| length(s[0], s[1]) * 0.5 * (s[0][1] + s[1][1])).sum::<f64>() / gap_mm;
    let blocked =
        obstacles.iter().any(|o| stretch.windows(2).any(|s| distance_to_segment(s[0], s[1], *o) < GAP_CLEARANCE_MM));
    let bent = (GAP_CHORD - length(a, b) / gap_mm).max(0.0);
    GAP_STRAIGHTNESS * bulge / gap_mm
        + GAP_BENT * bent
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
    use std::f64::consts::PI;

    fn square(side: f64) -> Vec<Point> {
        vec![[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]]
    }

    fn whole(line: &[Point]) -> f64 {
        line.windows(2).map(|s| length(s[0], s[1])).sum()
    }

    #[test]
    fn the_gap_lies_in_the_middle_of_the_bottom() {
        let seam = seam(&square(120.0), 50.0, &[], |_| 0.0);
        assert!((whole(&seam.gap) - 50.0).abs() < 1e-9 && (whole(&seam.stitches) - 430.0).abs() < 1e-9);
        let mid = 0.5 * (seam.gap[0][0] + seam.gap[1][0]);
        assert!(seam.gap.len() == 2 && (mid - 60.0).abs() < 0.5 && seam.gap[0][1].abs() < 1e-12, "{:?}", seam.gap);
        assert_eq!((seam.stitches.first(), seam.stitches.last()), (seam.gap.last(), seam.gap.first()));
        assert_eq!(seam.stitches.len(), 6);
    }

    #[test]
    fn the_gap_keeps_away_from_obstacles_and_fits_small_bodies() {
        let blocked = seam(&square(120.0), 50.0, &[[40.0, 0.0], [80.0, 0.0]], |_| 0.0);
        let clear = |p: Point| blocked.gap.windows(2).all(|s| distance_to_segment(s[0], s[1], p) >= GAP_CLEARANCE_MM);
        assert!(clear([40.0, 0.0]) && clear([80.0, 0.0]), "{:?}", blocked.gap);
        let closed = seam(&square(20.0), 0.0, &[], |_| 0.0);
        assert!(closed.gap.is_empty() && whole(&closed.stitches) == 80.0);
    }

    #[test]
    fn a_bottom_that_is_flat_enough_beats_a_straight_top() {
        // A half disc standing on its round side: its upper edge is straight, its bottom is flat enough.
        let arc: Vec<Point> =
            (0..=40).map(|i| PI * (1.0 + f64::from(i) / 40.0)).map(|t| [100.0 * t.cos(), 100.0 * t.sin()]).collect();
        let seam = seam(&arc, 50.0, &[], |_| 0.0);
        let height = seam.gap.iter().map(|p| p[1]).fold(f64::NEG_INFINITY, f64::max);
        assert!(height < -90.0, "{:?}", seam.gap);
    }

    #[test]
    fn the_gap_is_in_the_trunk_and_not_in_a_leg() {
        // A body of 120 x 60 mm on two legs of 20 x 40 mm: their feet are lowest and straight, the belly lies between them.
        let outer = [
            [0.0, 0.0],
            [20.0, 0.0],
            [20.0, 40.0],
            [100.0, 40.0],
            [100.0, 0.0],
            [120.0, 0.0],
            [120.0, 100.0],
            [0.0, 100.0],
        ];
        let outline = crate::outline::Outline { outer: outer.to_vec(), holes: vec![] };
        let ways = Ways { access: Access::new(&outline), to: vec![], flat_mm: 20.0 };
        let on = |behind: &dyn Fn(&[Point]) -> f64| seam(&outline.outer, 18.0, &[], behind).middle().expect("a gap");
        assert!(on(&|_| 0.0)[1] < 1.0, "the feet are lowest");
        let middle = on(&|stretch| ways.cost(stretch));
        assert!((middle[0] - 60.0).abs() < 2.0 && (middle[1] - 40.0).abs() < 1e-9, "{middle:?}");
    }
}
