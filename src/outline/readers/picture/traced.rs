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

/// Regions that were traced, in working pixels, y up.
pub(super) struct Traced {
    pub shapes: Shapes,
    specks: usize,
    /// Smaller ones were left out, in working pixels.
    least: f64,
}

impl Traced {
    pub fn take(self, painting: &mut Painting) {
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
    Ok(Traced { shapes: regions::resolve(&kept, FillRule::EvenOdd)?, specks, least })
}
