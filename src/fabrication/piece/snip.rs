//! Notches that the seam allowance closes: where the cut is far from the stitches, and the line to snip along after sewing.

use crate::outline::polygon::{distance_to_segment, length, lerp, nearest_parameter, sides};
use crate::outline::{Near, Outline, Point};
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

/// The cut is as far from the stitches as it should be up to this many allowances.
const TOO_FAR: f64 = 1.05;
/// Spacing of the places of the seam that are looked at, in allowances: an inner corner of 10 degrees is 0.04 allowances off.
const SPACING: f64 = 1.0 / 16.0;
/// Most places of a seam that are looked at: what bounds the work on large bodies.
const MOST_PLACES: f64 = 20_000.0;
/// Runs of places nearer than this along the seam are one notch, in allowances.
const JOINED: f64 = 1.0;
/// Cells that a snip's way is looked for on, in allowances: felt between seams nearer than a cell cannot be snipped.
const CELL: f64 = 1.0 / 32.0;
/// How far a snip ends before the stitches, mm: nearer, the seam tears open.
const SHORT_MM: f64 = 2.0;
/// Cells that are looked at for one snip: some hundred allowances of a notch.
const MOST_CELLS: usize = 200_000;
/// A snip's corners are dropped where that moves it by no more than this, mm.
const STRAIGHT_MM: f64 = 0.15;

/// A corner of a notch's bottom is farther from the cut than all within this, lies at least this far from the others, and is no more than this nearer
/// to the cut than the farthest one, in allowances.
const PEAK: f64 = 0.5;
const APART: f64 = 1.0;
const DEEP: f64 = 1.5;
/// Most notches that are snipped, the deepest ones: what bounds the work on ragged outlines.
const MOST_SNIPPED: usize = 60;
/// Most corners of a notch that are snipped to.
const MOST_CORNERS: usize = 4;

/// A place where the allowances of both sides meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Closed {
    /// The place of the seam farthest from the cut.
    pub bottom: Point,
    /// How far that is, mm.
    pub distance_mm: f64,
    /// Length of the seam that is farther from the cut than it should be, mm.
    pub seam_mm: f64,
    /// The places of its bottom that are snipped to, the farthest from the cut first.
    pub corners: Vec<Point>,
    /// From the cut to a little before the stitches, mm, to every corner of the bottom; none where the seams are too near to each other to snip
    /// between them.
    pub snips: Vec<Vec<Point>>,
}

/// Every stretch of the seams that is farther from the cut than 1.05 allowances, along the outer seam and then along those of holes.
pub fn closed_notches(outline: &Outline, rim: &[Point], cut_outs: &[Vec<Point>], allowance_mm: f64) -> Vec<Closed> {
    if allowance_mm <= 0.0 {
        return Vec::new();
    }
    let cut = Outline { outer: rim.to_vec(), holes: cut_outs.to_vec() };
    let felt = Felt { outline, seam: outline.near(), near: cut.near(), cut: &cut, allowance_mm };
    let mut closed: Vec<Closed> = outline.polygons().flat_map(|ring| felt.along(ring)).collect();
    let mut deepest: Vec<usize> = (0..closed.len()).collect();
    deepest.sort_by(|&a, &b| closed[b].distance_mm.total_cmp(&closed[a].distance_mm));
    for i in deepest.into_iter().take(MOST_SNIPPED) {
        closed[i].snips = felt.snips(&closed[i].corners);
    }
    closed
}

/// A body between its seam and its cut.
struct Felt<'a> {
    outline: &'a Outline,
    seam: Near,
    cut: &'a Outline,
    near: Near,
    allowance_mm: f64,
}

