//! What was read of a file: the outline, and in colours what it does not hold.

use super::color::Color;
pub use super::pixels::Preview;
use super::raster::{RasterError, fitted, path};
use crate::files::marked_png;
use crate::outline::{Imported, Point, Why};
use tiny_skia::{FillRule, Paint, Pixmap, Stroke, Transform};

/// Behind everything, the body and its edge.
const BACKGROUND: Color = Color(250, 249, 246, 255);
const BODY: Color = Color(196, 178, 156, 255);
const EDGE: Color = Color(70, 52, 36, 255);
/// Width of the edge, pixels.
const EDGE_PX: f32 = 1.5;

/// The colour of what is no part of the outline, or was not part of the drawing, and its name.
pub fn color(why: Why) -> (Color, &'static str) {
    match why {
        Why::Background => (Color(150, 190, 235, 150), "blue"),
        Why::Faint => (Color(190, 150, 220, 150), "violet"),
        Why::Specks => (Color(230, 120, 40, 255), "orange"),
        Why::Pieces => (Color(220, 90, 90, 220), "red"),
        Why::Filled => (Color(120, 200, 120, 170), "green"),
        Why::Closed => (Color(0, 150, 60, 255), "dark green"),
    }
}

/// Draws what was read into a picture of a size, pixels.
///
/// # Errors
/// A size that is empty or does not fit in memory.
pub fn paint(imported: &Imported, (width, height): (u32, u32)) -> Result<Preview, RasterError> {
    let mut pixmap = Pixmap::new(width, height).ok_or(RasterError::Size(width, height))?;
    let solid = |Color(r, g, b, a): Color| tiny_skia::Color::from_rgba8(r, g, b, a);
    pixmap.fill(solid(BACKGROUND));
    let body: Vec<Vec<Point>> = imported.outline.polygons().map(Vec::from).collect();
    let all = imported.asides.iter().flat_map(|aside| &aside.areas).flatten().chain(&body).flatten();
    let place = fitted(all, (width, height));
    let mut paint = Paint { anti_alias: true, ..Paint::default() };
    // What lies below the body, then the body, then what was filled in it.
    let is_above = |why: Why| matches!(why, Why::Filled | Why::Closed);
    for above in [false, true] {
        for aside in imported.asides.iter().filter(|aside| is_above(aside.why) == above) {
            paint.set_color(solid(color(aside.why).0));
            let rings = aside.areas.iter().flatten().map(Vec::as_slice);
            if let Some(area) = path(rings, &place) {
                pixmap.fill_path(&area, &paint, FillRule::EvenOdd, Transform::identity(), None);
            }
        }
        if let Some(area) = path(body.iter().map(Vec::as_slice), &place) {
            if !above {
                paint.set_color(solid(BODY));
                pixmap.fill_path(&area, &paint, FillRule::EvenOdd, Transform::identity(), None);
            }
            paint.set_color(solid(EDGE));
            pixmap.stroke_path(
                &area,
                &paint,
                &Stroke { width: EDGE_PX, ..Stroke::default() },
                Transform::identity(),
                None,
            );
        }
    }
    // Opaque all over, so that straight and premultiplied are the same.
    Ok(Preview { width, height, pixels: pixmap.take() })
}

impl Preview {
    /// As a PNG file.
    ///
    /// # Errors
    /// A picture that cannot be encoded.
    pub fn png(&self) -> Result<Vec<u8>, RasterError> {
        let size = tiny_skia::IntSize::from_wh(self.width, self.height);
        let pixmap = size.and_then(|size| Pixmap::from_vec(self.pixels.clone(), size));
        let pixmap = pixmap.ok_or(RasterError::Size(self.width, self.height))?;
        pixmap.encode_png().map(|png| marked_png(&png)).map_err(|error| RasterError::Encode(error.to_string()))
    }
}

/// The colours that a picture has, with what they stand for, a line each.
pub fn legend(imported: &Imported) -> Vec<String> {
    let mut kinds: Vec<Why> = imported.asides.iter().map(|aside| aside.why).collect();
    kinds.sort_unstable();
    kinds.dedup();
    kinds.into_iter().map(|why| format!("{}: {}", color(why).1, what(why))).collect()
}

fn what(why: Why) -> &'static str {
    match why {
        Why::Background => "taken for the background, left out",
        Why::Faint => "hardly opaque, left out",
        Why::Specks => "too small, left out",
        Why::Pieces => "other pieces, left out",
        Why::Filled => "holes that were filled",
        Why::Closed => "gaps that were closed",
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::outline::{Import, import};

    #[test]
    fn the_body_and_what_was_left_out_are_where_they_are() {
        let svg = "<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='100mm' viewBox='0 0 100 100'>\
                   <rect width='100' height='100' fill='white'/><path d='M50 20h30v60h-30z'/></svg>";
        let imported = import(svg.as_bytes(), &Import::default()).unwrap();
        let picture = paint(&imported, (200, 200)).unwrap();
        let at = |x: usize, y: usize| &picture.pixels[4 * (200 * y + x)..][..3];
        assert_eq!(at(130, 100), [BODY.0, BODY.1, BODY.2]);
        // Paper, mixed with what is behind it.
        let paper = at(50, 100);
        assert!(paper[2] > paper[0] + 20, "{paper:?}");
        assert_eq!(at(2, 2), [BACKGROUND.0, BACKGROUND.1, BACKGROUND.2]);
        assert_eq!(legend(&imported), ["blue: taken for the background, left out"]);
        assert!(picture.png().unwrap().starts_with(b"\x89PNG"));
    }
}
