//! Where the felt is cut around the seam.

use crate::outline::polygon::{bounding_box, length, signed_area};
use crate::outline::{Outline, Point};
use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::float::single::SingleFloatOverlay;
use i_overlay::mesh::float::outline::offset::OutlineOffset;
use i_overlay::mesh::float::style::{LineJoin, OutlineStyle};
use serde::{Deserialize, Serialize};

/// Length of a round join's chords over its radius, rad: at 8 mm of allowance they stay within 0.01 mm of the arc.
const ROUND_JOIN: f64 = 0.1;
/// Smallest angle of the seam at which a mitred corner keeps its point, rad: sharper ones are cut off before they reach four allowances.
const MITRE_ANGLE: f64 = 0.5;
/// Least width of what is cut out of the felt, mm: a blade or laser leaves crumbs of less, and no scissors get in. Larger: more slits are filled.
pub const LEAST_SLIT_MM: f64 = 2.0;
/// A slit no longer than this is the point of a corner, which scissors do reach, mm.
const CORNER_MM: f64 = 4.0;

/// How the felt is cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Cutting {
    pub corners: Corners,
    /// Width of what the cutter burns away, mm; lines move outward by half of it, holes inward.
    pub kerf_mm: f64,
}

/// The shape of the allowance at corners of the seam.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Corners {
    /// As wide as the allowance everywhere.
    #[default]
    Round,
    /// With points, as a ruler draws them.
    Mitred,
}

/// The outline grown by a seam allowance. Each shape is an outer polygon (counter-clockwise) followed by what is cut out of it; the body's own
/// holes shrink, and a notch narrower than twice the allowance closes. Slits and cut-outs narrower than `LEAST_SLIT_MM` are filled.
pub fn grown(outline: &Outline, allowance_mm: f64, corners: Corners) -> Vec<Vec<Vec<Point>>> {
    let contours: Vec<Vec<Point>> = outline.polygons().map(Vec::from).collect();
    if allowance_mm <= 0.0 {
        return vec![contours];
    }
    let join = match corners {
        Corners::Round => LineJoin::Round(ROUND_JOIN),
        Corners::Mitred => LineJoin::Miter(MITRE_ANGLE),
    };
    filled(contours.outline(&OutlineStyle::new(allowance_mm).line_join(join)))
}

/// Moves the rim outward and cut-outs inward by half a kerf.
pub fn with_kerf(shapes: Vec<Vec<Vec<Point>>>, kerf_mm: f64) -> Vec<Vec<Vec<Point>>> {
    if kerf_mm <= 0.0 {
        return shapes;
    }
    shapes.outline(&OutlineStyle::new(0.5 * kerf_mm).line_join(LineJoin::Miter(MITRE_ANGLE)))
}

/// Shapes without slits and cut-outs that are too narrow. All else keeps its points.
fn filled(shapes: Vec<Vec<Vec<Point>>>) -> Vec<Vec<Vec<Point>>> {
    let by = |d: f64| OutlineStyle::new(d).line_join(LineJoin::Round(ROUND_JOIN));
    let r = 0.5 * LEAST_SLIT_MM;
    let closed = shapes.outline(&by(r)).outline(&by(-r));
    let rest: Vec<Vec<Vec<Point>>> = closed.overlay_as::<i64>(&shapes, OverlayRule::Difference, FillRule::NonZero);
    let slits: Vec<Vec<Vec<Point>>> = rest.into_iter().filter(|piece| is_slit(piece)).collect();
    if slits.is_empty() {
        return shapes;
    }
    // Grown by a hair, so that no seam of zero width is left between a slit's filling and its sides.
    let fillings = slits.outline(&by(FILLING_OVERLAP_MM));
    shapes.overlay_as::<i64>(&fillings, OverlayRule::Union, FillRule::NonZero)
}

/// How far a filling reaches into the felt beside it, mm: above the rounding of the library's integers, below what is seen.
const FILLING_OVERLAP_MM: f64 = 1e-3;

