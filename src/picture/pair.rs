//! The picture of both plushies side by side, as the command `render` writes it.

use super::layers::{Layers, Subject};
use super::palette::{Palette, Theme};
use super::raster::{self, RasterError};
use super::texture::Texture;
use crate::design::{Design, Target};
use crate::engine::Shape;
use std::sync::Arc;

/// The idealized plushie on the left and the realizable one on the right as PNG, `size` in pixels.
///
/// # Errors
/// A size that is empty or does not fit in memory.
pub fn png(
    design: &Design,
    [idealized, realizable]: &[Shape; 2],
    targets: &[Target],
    texture: Option<&Arc<Texture>>,
    size: (u32, u32),
) -> Result<Vec<u8>, RasterError> {
    let design = Arc::new(design.clone());
    let [left, right] = [(idealized, true), (realizable, false)].map(|(shape, fibers)| {
        let shape = Arc::new(shape.clone());
        Layers::of(&Subject { targets, texture, fibers, ..Subject::new(&design, &shape) }).scene()
    });
    raster::png(&left, &right, size, Palette::of(Theme::default()).background)
}
