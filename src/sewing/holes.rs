//! Holes: their distance to the seam and to each other.

use super::{Body, Breach, Place, Rig, Rules};
use crate::outline::Point;
use crate::outline::polygon::length;

/// Rounding that a distance may fall short by, mm: a hole set exactly at the least distance keeps the rule.
const ROUNDING_MM: f64 = 1e-6;

/// Every hole of a rig with its cable and number; the winch belongs to the first cable alone.
fn holes(rigs: &[Rig]) -> impl Iterator<Item = (Place, usize, Point)> + '_ {
    rigs.iter().enumerate().flat_map(|(winch, rig)| {
        let own = std::iter::once((Place { winch, cable: 0 }, 0, rig.winch));
        own.chain(rig.cables.iter().enumerate().flat_map(move |(cable, points)| {
            points.iter().enumerate().skip(1).map(move |(hole, &p)| (Place { winch, cable }, hole, p))
        }))
    })
}

/// Holes nearer to the seam than the rule allows.
pub(super) fn near_seam(rules: &Rules, body: &Body, rigs: &[Rig], found: &mut Vec<Breach>) {
    let least_mm = rules.hole_to_seam_mm;
    for (at, hole, p) in holes(rigs) {
        let distance_mm = body.depth(p);
        if distance_mm < least_mm - ROUNDING_MM {
            found.push(Breach::NearSeam { at, hole, distance_mm, least_mm });
        }
    }
}

/// Pairs of different holes nearer to each other than the rule allows; a hole that several cables use is one.
pub(super) fn crowded(rules: &Rules, rigs: &[Rig], found: &mut Vec<Breach>) {
    let least_mm = rules.hole_to_hole_mm;
    let mut seen: Vec<(Place, usize, Point)> = Vec::new();
    for (at, hole, p) in holes(rigs) {
        if seen.iter().any(|(_, _, q)| *q == p) {
            continue;
        }
        for &(other, other_hole, q) in &seen {
            let distance_mm = length(p, q);
            if distance_mm < least_mm - ROUNDING_MM {
                found.push(Breach::Crowded { at, hole, other, other_hole, distance_mm, least_mm });
            }
        }
        seen.push((at, hole, p));
    }
}
