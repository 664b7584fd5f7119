//! The working pixels of a picture, and how much ink there is at each.

use super::background;
use crate::outline::OutlineError;
use crate::outline::trace::Field;
use image::DynamicImage;

/// Longer side, in pixels, to which larger pictures are averaged down: 0.2 mm on 300 mm.
const WORKING_SIDE: usize = 1600;
/// Part of the pixels that must be less than half opaque for the opacity to be the silhouette.
const TRANSPARENT_FRACTION: f64 = 1e-3;
/// Differences from the background below this are noise; without larger ones nothing is painted.
const LEAST_CONTRAST: f64 = 0.08;
/// Levels of Otsu's histogram.
const LEVELS: usize = 256;

/// How many pixels of a picture, along each axis, one working pixel stands for.
pub(super) fn working_factor(width: usize, height: usize) -> usize {
    width.max(height).div_ceil(WORKING_SIDE).max(1)
}

/// A picture averaged down.
pub(super) struct Pixels {
    pub width: usize,
    pub height: usize,
    /// How many pixels of the picture one measures.
    pub factor: usize,
    /// Red, green, blue and opacity, 0 to 1.
    pub values: Vec<[f32; 4]>,
    /// Whether some of the picture is transparent.
    pub clear: bool,
}

/// How much ink there is at each pixel, and from where on it counts.
pub(super) struct Ink {
    pub field: Field,
    pub level: f64,
    /// The colour of the background, where there is one.
    pub colour: Option<[f64; 3]>,
}

impl Pixels {
    pub fn of(picture: DynamicImage) -> Self {
        let rgba = picture.into_rgba8();
        let (wide, high) = (rgba.width() as usize, rgba.height() as usize);
        let factor = working_factor(wide, high);
        let (width, height) = (wide.div_ceil(factor), high.div_ceil(factor));
        let clear = rgba.pixels().filter(|p| p[3] < 128).count() as f64 > TRANSPARENT_FRACTION * (wide * high) as f64;
        // Averages of factor x factor pixels.
        let mut values = vec![[0_f32; 4]; width * height];
        for (y, row) in rgba.as_raw().chunks_exact(4 * wide).enumerate() {
            let line = &mut values[y / factor * width..][..width];
            for (x, pixel) in row.chunks_exact(4).enumerate() {
                for (sum, value) in line[x / factor].iter_mut().zip(pixel) {
                    *sum += f32::from(*value);
                }
            }
        }
        for (k, cell) in values.iter_mut().enumerate() {
            let count = |at: usize, size: usize| (size - at * factor).min(factor);
            let pixels = count(k % width, wide) * count(k / width, high);
            for value in cell {
                *value /= 255.0 * pixels as f32;
            }
        }
        Self { width, height, factor, values, clear }
    }

    /// What is opaque.
    pub fn opacity(&self, asked: Option<f64>) -> Ink {
        let values = self.values.iter().map(|cell| cell[3]).collect();
        let field = Field { width: self.width, height: self.height, values };
        Ink { field, level: asked.unwrap_or(0.5), colour: None }
    }

    /// What differs from the background, of the whole picture or a part of it.
    ///
    /// # Errors
    /// Nothing differs.
    pub fn ink(&self, within: Option<&[bool]>, asked: Option<f64>) -> Result<Ink, OutlineError> {
        let (width, height) = (self.width, self.height);
        let background::Found { difference: values, colour } = background::find(&self.values, width, height, within);
        let most = f64::from(values.iter().copied().fold(0.0, f32::max));
        if most < LEAST_CONTRAST {
            return Err(OutlineError::NothingPainted("the picture has one colour all over"));
        }
        let level = asked.unwrap_or_else(|| {
            let counted = |k: &usize| within.is_none_or(|within| within[*k]);
            otsu((0..values.len()).filter(counted).map(|k| values[k]), most).max(0.5 * LEAST_CONTRAST)
        });
        Ok(Ink { field: Field { width, height, values }, level, colour: Some(colour) })
    }
}

/// Parts values between 0 and `most` into the two classes with the largest variance between them (Otsu 1979), and takes
/// the level halfway between their means: where the classes are far apart any level between them parts them as well,
/// but a blurred edge lies where its value is halfway.
fn otsu(values: impl Iterator<Item = f32>, most: f64) -> f64 {
    let mut histogram = [0_f64; LEVELS];
    let mut total = 0.0;
    for value in values {
        histogram[((f64::from(value) / most * LEVELS as f64) as usize).min(LEVELS - 1)] += 1.0;
        total += 1.0;
    }
    let mean = |range: &[f64], from: usize| range.iter().enumerate().map(|(k, n)| (k + from) as f64 * n).sum::<f64>();
    let all = mean(&histogram, 0);
    let (mut count, mut sum) = (0.0, 0.0);
    let (mut best, mut level) = (-1.0, 0.5 * LEVELS as f64);
    for (k, &bar) in histogram[..LEVELS - 1].iter().enumerate() {
        count += bar;
        sum += k as f64 * bar;
        let rest = total - count;
        if count == 0.0 || rest == 0.0 {
            continue;
        }
        let between = count * rest * (sum / count - (all - sum) / rest).powi(2);
        if between > best {
            // A bar stands for the values about its middle.
            (best, level) = (between, 0.5 * (sum / count + (all - sum) / rest) + 0.5);
        }
    }
    level / LEVELS as f64 * most
}
