//! Marks across the allowance that tell which places of front and back meet.

use super::gap::Seam;
use crate::outline::polygon::{length, lerp};
use crate::outline::{Outline, Point};

/// Distance of the marks along the seam, mm: about a hand.
const SPACING_MM: f64 = 90.0;
/// Fewest and most marks of a seam.
const COUNT: [f64; 2] = [4.0, 24.0];
/// Tries for a mark along its stretch of the seam.
const TRIES: usize = 24;
/// The part of a stretch that a mark may be moved in.
const PLAY: f64 = 0.6;
/// Length of a mark, in allowances and mm at most: it stays clear of the stitches.
const PART: f64 = 0.5;
const LONGEST_MM: f64 = 4.0;
/// A mark stands where the cut is an allowance away, within this part: not in a notch that has closed.
const ON_RIM: f64 = 0.01;

/// Marks along the outer seam, the turning gap left out, each from the rim inward. Every one stands on the straightest place of its stretch.
pub fn match_marks(outline: &Outline, rim: &[Point], seam: &Seam, allowance_mm: f64) -> Vec<[Point; 2]> {
    let mark_mm = (PART * allowance_mm).min(LONGEST_MM);
    if mark_mm < 1.0 {
        return Vec::new();
    }
    let (near, cut) = (outline.near(), Outline { outer: rim.to_vec(), holes: Vec::new() }.near());
    let line = &seam.stitches;
    let total: f64 = line.windows(2).map(|s| length(s[0], s[1])).sum();
    let count = (total / SPACING_MM).round().clamp(COUNT[0], COUNT[1]);
    let stretch = total / count;
    let mut marks = Vec::new();
    for i in 0..count as usize {
        let tries = (0..TRIES).map(|k| {
            let off = PLAY * (k as f64 / (TRIES - 1) as f64 - 0.5);
            (i as f64 + 0.5 + off) * stretch
        });
        let good = tries.filter_map(|s| {
            let (p, normal) = straight(line, s, 0.5 * mark_mm + 1.0)?;
            let out = |r: f64| [p[0] + r * normal[0], p[1] + r * normal[1]];
            let end = out(allowance_mm);
            let away = near.distance(end);
            let is_on_rim = cut.distance(end) <= 0.1 * mark_mm;
            (is_on_rim && (away - allowance_mm).abs() <= ON_RIM * allowance_mm).then(|| {
                let bend = bend(line, s, 0.25 * stretch);
                (bend, [end, out(allowance_mm - mark_mm)])
            })
        });
        if let Some((_, mark)) = good.min_by(|a, b| a.0.total_cmp(&b.0)) {
            marks.push(mark);
        }
    }
    marks
}

/// The place at an arc length of a counter-clockwise line and its outward normal, of the chord over `reach` to both sides; none at the ends.
fn straight(line: &[Point], s: f64, reach: f64) -> Option<(Point, Point)> {
    let (a, p, b) = (at(line, s - reach)?, at(line, s)?, at(line, s + reach)?);
    let chord = length(a, b);
    (chord > 0.0).then(|| (p, [(b[1] - a[1]) / chord, -(b[0] - a[0]) / chord]))
}

/// How far a stretch is from straight: its length over its chord.
fn bend(line: &[Point], s: f64, reach: f64) -> f64 {
    match (at(line, s - reach), at(line, s + reach)) {
        (Some(a), Some(b)) => 2.0 * reach / length(a, b).max(f64::MIN_POSITIVE),
        _ => f64::INFINITY,
    }
}

fn at(line: &[Point], s: f64) -> Option<Point> {
    let mut rest = s;
    if rest < 0.0 {
        return None;
    }
    for pair in line.windows(2) {
        let side = length(pair[0], pair[1]);
        if rest <= side && side > 0.0 {
            return Some(lerp(pair[0], pair[1], rest / side));
        }
        rest -= side;
    }
    None
}
