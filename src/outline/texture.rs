//! The picture of a plushie: what its file shows within the silhouette's box.

use super::{Format, Import, Imported, OutlineError, Point, import, picture, svg};
use crate::files;
use image::{ImageFormat, RgbaImage};
use std::io::{self, Cursor};
use std::path::Path;

/// Longest side of a texture, pixels: 0.15 mm on 300 mm.
pub const MAX_TEXTURE_PX: u32 = 2048;

/// A PNG of what the file shows in the box of its silhouette: RGBA, its corners those of the box after the clean-up, its longer side at
/// most [`MAX_TEXTURE_PX`]. `bytes` and `import` are those that gave `imported`. Only chosen layers are in it, and
/// beyond the rim of a picture its outermost pixels go on.
///
/// # Errors
/// A format without colours; a drawing that takes too long to paint. See [`OutlineError`].
pub fn texture(bytes: &[u8], import: &Import, imported: &Imported) -> Result<Vec<u8>, OutlineError> {
    let picture = match Format::of(bytes).ok_or(OutlineError::UnknownFormat)? {
        Format::Picture => picture::texture(bytes, imported.drawn_box)?,
        Format::Svg => svg::texture(bytes, import, imported.drawn_box)?,
        Format::Dxf => return Err(OutlineError::NoTexture("a DXF drawing")),
        Format::Obj => return Err(OutlineError::NoTexture("an OBJ mesh")),
        Format::Drawing => return Err(OutlineError::NoTexture("a drawing of parts")),
    };
    let mut png = Cursor::new(Vec::new());
    let unwritable = |e: image::ImageError| OutlineError::Unreadable { format: "texture", reason: e.to_string() };
    picture.write_to(&mut png, ImageFormat::Png).map_err(unwritable)?;
    Ok(files::marked_png(&png.into_inner()))
}

/// Reads a texture back, a PNG or JPEG; a side longer than [`MAX_TEXTURE_PX`] is averaged down.
///
/// # Errors
/// What the system says of the file, or what is wrong with the picture.
pub fn read_texture(path: &Path) -> Result<RgbaImage, OutlineError> {
    let unread = |error: io::Error| match error.kind() {
        io::ErrorKind::FileTooLarge => OutlineError::TooLarge,
        _ => OutlineError::Unopened(error.to_string()),
    };
    let bytes = files::read(path, import::MAX_FILE_BYTES as u64).map_err(unread)?;
    let picture = picture::decoded(&bytes)?;
    let size = [picture.width(), picture.height()];
    let fitted = fitted(size.map(f64::from), f64::from(MAX_TEXTURE_PX));
    Ok(if fitted == size { picture } else { shrunk(&picture, fitted) })
}

/// A picture of fewer pixels: each the mean of those that it covers, with opacity as the weight of a colour.
pub fn shrunk(picture: &RgbaImage, size: [u32; 2]) -> RgbaImage {
    cut(picture, [0.0; 2], [f64::from(picture.width()), f64::from(picture.height())], size)
}

/// Width and height of a texture of `size` pixels shrunk so that its longer side has at most `longest`.
pub(super) fn fitted(size: Point, longest: f64) -> [u32; 2] {
    let scale = (longest / size[0].max(size[1])).min(1.0);
    // Up, so that nothing of a picture of its own size is lost; but for the digits of a whole number.
    size.map(|side| (side * scale - 1e-6).ceil().clamp(1.0, f64::from(MAX_TEXTURE_PX)) as u32)
}

/// The part of a picture between two corners (pixels, y down) in a given number of pixels.
///
/// Each new pixel is the mean of the area that it covers, with opacity as the weight of a colour.
pub(super) fn cut(picture: &RgbaImage, low: Point, high: Point, [width, height]: [u32; 2]) -> RgbaImage {
    let columns = shares(low[0], high[0], width, picture.width());
    let rows = shares(low[1], high[1], height, picture.height());
    let mut cut = RgbaImage::new(width, height);
    // Neighbouring rows of the texture share a row of the picture.
    let mut known: Option<(u32, Vec<[f32; 4]>)> = None;
    for (y, (first, weights)) in rows.iter().enumerate() {
        let mut sums = vec![[0_f32; 4]; columns.len()];
        for (row, &weight) in (*first..).zip(weights) {
            let line = match known.take() {
                Some((at, line)) if at == row => line,
                _ => columns.iter().map(|column| mean(picture, row, column)).collect(),
            };
            for (sum, value) in sums.iter_mut().zip(&line) {
                (0..4).for_each(|k| sum[k] += weight * value[k]);
            }
            known = Some((row, line));
        }
        for (x, [r, g, b, a]) in sums.into_iter().enumerate() {
            let colour = |v: f32| if a > 0.0 { (v / a).round().clamp(0.0, 255.0) as u8 } else { 0 };
            let pixel = [colour(r), colour(g), colour(b), (255.0 * a).round().clamp(0.0, 255.0) as u8];
            cut.put_pixel(x as u32, y as u32, image::Rgba(pixel));
        }
    }
    cut
}

