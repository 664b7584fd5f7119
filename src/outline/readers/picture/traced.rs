//! The boundary of what counts in a picture.

use crate::outline::readers::Painting;
use crate::outline::regions::{self, Shapes};
use crate::outline::simplify::simplify;
use crate::outline::trace::Field;
use crate::outline::{Note, OutlineError, Point, polygon};
use i_overlay::core::fill_rule::FillRule;

/// Regions and holes smaller than this are noise of the picture, in working pixels.
const NOISE_PX2: f64 = 12.0;
/// The same as a part of the area traced.
const NOISE_FRACTION: f64 = 3e-4;
/// How far the traced line may be simplified, in working pixels.
const TOLERANCE_PX: f64 = 0.15;

/// Slopes are taken over so many working pixels each way: wider than the blur of a camera, narrower than the edge of a shadow.
const REACH_PX: isize = 3;
/// An edge this much less steep than half of all edges is soft, and a part of the boundary like this is worth a note.
const SOFT: f64 = 0.25;
const SOFT_PART: f64 = 0.05;

/// Regions that were traced, in working pixels, y up.
pub(super) struct Traced {
    pub shapes: Shapes,
    specks: usize,
    /// Smaller ones were left out, in working pixels.
    least: f64,
    /// Part of the boundary that is soft.
    soft: f64,
}

impl Traced {
    pub fn take(self, painting: &mut Painting) {
        if self.soft > SOFT_PART {
            painting.notes.push(Note::SoftEdge { part: self.soft });
        }
        if self.specks > 0 {
            painting.notes.push(Note::Specks { count: self.specks, pixels: self.least });
        }
        painting.shapes = self.shapes;
    }
}

/// The regions at or above the level, without noise.
pub(super) fn traced(field: Field, level: f64) -> Result<Traced, OutlineError> {
    let contours = field.contours(level);
    let areas: Vec<f64> = contours.iter().map(|ring| polygon::signed_area(ring).abs()).collect();
    let least = NOISE_PX2.max(NOISE_FRACTION * areas.iter().copied().fold(0.0, f64::max));
    let soft = soft_part(&field, contours.iter().zip(&areas).filter(|(_, area)| **area >= least).map(|(ring, _)| ring));
    let kept: Vec<Vec<Point>> = contours
        .iter()
        .zip(&areas)
        .filter(|(_, area)| **area >= least)
        .map(|(ring, _)| simplify(ring, TOLERANCE_PX))
        .filter(|ring| ring.len() >= 3)
        .collect();
    if kept.is_empty() {
        return Err(OutlineError::NothingPainted("the picture has no area that differs from its background"));
    }
    let specks = contours.len() - kept.len();
    Ok(Traced { shapes: regions::resolve(&kept, FillRule::EvenOdd)?, specks, least, soft })
}

/// The part of a boundary that is much less steep than the rest, as where a shadow ends.
fn soft_part<'a>(field: &Field, rings: impl Iterator<Item = &'a Vec<Point>>) -> f64 {
    let mut slopes: Vec<f64> = rings.flatten().map(|&p| field.slope(p, REACH_PX)).collect();
    if slopes.is_empty() {
        return 0.0;
    }
    slopes.sort_by(f64::total_cmp);
    let soft = SOFT * slopes[slopes.len() / 2];
    slopes.partition_point(|&slope| slope < soft) as f64 / slopes.len() as f64
}
