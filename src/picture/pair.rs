//! The picture of both plushies side by side, as the command `render` writes it.

use super::layers::{Layers, Subject};
use super::palette::{Palette, Theme};
use super::ramp::Bar;
use super::raster::{self, RasterError};
use super::silhouette::Silhouette;
use super::texture::Texture;
use super::weave::Weave;
use crate::design::{Design, Target};
use crate::engine::Shape;
use std::sync::Arc;

/// The idealized plushie on the left and the realizable one on the right as PNG, `size` in pixels, in a [look](super::LOOKS), and
/// what its colours stand for.
///
/// # Errors
/// A size that is empty or does not fit in memory.
pub fn png(
    design: &Design,
    [idealized, realizable]: &[Shape; 2],
    targets: &[Target],
    texture: Option<&Arc<Texture>>,
    look: &str,
    size: (u32, u32),
) -> Result<(Vec<u8>, Option<Bar>), RasterError> {
    let design = Arc::new(design.clone());
    let body = (&Arc::new(Silhouette::of(&design)), &Arc::new(Weave::of(&design)));
    let [idealized, realizable] = [idealized, realizable].map(|shape| Arc::new(shape.clone()));
    let [left, right] =
        [(&idealized, &realizable, true), (&realizable, &idealized, false)].map(|(shape, beside, fibers)| {
            let subject = Subject::with(&design, body, shape);
            Layers::of(&Subject { targets, texture, fibers, look, beside: Some(beside), ..subject })
        });
    let bar = left.bar().or(right.bar()).cloned();
    let background = Palette::of(Theme::default()).background;
    let png = raster::png_with_bar(&left.scene(), &right.scene(), size, background, bar.as_ref())?;
    Ok((png, bar))
}
