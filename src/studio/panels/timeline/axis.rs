//! From seconds to pixels and back.

use eframe::egui::Rect;

/// The row of the track, and what its width stands for.
pub struct Axis {
    pub rect: Rect,
    pub span_s: f64,
}

/// Height of the row of times, logical pixels.
pub const RULER: f32 = 16.0;
/// From the lower edge to the line of the keyframes, logical pixels.
const FOOT: f32 = 8.0;
const MARGIN: f32 = 14.0;

impl Axis {
    pub fn x(&self, time_s: f64) -> f32 {
        self.rect.left() + MARGIN + (time_s / self.span_s * self.width()) as f32
    }

    pub fn time(&self, x: f32) -> f64 {
        f64::from(x - self.rect.left() - MARGIN) / self.width() * self.span_s
    }

    /// The line of the keyframes.
    pub fn base(&self) -> f32 {
        self.rect.bottom() - FOOT
    }

    fn width(&self) -> f64 {
        f64::from((self.rect.width() - 2.0 * MARGIN).max(1.0))
    }
}
