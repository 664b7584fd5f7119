//! Winches: room for their housings, and cables that run through those of others.

use super::{Body, Breach, Place, Rig, Rules};
use crate::outline::polygon::{distance_to_segment, length};

/// Rounding that a distance may fall short by, mm.
const ROUNDING_MM: f64 = 1e-6;
/// A housing of less is no winch any more, mm: the smallest gearmotors are 6 mm wide.
const SMALLEST_MM: f64 = 8.0;
/// Part of the widest place's width that a housing may take: the rest is stuffing around it.
const PART_OF_BODY: f64 = 0.8;

/// The housing that a body has room for, mm: the one wished for, less where the body is thin everywhere. Asks at most `points` of a grid.
pub fn largest_housing(body: &Body, wished_mm: f64) -> f64 {
    /// Points along the longer side of the box around the body.
    const GRID: usize = 64;
    let (low, high) = body.bounding_box();
    let step = (high[0] - low[0]).max(high[1] - low[1]) / GRID as f64;
    let mut widest: f64 = 0.0;
    for i in 0..=GRID {
        for j in 0..=GRID {
            let p = [low[0] + i as f64 * step, low[1] + j as f64 * step];
            if p[0] <= high[0] && p[1] <= high[1] {
                widest = widest.max(2.0 * body.depth(p));
            }
        }
    }
    wished_mm.min((PART_OF_BODY * widest).max(SMALLEST_MM.min(wished_mm)))
}

/// Housings inside the seam and through the turning gap, apart from each other, and free of other winches' cables.
pub(super) fn judge(rules: &Rules, body: &Body, rigs: &[Rig], gap_mm: f64, found: &mut Vec<Breach>) {
    let housing_mm = rules.housing_mm;
    for (winch, rig) in rigs.iter().enumerate() {
        let room_mm = 2.0 * body.depth(rig.winch);
        if room_mm < housing_mm - ROUNDING_MM {
            found.push(Breach::HousingOutside { winch, room_mm, housing_mm });
        }
        if gap_mm < housing_mm - ROUNDING_MM {
            found.push(Breach::HousingAtGap { winch, gap_mm, housing_mm });
        }
        for (other, rig_before) in rigs[..winch].iter().enumerate() {
            let (distance_mm, least_mm) = (length(rig.winch, rig_before.winch), housing_mm + rules.between_housings_mm);
            if distance_mm < least_mm - ROUNDING_MM {
                found.push(Breach::HousingsClose { winch: other, other: winch, distance_mm, least_mm });
            }
        }
    }
    for (winch, rig) in rigs.iter().enumerate() {
        for (cable, points) in rig.cables.iter().enumerate() {
            for (other, there) in rigs.iter().enumerate().filter(|(other, _)| *other != winch) {
                let least_mm = 0.5 * housing_mm;
                let nearest = points
                    .windows(2)
                    .map(|s| distance_to_segment(s[0], s[1], there.winch))
                    .enumerate()
                    .min_by(|a, b| a.1.total_cmp(&b.1));
                let Some((piece, distance_mm)) = nearest.filter(|&(_, d)| d < least_mm - ROUNDING_MM) else { continue };
                found.push(Breach::ThroughWinch {
                    at: Place { winch, cable },
                    piece,
                    winch: other,
                    distance_mm,
                    least_mm,
                });
            }
        }
    }
}
