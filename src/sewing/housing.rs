//! Winches: room for their housings, and cables that run through those of others.

use super::{Body, Breach, Place, Rig, Rules};
use crate::outline::polygon::{distance_to_segment, length};
use std::f64::consts::SQRT_2;

/// Rounding that a distance may fall short by, mm.
const ROUNDING_MM: f64 = 1e-6;
/// Part of the width of the body's widest place that a housing may take: the rest is stuffing around it.
const PART_OF_BODY: f64 = 0.8;
/// How closely the widest place is looked for, mm of its width: no housing is chosen by less.
const WIDTH_MM: f64 = 0.2;
/// The same on large bodies, as a part of their longer side: what bounds the work.
const WIDTH_FRACTION: f64 = 1e-3;

/// The housing that a body has room for, mm: the one wished for, less where that takes more than four fifths of the body's widest place.
pub fn largest_housing(body: &Body, wished_mm: f64) -> f64 {
    wished_mm.min(PART_OF_BODY * widest(body, wished_mm / PART_OF_BODY))
}

/// Diameter of the largest circle inside the seam, mm, to within [`WIDTH_MM`]; once there is one of `enough_mm`, no larger one is looked for.
///
/// Squares are cut into quarters as long as they may hold the centre of a larger circle: no point of a square is deeper than its middle by
/// more than half its diagonal.
fn widest(body: &Body, enough_mm: f64) -> f64 {
    let (low, high) = body.bounding_box();
    let side = (high[0] - low[0]).max(high[1] - low[1]);
    let closely = 0.5 * WIDTH_MM.max(WIDTH_FRACTION * side);
    let mut half = 0.5 * side;
    let mut squares = vec![[low[0] + half, low[1] + half]];
    let mut deepest: f64 = 0.0;
    while !squares.is_empty() && 2.0 * deepest < enough_mm {
        let depths: Vec<f64> = squares.iter().map(|&middle| body.depth(middle)).collect();
        deepest = depths.iter().copied().fold(deepest, f64::max);
        let quarter = 0.5 * half;
        let may_hold = |depth: f64| depth + half * SQRT_2 > deepest + closely;
        let kept = squares.iter().zip(&depths).filter(|&(_, &depth)| may_hold(depth));
        squares = kept
            .flat_map(|(&[x, y], _)| {
                [[-quarter, -quarter], [quarter, -quarter], [-quarter, quarter], [quarter, quarter]]
                    .map(|[dx, dy]| [x + dx, y + dy])
            })
            .collect();
        half = quarter;
    }
    2.0 * deepest
}

/// Housings inside the seam and through the turning gap, apart from each other, and free of other winches' cables. Where the body is too thin
/// for the rules' housing that is told once, and winches are judged by the largest housing that it has room for.
pub(super) fn judge(rules: &Rules, body: &Body, rigs: &[Rig], gap_mm: f64, found: &mut Vec<Breach>) {
    let housing_mm = largest_housing(body, rules.housing_mm);
    if housing_mm < rules.housing_mm - ROUNDING_MM {
        found.push(Breach::ThinBody { room_mm: housing_mm, housing_mm: rules.housing_mm });
    }
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
