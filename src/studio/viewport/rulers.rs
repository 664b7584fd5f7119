//! Rulers along a view and a grid behind the body, in mm.

use crate::studio::canvas::Canvas;
use eframe::egui::{Align2, FontId, Rect, Stroke, Ui, pos2, vec2};

/// Width of a ruler, logical pixels.
pub const WIDTH: f32 = 18.0;
/// Lines with figures are at least this far apart, logical pixels.
const APART: f32 = 56.0;

/// The distance of lines with figures at a scale, mm: 1, 2 or 5 times a power of ten.
pub fn step_mm(pixels_per_mm: f32) -> f64 {
    let least = f64::from(APART / pixels_per_mm.max(f32::MIN_POSITIVE));
    let power = 10.0_f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0, 10.0].into_iter().map(|k| k * power).find(|&mm| mm >= least).unwrap_or(10.0 * power)
}

/// Multiples of the step in a range, mm.
fn marks(low: f64, high: f64, step: f64) -> impl Iterator<Item = f64> {
    /// More lines than any view has.
    const MOST: i64 = 400;
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    (first..=last.min(first.saturating_add(MOST))).map(move |k| k as f64 * step)
}

/// Lines behind the body.
pub fn grid(ui: &Ui, canvas: &Canvas<'_>) {
    let rect = canvas.rect;
    let painter = ui.painter_at(rect);
    let (low, high) = (canvas.to_body(rect.left_bottom()), canvas.to_body(rect.right_top()));
    let step = step_mm(canvas.camera.scale);
    let ink = ui.visuals().weak_text_color();
    for (part, strength) in [(step / 5.0, 0.10), (step, 0.22)] {
        let stroke = Stroke::new(1.0, ink.gamma_multiply(strength));
        for x in marks(low[0], high[0], part) {
            painter.vline(canvas.to_screen([x, 0.0]).x, rect.y_range(), stroke);
        }
        for y in marks(low[1], high[1], part) {
            painter.hline(rect.x_range(), canvas.to_screen([0.0, y]).y, stroke);
        }
    }
}

/// Figures along the upper and the left side, and where the pointer is.
pub fn show(ui: &Ui, canvas: &Canvas<'_>, pointer: Option<eframe::egui::Pos2>) {
    let rect = canvas.rect;
    let painter = ui.painter_at(rect);
    let (low, high) = (canvas.to_body(rect.left_bottom()), canvas.to_body(rect.right_top()));
    let step = step_mm(canvas.camera.scale);
    let (ink, font) = (ui.visuals().weak_text_color(), FontId::proportional(9.5));
    let upper = Rect::from_min_size(rect.min, vec2(rect.width(), WIDTH));
    let left = Rect::from_min_size(rect.min, vec2(WIDTH, rect.height()));
    for ruler in [upper, left] {
        painter.rect_filled(ruler, 0.0, ui.visuals().window_fill.gamma_multiply(0.92));
    }
    let stroke = Stroke::new(1.0, ink.gamma_multiply(0.7));
    let words = |mm: f64| if step < 1.0 { format!("{mm:.1}") } else { format!("{mm:.0}") };
    for x in marks(low[0], high[0], step) {
        let at = canvas.to_screen([x, 0.0]).x;
        painter.vline(at, rect.top() + WIDTH - 5.0..=rect.top() + WIDTH, stroke);
        painter.text(pos2(at + 2.0, rect.top() + 1.0), Align2::LEFT_TOP, words(x), font.clone(), ink);
    }
    for y in marks(low[1], high[1], step) {
        let at = canvas.to_screen([0.0, y]).y;
        painter.hline(rect.left() + WIDTH - 5.0..=rect.left() + WIDTH, at, stroke);
        painter.text(pos2(rect.left() + 1.0, at - 1.0), Align2::LEFT_BOTTOM, words(y), font.clone(), ink);
    }
    if let Some(p) = pointer.filter(|p| rect.contains(*p)) {
        let stroke = Stroke::new(1.5, ui.visuals().hyperlink_color);
        painter.vline(p.x, rect.top()..=rect.top() + WIDTH, stroke);
        painter.hline(rect.left()..=rect.left() + WIDTH, p.y, stroke);
    }
    painter.rect_filled(Rect::from_min_size(rect.min, vec2(WIDTH, WIDTH)), 0.0, ui.visuals().window_fill);
    painter.text(rect.min + vec2(WIDTH / 2.0, WIDTH / 2.0), Align2::CENTER_CENTER, "mm", font, ink);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_apart_and_round_at_every_scale() {
        for scale in [0.013_f32, 0.1, 0.7, 1.9, 2.0, 13.0, 150.0] {
            let step = step_mm(scale);
            let pixels = step as f32 * scale;
            assert!((APART * 0.99..=APART * 2.6).contains(&pixels), "{scale}: {step}");
            let lead = step / 10.0_f64.powf(step.log10().floor() + 1e-9);
            assert!([1.0, 2.0, 5.0, 10.0].iter().any(|k| (lead - k).abs() < 1e-6), "{step}");
        }
        assert_eq!(marks(-25.0, 21.0, 10.0).collect::<Vec<_>>(), [-20.0, -10.0, 0.0, 10.0, 20.0]);
        assert!(marks(-1e12, 1e12, 1e-3).count() < 1000);
    }
}
