//! A silhouette from a picture: what is opaque, or what differs from its background.
//!
//! A picture with transparency is painted where it is opaque. In any other one the background is what its rim shows: for
//! each colour channel a quadratic surface in x and y is fitted to the rim and then, again and again, to all that is near
//! it, so that a photo of paper may be lit unevenly. How far a pixel's colour is from that surface tells ink from paper;
//! the level between the two is Otsu's (1979), which parts the histogram into the two classes with the least variance
//! within. The boundary is traced to a fraction of a pixel.
//!
//! Where what is found is a sheet or a card with a figure on it, the figure is looked for once more within it (`figure`), and a sheet seen at
//! an angle is straightened.

mod background;
mod figure;
mod pixels;
mod resolution;
mod sheet;
mod traced;

use super::finish::finish;
use super::{OutlineReader, Painting, ReadingOption};
use crate::outline::resample::{MAX_TEXTURE_PX, cut, fitted};
use crate::outline::{Background, Import, Imported, Note, OutlineError, Point, Sizing};
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits, RgbaImage};
use pixels::{Pixels, working_factor};
use std::io::Cursor;
use traced::traced;

/// Most pixels of a picture of a silhouette. With the common form, and what a JPEG in passes needs, 400 MB.
const MAX_PIXELS: u64 = 40_000_000;
/// Most pixels of a texture: four times what is kept of it. It is read beside a window, unasked, so it costs less: 170 MB.
const MAX_TEXTURE_PIXELS: u64 = 4 * (MAX_TEXTURE_PX as u64).pow(2);
/// Bytes a pixel of the common form. One of more, as with 16 bits a channel, counts for as many pixels.
const PIXEL_BYTES: u64 = 4;
/// What decoding may take beside the pixels, bytes: the texts of a file, its rows.
const DECODER_BYTES: u64 = 64 << 20;
/// Pixels without a stated size count as CSS px, 96 to the inch.
const MM_PER_PX: f64 = 25.4 / 96.0;

pub(super) struct Picture;

impl OutlineReader for Picture {
    fn names(&self) -> [&'static str; 2] {
        ["a picture", "pictures"]
    }

    fn extensions(&self) -> &'static [&'static str] {
        &["png", "jpg", "jpeg", "webp", "gif", "bmp", "tif", "tiff"]
    }

    fn can_read(&self, head: &[u8]) -> bool {
        let begins = [&b"\x89PNG"[..], b"\xff\xd8\xff", b"GIF8", b"BM", b"II*\0", b"MM\0*"];
        begins.iter().any(|magic| head.starts_with(magic))
            || (head.starts_with(b"RIFF") && head.get(8..12) == Some(b"WEBP"))
    }

    fn options(&self) -> &'static [ReadingOption] {
        &[ReadingOption::Unit, ReadingOption::Threshold, ReadingOption::Background]
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
    // A picture at its own size has stairs, and a JPEG noise.
    let passes = if format == ImageFormat::Jpeg { 2 } else { 1 };
    let mut painting = painted(picture, passes, import)?;
    let stated = import.unit_mm.or_else(|| resolution::mm_per_px(bytes));
    if stated.is_none() && !import.asks_size() {
        painting.notes.push(Note::Size(Sizing::Pixels));
    }
    painting.unit_mm *= stated.unwrap_or(MM_PER_PX);
    Ok(painting)
}

/// What counts in a picture, in its working pixels, y up; their unit is a pixel of the picture. `passes`: how often a picture at its own size is blurred.
pub(super) fn painted(picture: DynamicImage, passes: usize, import: &Import) -> Result<Painting, OutlineError> {
    let pixels = Pixels::of(picture);
    // Averaging has smoothed already.
    let passes = if pixels.factor > 1 { 0 } else { passes };
    let asked = import.threshold.map(|t| f64::from(t) / 255.0);
    let mut painting = Painting { unit_mm: pixels.factor as f64, ..Painting::default() };
    let whole = if pixels.clear { pixels.opacity(asked) } else { pixels.ink(None, asked)? };
    let found = traced(whole.field.blurred(passes), whole.level)?;
    let on_it = match import.background {
        Background::Keep => None,
        choice => figure::on_sheet(&pixels, &found, whole.colour, passes, choice)?,
    };
    match on_it {
        Some(figure) if figure.counts => {
            painting.notes.push(Note::Ink(255.0 * figure.level));
            figure.take(&mut painting);
        }
        other => {
            if !pixels.clear {
                painting.notes.push(Note::Ink(255.0 * whole.level));
            }
            painting.notes.extend(other.map(|figure| Note::GroundCounts(figure.ground)));
            found.take(&mut painting);
        }
    }
    Ok(painting)
}

/// Whether a picture is one that is read, by its head alone.
pub(super) fn fits(bytes: &[u8]) -> bool {
    let size = ImageReader::new(Cursor::new(bytes)).with_guessed_format().ok().and_then(|r| r.into_dimensions().ok());
    size.is_some_and(|(width, height)| u64::from(width) * u64::from(height) <= MAX_PIXELS)
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

const TOO_MANY: OutlineError = OutlineError::TooComplex("has more than 40 million pixels, or half as many of 16 bits");

/// The picture the right way up, or `None` if it has more than so many pixels.
fn decode(bytes: &[u8], most: u64) -> Result<Option<(DynamicImage, ImageFormat)>, OutlineError> {
    upright(bytes, most).map_err(|error| OutlineError::Unreadable { format: "picture", reason: error.to_string() })
}

fn upright(bytes: &[u8], most: u64) -> image::ImageResult<Option<(DynamicImage, ImageFormat)>> {
    let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format()?;
    let mut limits = Limits::default();
    limits.max_alloc = Some(PIXEL_BYTES * most + DECODER_BYTES);
    reader.limits(limits);
    let format = reader.format().unwrap_or(ImageFormat::Png);
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