/// Whether a piece between a shape and its closing is a slit, not the point of a corner nor a leftover along arcs.
fn is_slit(piece: &[Vec<Point>]) -> bool {
    let Some(ring) = piece.first() else { return false };
    let (low, high) = bounding_box(ring);
    // A strip of length l and width w has area l w and perimeter 2 l.
    let perimeter: f64 = crate::outline::polygon::perimeter(ring);
    let width = 2.0 * signed_area(ring).abs() / perimeter.max(f64::MIN_POSITIVE);
    length(low, high) > CORNER_MM && width > FILLING_OVERLAP_MM
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::polygon::signed_area as area;
    use std::f64::consts::PI;

    fn square(side: f64) -> Vec<Point> {
        vec![[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]]
    }

    /// Steiner's formula: a convex polygon of area A and perimeter P grows by r to A + P r + pi r^2.
    #[test]
    fn growth_follows_steiners_formula() {
        for allowance in [2.0, 8.0, 15.0] {
            let shapes = grown(&Outline { outer: square(100.0), holes: vec![] }, allowance, Corners::Round);
            assert_eq!((shapes.len(), shapes[0].len()), (1, 1));
            let expected = 100.0 * 100.0 + 400.0 * allowance + PI * allowance * allowance;
            let missing = expected - area(&shapes[0][0]);
            assert!((-0.05..0.005 * PI * allowance * allowance).contains(&missing), "{allowance} mm: {missing} mm^2");
            let mitred = grown(&Outline { outer: square(100.0), holes: vec![] }, allowance, Corners::Mitred);
            assert!((area(&mitred[0][0]) - (100.0 + 2.0 * allowance).powi(2)).abs() < 1e-3);
        }
    }

    #[test]
    fn holes_shrink_and_close() {
        let hole = vec![[30.0, 30.0], [30.0, 70.0], [70.0, 70.0], [70.0, 30.0]];
        let outline = Outline { outer: square(100.0), holes: vec![hole] };
        let shapes = grown(&outline, 8.0, Corners::Round);
        assert_eq!((shapes.len(), shapes[0].len()), (1, 2));
        assert!((area(&shapes[0][1]) + 24.0 * 24.0).abs() < 1e-3, "{}", area(&shapes[0][1]));
        assert_eq!(grown(&outline, 21.0, Corners::Round)[0].len(), 1);
        assert_eq!(grown(&outline, 0.0, Corners::Round), vec![vec![outline.outer.clone(), outline.holes[0].clone()]]);
    }

    #[test]
    fn slits_and_slivers_are_filled_and_wider_ones_stay() {
        // A slot of 16 mm and a little more between two legs of 40 mm: what is left between the allowances is the little.
        let slot = |gap: f64| {
            let (a, b) = (40.0, 40.0 + gap);
            vec![[0.0, 0.0], [a, 0.0], [a, 60.0], [b, 60.0], [b, 0.0], [b + 40.0, 0.0], [b + 40.0, 100.0], [0.0, 100.0]]
        };
        let whole = |gap: f64| area(&grown(&Outline { outer: slot(gap), holes: vec![] }, 8.0, Corners::Round)[0][0]);
        let open = 4.0 * 60.0;
        assert!((whole(20.0) - whole(16.0) + open - 4.0 * 116.0).abs() < 8.0, "{} {}", whole(20.0), whole(16.0));
        // One of 1 mm is filled but for its mouth.
        assert!((whole(17.0) - whole(16.0) - 116.0).abs() < 9.0, "{} {}", whole(17.0), whole(16.0));
        let rest = vec![[48.0, 30.0], [48.0, 40.0], [65.0, 40.0], [65.0, 30.0]];
        let body = Outline { outer: square(120.0), holes: vec![rest] };
        assert_eq!(grown(&body, 4.2, Corners::Round)[0].len(), 1, "a cut-out of 1.6 mm");
        assert_eq!(grown(&body, 3.0, Corners::Round)[0].len(), 2, "a cut-out of 4 mm");
    }
}