impl Felt<'_> {
    fn along(&self, ring: &[Point]) -> Vec<Closed> {
        let whole = crate::outline::polygon::perimeter(ring);
        let spacing = (SPACING * self.allowance_mm).max(whole / MOST_PLACES);
        let mut places: Vec<(f64, Point)> = Vec::new();
        let mut start = 0.0;
        for (a, b) in sides(ring) {
            let side = length(a, b);
            let count = (side / spacing).ceil().max(1.0);
            places.extend((0..count as usize).map(|i| (start + side * i as f64 / count, lerp(a, b, i as f64 / count))));
            start += side;
        }
        let far: Vec<(f64, Point, f64)> = places
            .into_iter()
            .map(|(s, p)| (s, p, self.near.distance(p)))
            .filter(|place| place.2 > TOO_FAR * self.allowance_mm)
            .collect();
        let mut runs: Vec<Vec<(f64, Point, f64)>> = Vec::new();
        for place in far {
            match runs.last_mut().filter(|run| run.last().is_some_and(|p| place.0 - p.0 <= JOINED * self.allowance_mm))
            {
                Some(run) => run.push(place),
                None => runs.push(vec![place]),
            }
        }
        self.joined(runs, whole).iter().filter_map(|run| self.closed(run, spacing)).collect()
    }

    /// The last run goes on in the first one where they meet at the ring's beginning.
    fn joined(&self, mut runs: Vec<Vec<(f64, Point, f64)>>, whole: f64) -> Vec<Vec<(f64, Point, f64)>> {
        let meet = match (runs.first(), runs.last()) {
            (Some(first), Some(last)) if runs.len() > 1 => {
                whole - last[last.len() - 1].0 + first[0].0 <= JOINED * self.allowance_mm
            }
            _ => false,
        };
        if meet && let Some(mut last) = runs.pop() {
            last.append(&mut runs[0]);
            runs[0] = last;
        }
        runs
    }

    fn closed(&self, run: &[(f64, Point, f64)], spacing: f64) -> Option<Closed> {
        let worst = run.iter().max_by(|a, b| a.2.total_cmp(&b.2))?;
        let seam_mm = run.len() as f64 * spacing;
        let corners = self.corners(run);
        Some(Closed { bottom: worst.1, distance_mm: worst.2, seam_mm, corners, snips: Vec::new() })
    }

    fn snips(&self, corners: &[Point]) -> Vec<Vec<Point>> {
        let mut snips: Vec<Vec<Point>> = Vec::new();
        for &corner in corners {
            let snip = self.snip(corner, &snips);
            snips.extend((!snip.is_empty()).then_some(snip));
        }
        snips
    }

    /// The places of a run farthest from the cut, the farthest first: each is farther than all that are near to it, and felt is drawn together
    /// there.
    fn corners(&self, run: &[(f64, Point, f64)]) -> Vec<Point> {
        let mut sorted: Vec<&(f64, Point, f64)> = run.iter().collect();
        sorted.sort_by(|a, b| b.2.total_cmp(&a.2));
        let worst = sorted.first().map_or(0.0, |p| p.2);
        let mut corners: Vec<Point> = Vec::new();
        for (k, place) in sorted.into_iter().enumerate() {
            let peak =
                run.iter().all(|other| length(other.1, place.1) > PEAK * self.allowance_mm || other.2 <= place.2);
            let apart = corners.iter().all(|c| length(*c, place.1) > APART * self.allowance_mm);
            if k == 0 || peak && apart && place.2 > worst - DEEP * self.allowance_mm {
                corners.push(place.1);
            }
            if corners.len() == MOST_CORNERS {
                break;
            }
        }
        corners
    }

    /// The way from the cut to the bottom of a notch that keeps farthest from the stitches: the shortest one where a step costs the more the
    /// nearer they are. It ends in a snip before it where it meets one.
    fn snip(&self, bottom: Point, before: &[Vec<Point>]) -> Vec<Point> {
        let h = CELL * self.allowance_mm;
        let cell = |p: Point| [(p[0] / h).round() as i64, (p[1] / h).round() as i64];
        let place = |c: [i64; 2]| [c[0] as f64 * h, c[1] as f64 * h];
        let Some(start) = self.above(bottom) else { return Vec::new() };
        let start = cell(start);
        let mut cost: HashMap<[i64; 2], (f64, [i64; 2])> = HashMap::from([(start, (0.0, start))]);
        let mut open = BinaryHeap::from([Reverse((0u64, start))]);
        while let Some(Reverse((bits, at))) = open.pop() {
            let so_far = f64::from_bits(bits);
            if cost.len() > MOST_CELLS {
                break;
            }
            if cost.get(&at).is_some_and(|c| c.0 < so_far) {
                continue;
            }
            let p = place(at);
            if self.near.distance(p) <= h {
                return traced(&cost, at, place, nearest(self.cut, p));
            }
            let met = before.iter().flat_map(|snip| snip.windows(2)).find(|s| distance_to_segment(s[0], s[1], p) <= h);
            if let Some(s) = met {
                return traced(&cost, at, place, lerp(s[0], s[1], nearest_parameter(s[0], s[1], p)));
            }
            for (dx, dy) in [(1, 0), (-1, 0), (0, 1), (0, -1), (1, 1), (1, -1), (-1, 1), (-1, -1)] {
                let next = [at[0] + dx, at[1] + dy];
                let q = place(next);
                let away = self.seam.distance(q);
                // Two neighbours on either side of the stitches cannot both be this far from them.
                if away < 0.75 * h {
                    continue;
                }
                let step = h * ((dx * dx + dy * dy) as f64).sqrt() * (self.allowance_mm / away).powi(2);
                let total = so_far + step;
                if cost.get(&next).is_none_or(|c| total < c.0) {
                    cost.insert(next, (total, at));
                    open.push(Reverse((total.to_bits(), next)));
                }
            }
        }
        Vec::new()
    }

    /// A place in the felt a little above the bottom of a notch, as far from the stitches as there is.
    fn above(&self, bottom: Point) -> Option<Point> {
        let free = |p: Point| !self.outline.contains(p);
        let around = (0..64).map(|i| f64::from(i) * std::f64::consts::TAU / 64.0);
        let seen = around.filter_map(|angle| {
            let at = |r: f64| [bottom[0] + r * angle.cos(), bottom[1] + r * angle.sin()];
            (1..=4).all(|k| free(at(0.25 * f64::from(k) * SHORT_MM))).then(|| at(SHORT_MM))
        });
        seen.max_by(|a, b| self.seam.distance(*a).total_cmp(&self.seam.distance(*b)))
    }
}

