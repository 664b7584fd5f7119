//! The picture on a plushie, decoded, in halving sizes: however small it is drawn, no pixel of it is skipped.

use crate::outline::{self, OutlineError, Point};
use image::RgbaImage;
use std::fmt;
use std::path::Path;

/// Rows from the top; the corners are those of the box that the picture fills.
#[derive(Clone, PartialEq)]
pub struct Texture {
    /// From its own size down to a single pixel.
    levels: Vec<Level>,
}

/// The texture at one size.
#[derive(Clone, PartialEq)]
pub struct Level {
    pub width: u32,
    pub height: u32,
    /// RGBA, colours multiplied by the opacity: clear pixels lend no colour to their neighbours.
    pub pixels: Vec<u8>,
}

impl Texture {
    /// Reads a PNG or JPEG; a large one is averaged down ([`outline::MAX_TEXTURE_PX`]).
    ///
    /// # Errors
    /// What the system says of the file, or what is wrong with the picture.
    pub fn read(path: &Path) -> Result<Self, OutlineError> {
        Ok(Self::of(outline::read_texture(path)?))
    }

    pub fn of(mut picture: RgbaImage) -> Self {
        let mut levels = vec![Level::of(&picture)];
        while picture.width().max(picture.height()) > 1 {
            let half = [picture.width(), picture.height()].map(|side| (side / 2).max(1));
            picture = outline::shrunk(&picture, half);
            levels.push(Level::of(&picture));
        }
        Self { levels }
    }

    pub fn levels(&self) -> &[Level] {
        &self.levels
    }

    /// The colour at a place, 0 to 1 from the upper left corner, as the mean of about `texels` pixels each way: RGBA, 0 to 255,
    /// multiplied by the opacity. Nothing outside.
    pub fn color(&self, place: [f64; 2], texels: f64) -> [f64; 4] {
        if !place.iter().all(|v| (0.0..=1.0).contains(v)) {
            return [0.0; 4];
        }
        let level = texels.log2().clamp(0.0, (self.levels.len() - 1) as f64);
        let (fine, t) = (level as usize, level.fract());
        let near = self.levels[fine].color(place);
        if t == 0.0 {
            return near;
        }
        let far = self.levels[fine + 1].color(place);
        [0, 1, 2, 3].map(|k| near[k] + t * (far[k] - near[k]))
    }
}

impl Level {
    fn of(picture: &RgbaImage) -> Self {
        let by_opacity = |p: &image::Rgba<u8>| {
            let [r, g, b, a] = p.0;
            let times = |c: u8| ((u32::from(c) * u32::from(a) + 127) / 255) as u8;
            [times(r), times(g), times(b), a]
        };
        let (width, height) = picture.dimensions();
        Self { width, height, pixels: picture.pixels().flat_map(by_opacity).collect() }
    }

    /// Between the four pixels around a place; the outermost go on to the rim.
    fn color(&self, place: [f64; 2]) -> [f64; 4] {
        let along = |v: f64, size: u32| {
            let at = (v * f64::from(size) - 0.5).clamp(0.0, f64::from(size - 1));
            let first = at as u32;
            (first, (first + 1).min(size - 1), at.fract())
        };
        let (left, right, s) = along(place[0], self.width);
        let (top, bottom, t) = along(place[1], self.height);
        let pixel =
            |x: u32, y: u32, k: usize| f64::from(self.pixels[4 * (y as usize * self.width as usize + x as usize) + k]);
        [0, 1, 2, 3].map(|k| {
            let row = |y: u32| (1.0 - s) * pixel(left, y, k) + s * pixel(right, y, k);
            (1.0 - t) * row(top) + t * row(bottom)
        })
    }
}

/// Not its pixels.
impl fmt::Debug for Texture {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Texture({} x {})", self.levels[0].width, self.levels[0].height)
    }
}

/// Where points at rest lie in a texture between two corners, mm: 0 to 1 from its upper left one.
pub fn places([low, high]: [Point; 2], rest: &[Point]) -> Vec<Point> {
    let place = |p: &Point| [(p[0] - low[0]) / (high[0] - low[0]), (high[1] - p[1]) / (high[1] - low[1])];
    rest.iter().map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::Rgba;

    #[test]
    fn it_is_seen_at_every_size_and_clear_pixels_lend_no_colour() {
        let picture = RgbaImage::from_fn(6, 4, |x, _| Rgba(if x < 3 { [200, 0, 0, 255] } else { [0, 90, 0, 0] }));
        let texture = Texture::of(picture);
        let sizes: Vec<_> = texture.levels().iter().map(|l| (l.width, l.height)).collect();
        assert_eq!(sizes, [(6, 4), (3, 2), (1, 1)]);
        assert_eq!(texture.color([0.1, 0.5], 1.0), [200.0, 0.0, 0.0, 255.0]);
        assert_eq!(texture.color([0.9, 0.5], 1.0), [0.0; 4]);
        // Half of everything is clear.
        let all = texture.color([0.2, 0.7], 1e9);
        assert!((all[3] - 128.0).abs() < 2.0 && (all[0] - 100.0).abs() < 2.0 && all[1] == 0.0, "{all:?}");
        assert_eq!(texture.color([1.001, 0.5], 1.0), [0.0; 4]);
    }
}
