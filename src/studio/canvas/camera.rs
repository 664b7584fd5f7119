//! From mm (y up) to logical pixels (y down) and back.

use crate::outline::Point;
use eframe::egui::{Pos2, Rect, Vec2, pos2};

/// The part of the plane that a viewport shows: a point in its middle and a scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// mm.
    pub center: Point,
    /// Logical pixels per mm.
    pub scale: f32,
}

/// Air around a fitted drawing, as a fraction of its box on each side: room to draw on.
const ROOM: f64 = 0.16;
/// Air around a body that is looked at: it fills its view.
const MARGIN: f64 = 0.06;
/// Logical pixels per mm.
const SCALES: std::ops::RangeInclusive<f32> = 0.01..=200.0;

impl Camera {
    /// Shows the box from `low` to `high` in a view of `size`, with room around it.
    pub fn fit(low: Point, high: Point, size: Vec2) -> Self {
        Self::within(low, high, size, ROOM)
    }

    /// Shows the box from `low` to `high` as large as a view of `size` allows.
    pub fn close(low: Point, high: Point, size: Vec2) -> Self {
        Self::within(low, high, size, MARGIN)
    }

    fn within(low: Point, high: Point, size: Vec2, margin: f64) -> Self {
        let span = [0, 1].map(|axis| ((high[axis] - low[axis]) * (1.0 + 2.0 * margin)).max(1e-6));
        let scale = (f64::from(size.x) / span[0]).min(f64::from(size.y) / span[1]) as f32;
        let scale = if scale.is_finite() { scale.clamp(*SCALES.start(), *SCALES.end()) } else { 1.0 };
        Self { center: [(low[0] + high[0]) / 2.0, (low[1] + high[1]) / 2.0], scale }
    }

    pub fn to_screen(&self, view: Rect, p: Point) -> Pos2 {
        let middle = view.center();
        pos2(
            middle.x + ((p[0] - self.center[0]) as f32) * self.scale,
            middle.y - ((p[1] - self.center[1]) as f32) * self.scale,
        )
    }

    pub fn to_body(&self, view: Rect, p: Pos2) -> Point {
        let offset = p - view.center();
        [self.center[0] + f64::from(offset.x / self.scale), self.center[1] - f64::from(offset.y / self.scale)]
    }

    /// Shows the same where everything was moved by so many mm.
    pub fn moved(self, by: Point) -> Self {
        Self { center: [self.center[0] + by[0], self.center[1] + by[1]], ..self }
    }

    /// Moves what is shown by `delta` logical pixels.
    pub fn panned(self, delta: Vec2) -> Self {
        let center =
            [self.center[0] - f64::from(delta.x / self.scale), self.center[1] + f64::from(delta.y / self.scale)];
        Self { center, ..self }
    }

    /// Zooms by `factor` and keeps what is under `pointer` there.
    pub fn zoomed(self, view: Rect, pointer: Pos2, factor: f32) -> Self {
        let kept = self.to_body(view, pointer);
        let scale = (self.scale * factor).clamp(*SCALES.start(), *SCALES.end());
        let moved = Self { scale, ..self };
        let now = moved.to_body(view, pointer);
        Self { center: [self.center[0] + kept[0] - now[0], self.center[1] + kept[1] - now[1]], scale }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::vec2;

    const VIEW: Rect = Rect { min: pos2(100.0, 50.0), max: pos2(500.0, 350.0) };

    #[test]
    fn there_and_back() {
        let camera = Camera { center: [30.0, -7.0], scale: 2.5 };
        for p in [[0.0, 0.0], [30.0, -7.0], [-12.5, 99.0]] {
            let back = camera.to_body(VIEW, camera.to_screen(VIEW, p));
            assert!((back[0] - p[0]).abs() < 1e-3 && (back[1] - p[1]).abs() < 1e-3);
        }
        assert!(camera.to_screen(VIEW, [0.0, 10.0]).y < camera.to_screen(VIEW, [0.0, 0.0]).y, "y is up");
    }

    #[test]
    fn a_fitted_body_is_inside() {
        let camera = Camera::fit([0.0, 0.0], [200.0, 100.0], VIEW.size());
        for corner in [[0.0, 0.0], [200.0, 100.0], [0.0, 100.0]] {
            assert!(VIEW.contains(camera.to_screen(VIEW, corner)));
        }
        assert!(Camera::fit([0.0; 2], [0.0; 2], vec2(0.0, 0.0)).scale > 0.0);
    }

    #[test]
    fn zooming_keeps_the_point_under_the_pointer() {
        let camera = Camera { center: [3.0, 4.0], scale: 2.0 };
        let pointer = pos2(140.0, 300.0);
        let before = camera.to_body(VIEW, pointer);
        let after = camera.zoomed(VIEW, pointer, 3.0).to_body(VIEW, pointer);
        assert!((before[0] - after[0]).abs() < 1e-3 && (before[1] - after[1]).abs() < 1e-3);
    }
}