/// The way back from a cell, from `first` on.
fn traced(
    cost: &HashMap<[i64; 2], (f64, [i64; 2])>,
    end: [i64; 2],
    place: impl Fn([i64; 2]) -> Point,
    first: Point,
) -> Vec<Point> {
    let mut way = vec![first, place(end)];
    let mut at = end;
    while let Some((_, before)) = cost.get(&at).filter(|c| c.1 != at) {
        at = *before;
        way.push(place(at));
    }
    straightened(&way)
}

/// The point of a boundary nearest to `p`.
fn nearest(outline: &Outline, p: Point) -> Point {
    let feet = outline.polygons().flat_map(sides).map(|(a, b)| lerp(a, b, nearest_parameter(a, b, p)));
    feet.min_by(|a, b| length(*a, p).total_cmp(&length(*b, p))).unwrap_or(p)
}

/// Fewer corners, both ends kept (Douglas and Peucker).
fn straightened(way: &[Point]) -> Vec<Point> {
    let (Some(&a), Some(&b)) = (way.first(), way.last()) else { return Vec::new() };
    let off = |i: &usize| distance_to_segment(a, b, way[*i]);
    match (1..way.len() - 1).max_by(|i, j| off(i).total_cmp(&off(j))) {
        Some(i) if off(&i) > STRAIGHT_MM => {
            let mut left = straightened(&way[..=i]);
            left.pop();
            left.extend(straightened(&way[i..]));
            left
        }
        _ => vec![a, b],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fabrication::piece::{Corners, grown};

    fn judged(outer: Vec<Point>, allowance: f64) -> Vec<Closed> {
        let outline = Outline { outer, holes: vec![] };
        let shapes = grown(&outline, allowance, Corners::Round);
        closed_notches(&outline, &shapes[0][0], &shapes[0][1..], allowance)
    }

    #[test]
    fn a_convex_body_has_no_notch() {
        assert_eq!(judged(vec![[0.0, 0.0], [90.0, 0.0], [90.0, 60.0], [0.0, 60.0]], 8.0), []);
    }

    #[test]
    fn legs_that_are_webbed_together_are_snipped_down_the_middle() {
        // A notch 10 mm wide and 60 mm deep, far from the other sides.
        let legs = vec![
            [0.0, 0.0],
            [90.0, 0.0],
            [90.0, 60.0],
            [100.0, 60.0],
            [100.0, 0.0],
            [190.0, 0.0],
            [190.0, 200.0],
            [0.0, 200.0],
        ];
        let found = judged(legs, 8.0);
        let [notch] = &found[..] else { panic!("{found:?}") };
        // The cut over the mouth: the meeting of two circles of 8 mm around the corners, 5 mm from the middle each.
        let mouth = -(64.0_f64 - 25.0).sqrt();
        assert!((notch.distance_mm - (60.0 - mouth)).abs() < 0.7, "{notch:?}");
        assert!((notch.bottom[1] - 60.0).abs() < 1e-9 && notch.seam_mm > 100.0);
        let snip = &notch.snips[0];
        let (first, last) = (snip[0], snip[snip.len() - 1]);
        assert!((first[1] - mouth).abs() < 0.3 && (last[1] - 58.5).abs() < 1.0, "{snip:?}");
        assert!(snip[..snip.len() - 1].iter().all(|p| (p[0] - 95.0).abs() < 1.5), "{snip:?}");
        // Both corners of the bottom.
        assert_eq!(notch.snips.len(), 2);
    }

    #[test]
    fn an_inner_corner_is_snipped_to_its_point() {
        let l = vec![[0.0, 0.0], [90.0, 0.0], [90.0, 40.0], [40.0, 40.0], [40.0, 90.0], [0.0, 90.0]];
        let found = judged(l, 8.0);
        let [corner] = &found[..] else { panic!("{found:?}") };
        assert!((corner.distance_mm - 8.0 * 2f64.sqrt()).abs() < 0.05 && corner.bottom == [40.0, 40.0]);
        let [snip] = &corner.snips[..] else { panic!("{corner:?}") };
        assert!((length(snip[snip.len() - 1], [40.0, 40.0]) - SHORT_MM).abs() < 0.3, "{snip:?}");
    }
}