/// Mean colour (0 to 255, times opacity) and opacity (0 to 1) of a stretch of a row.
fn mean(picture: &RgbaImage, row: u32, (first, weights): &(u32, Vec<f32>)) -> [f32; 4] {
    let mut sum = [0.0; 4];
    for (column, weight) in (*first..).zip(weights) {
        let [r, g, b, a] = picture.get_pixel(column, row).0;
        let share = weight * f32::from(a) / 255.0;
        for (sum, value) in sum.iter_mut().zip([f32::from(r), f32::from(g), f32::from(b), 1.0]) {
            *sum += share * value;
        }
    }
    sum
}

/// For each of `count` equal parts of the stretch from `low` to `high`: the first of the `size` pixels that it covers, and the part of it
/// that each pixel from there on makes. The outermost pixels go on beyond the picture.
fn shares(low: f64, high: f64, count: u32, size: u32) -> Vec<(u32, Vec<f32>)> {
    let step = (high - low) / f64::from(count);
    let most = f64::from(size - 1);
    let part = |i: u32| {
        let from = low + f64::from(i) * step;
        let to = from + step;
        let first = from.floor().clamp(0.0, most);
        let last = (to.ceil() - 1.0).clamp(first, most);
        let share = |k: u32| {
            let left = if k == 0 { f64::NEG_INFINITY } else { f64::from(k) };
            let right = if k == size - 1 { f64::INFINITY } else { f64::from(k + 1) };
            ((to.min(right) - from.max(left)).max(0.0) / step) as f32
        };
        (first as u32, (first as u32..=last as u32).map(share).collect())
    };
    (0..count).map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgba;

    #[test]
    fn shares_of_every_part_sum_to_one() {
        for (low, high, count, size) in
            [(0.0, 9.0, 9, 9), (0.3, 8.1, 5, 9), (-3.0, 12.0, 4, 9), (2.25, 2.75, 1, 4), (20.0, 21.0, 3, 4)]
        {
            for (first, weights) in shares(low, high, count, size) {
                assert!(first as usize + weights.len() <= size as usize);
                assert!((weights.iter().sum::<f32>() - 1.0).abs() < 1e-5, "{low} {high} {count} {size}: {weights:?}");
            }
        }
    }

    #[test]
    fn whole_pixels_stay_and_clear_ones_lend_no_colour() {
        let picture = RgbaImage::from_fn(7, 5, |x, y| Rgba([10 * x as u8, 20 * y as u8, 3, 255]));
        assert_eq!(cut(&picture, [0.0, 0.0], [7.0, 5.0], [7, 5]), picture);
        let part = cut(&picture, [2.0, 1.0], [4.0, 2.0], [2, 1]);
        assert_eq!((part.get_pixel(0, 0).0, part.get_pixel(1, 0).0), ([20, 20, 3, 255], [30, 20, 3, 255]));
        let rim = RgbaImage::from_fn(2, 1, |x, _| Rgba(if x == 0 { [200, 100, 50, 255] } else { [0; 4] }));
        assert_eq!(cut(&rim, [0.0, 0.0], [2.0, 1.0], [1, 1]).get_pixel(0, 0).0, [200, 100, 50, 128]);
    }

    #[test]
    fn the_longer_side_is_bounded() {
        assert_eq!(fitted([300.0, 150.5], 2048.0), [300, 151]);
        assert_eq!(fitted([8192.0, 4096.0], 2048.0), [2048, 1024]);
        assert_eq!(fitted([1e-3, 1e9], 2048.0), [1, 2048]);
    }
}
