//! Letters as paths, for pictures without a graphics adapter.

use crate::fabrication::font;
use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::{FontRef, GlyphId, MetadataProvider};
use tiny_skia::{Path, PathBuilder};

/// The outline of a text whose letters are `size` pixels high, its base line starting at a place (y down); `None` for a blank one.
pub(super) fn path(text: &str, size: f32, [x, y]: [f32; 2]) -> Option<Path> {
    let font = FontRef::new(font::BYTES).ok()?;
    let glyphs = font.outline_glyphs();
    let mut pen = Pen { path: PathBuilder::new(), at: [x, y] };
    for letter in text.chars().map(font::set) {
        if let Some(glyph) = glyphs.get(GlyphId::new(letter.glyph)) {
            let settings = DrawSettings::unhinted(Size::new(size), LocationRef::default());
            // A glyph that is broken is left out: the font is our own.
            let _ = glyph.draw(settings, &mut pen);
        }
        pen.at[0] += letter.width as f32 * size;
    }
    pen.path.finish()
}

/// Width of a text, pixels.
pub(super) fn width(text: &str, size: f32) -> f32 {
    font::width_mm(text, f64::from(size)) as f32
}

struct Pen {
    path: PathBuilder,
    at: [f32; 2],
}

impl Pen {
    fn to(&self, x: f32, y: f32) -> (f32, f32) {
        (self.at[0] + x, self.at[1] - y)
    }
}

impl OutlinePen for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.to(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.to(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        let ((cx, cy), (x, y)) = (self.to(cx, cy), self.to(x, y));
        self.path.quad_to(cx, cy, x, y);
    }

    fn curve_to(&mut self, ax: f32, ay: f32, bx: f32, by: f32, x: f32, y: f32) {
        let ((ax, ay), (bx, by), (x, y)) = (self.to(ax, ay), self.to(bx, by), self.to(x, y));
        self.path.cubic_to(ax, ay, bx, by, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}
