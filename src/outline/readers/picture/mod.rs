//! A silhouette from a PNG or JPEG picture: what is opaque, or what differs from its background.
//!
//! A picture with transparency is painted where it is opaque. In any other one the background is what its rim shows: for
//! each colour channel a quadratic surface in x and y is fitted to the rim and then, again and again, to all that is near
//! it, so that a photo of paper may be lit unevenly. How far a pixel's colour is from that surface tells ink from paper;
//! the level between the two is Otsu's (1979), which parts the histogram into the two classes with the least variance
//! within. The boundary is traced to a fraction of a pixel.

mod background;
mod resolution;

use super::finish::finish;
use super::{OutlineReader, Painting, ReadingOption};
use crate::outline::regions::{self, Shapes};
use crate::outline::resample::{MAX_TEXTURE_PX, cut, fitted};
use crate::outline::simplify::simplify;
use crate::outline::trace::Field;
use crate::outline::{Import, Imported, Note, OutlineError, Point, polygon};
use i_overlay::core::fill_rule::FillRule;
use image::{DynamicImage, ImageDecoder, ImageReader, Limits, RgbaImage};
use std::io::Cursor;

/// Most pixels of a picture of a silhouette. With the common form, and what a JPEG in passes needs, 400 MB.
const MAX_PIXELS: u64 = 40_000_000;
/// Most pixels of a texture: four times what is kept of it. It is read beside a window, unasked, so it costs less: 170 MB.
const MAX_TEXTURE_PIXELS: u64 = 4 * (MAX_TEXTURE_PX as u64).pow(2);
/// Bytes a pixel of the common form. One of more, as with 16 bits a channel, counts for as many pixels.
const PIXEL_BYTES: u64 = 4;
/// What decoding may take beside the pixels, bytes: the texts of a file, its rows.
const DECODER_BYTES: u64 = 64 << 20;
/// Longer side, in pixels, to which larger pictures are averaged down: 0.2 mm on 300 mm.
const WORKING_SIDE: usize = 1600;
/// Part of the pixels that must be less than half opaque for the opacity to be the silhouette.
const TRANSPARENT_FRACTION: f64 = 1e-3;
/// Differences from the background below this are noise; without larger ones nothing is painted.
const LEAST_CONTRAST: f64 = 0.08;
/// Regions and holes smaller than this are noise of the picture, in working pixels.
const NOISE_PX2: f64 = 12.0;
/// The same as a part of the area traced.
const NOISE_FRACTION: f64 = 3e-4;
/// How far the traced line may be simplified, in working pixels.
const TOLERANCE_PX: f64 = 0.15;
/// Levels of Otsu's histogram.
const LEVELS: usize = 256;

pub(super) struct Picture;

impl OutlineReader for Picture {
    fn names(&self) -> [&'static str; 2] {
        ["a picture", "pictures"]
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["png", "jpg", "jpeg"]
    }

    fn can_read(&self, head: &[u8]) -> bool {
        head.starts_with(b"\x89PNG") || head.starts_with(b"\xff\xd8\xff")
    }

    fn options(&self) -> &'static [ReadingOption] {
        &[ReadingOption::Unit, ReadingOption::Threshold]
    }

    fn read(&self, bytes: &[u8], import: &Import) -> Result<Imported, OutlineError> {
        finish(painting(bytes, import)?, import)
    }

    fn texture(&self, bytes: &[u8], _import: &Import, drawn_box: [Point; 2]) -> Result<RgbaImage, OutlineError> {
        texture(bytes, drawn_box)
    }
}

fn painting(bytes: &[u8], import: &Import) -> Result<Painting, OutlineError> {
    let (picture, format) = decode(bytes, MAX_PIXELS)?.ok_or(TOO_MANY)?;
    let mut notes = Vec::new();
    let (field, factor) = field(picture, import.threshold, &mut notes)?;
    // Averaging has smoothed already; a picture at its own size has stairs, and a JPEG noise.
    let passes = if factor > 1 {
        0
    } else if format == image::ImageFormat::Jpeg {
        2
    } else {
        1
    };
    let (field, level) = field;
    let shapes = traced(&field.blurred(passes), level, &mut notes)?;
    let mm_per_px = import.unit_mm.unwrap_or_else(|| resolution::mm_per_px(bytes));
    Ok(Painting { shapes, unit_mm: mm_per_px * factor as f64, notes })
}

/// The part of the picture between the corners of a box (working pixels, y up).
fn texture(bytes: &[u8], [low, high]: [Point; 2]) -> Result<RgbaImage, OutlineError> {
    let picture = decode(bytes, MAX_PIXELS)?.ok_or(TOO_MANY)?.0.into_rgba8();
    let scale = working_factor(picture.width() as usize, picture.height() as usize) as f64;
    let (low, high) = ([scale * low[0], -scale * high[1]], [scale * high[0], -scale * low[1]]);
    let size = fitted([high[0] - low[0], high[1] - low[1]], f64::from(MAX_TEXTURE_PX));
    Ok(cut(&picture, low, high, size))
}

