//! Small pictures of one plushie: of designs to choose from, of candidates in their poses.

use super::layers::looks::Plush;
use super::layers::{Layer, Layers, Pins, Shown, Subject};
use super::palette::{Palette, Theme};
use super::pixels::Preview;
use super::raster::{self, RasterError};
use crate::design::{Design, Network, Target};
use crate::engine::Shape;
use std::sync::Arc;

/// A realizable plushie in a shape, with a network that is not the design's yet where there is one, and targets.
///
/// # Errors
/// A size that is empty or does not fit in memory.
pub fn portrait(
    design: &Arc<Design>,
    shape: &Arc<Shape>,
    proposed: Option<&Network>,
    targets: &[Target],
    theme: Theme,
    size: (u32, u32),
) -> Result<Preview, RasterError> {
    let shown = Shown::default().with(Pins::NAME, false);
    let look = Plush::NAME;
    let subject =
        Subject { look, fibers: false, theme, shown: &shown, targets, proposed, ..Subject::new(design, shape) };
    raster::one(&Layers::of(&subject).scene(), size, Palette::of(theme).background)
}
