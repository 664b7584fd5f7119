//! Pictures with other numbers of pixels.

use super::Point;
use image::RgbaImage;

/// Longest side of a texture, pixels: 0.15 mm on 300 mm.
pub const MAX_TEXTURE_PX: u32 = 2048;

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