/// The whole picture of a texture, the right way up.
pub(in crate::outline) fn decoded(bytes: &[u8]) -> Result<RgbaImage, OutlineError> {
    let too_many = OutlineError::TextureTooLarge { millions: MAX_TEXTURE_PIXELS / 1_000_000 };
    Ok(decode(bytes, MAX_TEXTURE_PIXELS)?.ok_or(too_many)?.0.into_rgba8())
}

/// How many pixels of a picture, along each axis, one working pixel stands for.
fn working_factor(width: usize, height: usize) -> usize {
    width.max(height).div_ceil(WORKING_SIDE).max(1)
}

const TOO_MANY: OutlineError = OutlineError::TooComplex("has more than 40 million pixels, or half as many of 16 bits");

/// The picture the right way up, or `None` if it has more than so many pixels.
fn decode(bytes: &[u8], most: u64) -> Result<Option<(DynamicImage, image::ImageFormat)>, OutlineError> {
    upright(bytes, most).map_err(|error| OutlineError::Unreadable { format: "picture", reason: error.to_string() })
}

fn upright(bytes: &[u8], most: u64) -> image::ImageResult<Option<(DynamicImage, image::ImageFormat)>> {
    let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format()?;
    let mut limits = Limits::default();
    limits.max_alloc = Some(PIXEL_BYTES * most + DECODER_BYTES);
    reader.limits(limits);
    let format = reader.format().unwrap_or(image::ImageFormat::Png);
    let mut decoder = reader.into_decoder()?;
    let (width, height) = decoder.dimensions();
    if u64::from(width) * u64::from(height) > most || decoder.total_bytes() > PIXEL_BYTES * most {
        return Ok(None);
    }
    let orientation = decoder.orientation()?;
    let mut picture = DynamicImage::from_decoder(decoder)?;
    picture.apply_orientation(orientation);
    Ok(Some((picture, format)))
}

/// How much ink there is at each working pixel, with the level that parts it from the background, and how many pixels of
/// the picture a working pixel measures.
fn field(
    picture: DynamicImage,
    threshold: Option<u8>,
    notes: &mut Vec<Note>,
) -> Result<((Field, f64), usize), OutlineError> {
    let rgba = picture.into_rgba8();
    let (wide, high) = (rgba.width() as usize, rgba.height() as usize);
    let factor = working_factor(wide, high);
    let (width, height) = (wide.div_ceil(factor), high.div_ceil(factor));
    let clear = rgba.pixels().filter(|p| p[3] < 128).count() as f64 > TRANSPARENT_FRACTION * (wide * high) as f64;
    // Averages of factor x factor pixels; with transparency, of the opacity alone.
    let mut sums = vec![[0_f32; 4]; width * height];
    for (x, y, pixel) in rgba.enumerate_pixels() {
        let cell = &mut sums[y as usize / factor * width + x as usize / factor];
        for (sum, value) in cell.iter_mut().zip(pixel.0) {
            *sum += f32::from(value) / 255.0;
        }
    }
    drop(rgba);
    for (k, cell) in sums.iter_mut().enumerate() {
        let count = |at: usize, size: usize| (size - at * factor).min(factor);
        let pixels = count(k % width, wide) * count(k / width, high);
        for value in cell {
            *value /= pixels as f32;
        }
    }
    let asked = threshold.map(|t| f64::from(t) / 255.0);
    if clear {
        let values = sums.iter().map(|cell| cell[3]).collect();
        return Ok(((Field { width, height, values }, asked.unwrap_or(0.5)), factor));
    }
    let values = background::difference(&sums, width, height);
    let most = values.iter().copied().fold(0.0, f32::max);
    if f64::from(most) < LEAST_CONTRAST {
        return Err(OutlineError::NothingPainted("the picture has one colour all over"));
    }
    let level = asked.unwrap_or_else(|| otsu(&values, f64::from(most)).max(0.5 * LEAST_CONTRAST));
    notes.push(Note::Ink(255.0 * level));
    Ok(((Field { width, height, values }, level), factor))
}

/// Parts values between 0 and `most` into the two classes with the largest variance between them (Otsu 1979), and takes
/// the level halfway between their means: where the classes are far apart any level between them parts them as well,
/// but a blurred edge lies where its value is halfway.
fn otsu(values: &[f32], most: f64) -> f64 {
    let mut histogram = [0_f64; LEVELS];
    for &value in values {
        histogram[((f64::from(value) / most * LEVELS as f64) as usize).min(LEVELS - 1)] += 1.0;
    }
    let total = values.len() as f64;
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

/// The regions at or above the level, without noise.
fn traced(field: &Field, level: f64, notes: &mut Vec<Note>) -> Result<Shapes, OutlineError> {
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
    let noise = contours.len() - kept.len();
    if kept.is_empty() {
        return Err(OutlineError::NothingPainted("the picture has no area that differs from its background"));
    }
    if noise > 0 {
        notes.push(Note::Specks { count: noise, pixels: least });
    }
    regions::resolve(&kept, FillRule::EvenOdd)
}
