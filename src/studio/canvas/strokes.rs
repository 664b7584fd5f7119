//! Lines of a drawing on the screen.

use super::ground::{Canvas, Ground};
use crate::outline::Point;
use eframe::egui::{Color32, Painter, Shape, Stroke};

/// Radius of a handle, logical pixels.
pub const HANDLE: f32 = 4.5;

pub fn closed(painter: &Painter, canvas: &Canvas<'_>, points: &[Point], stroke: Stroke) {
    painter.add(Shape::closed_line(points.iter().map(|&p| canvas.to_screen(p)).collect(), stroke));
}

pub fn open(painter: &Painter, canvas: &Canvas<'_>, points: &[Point], stroke: Stroke) {
    painter.add(Shape::line(points.iter().map(|&p| canvas.to_screen(p)).collect(), stroke));
}

/// A thread with a knot at either end, so that it is no outline to the eye; thin and dashed where it leaves the body.
pub fn track(painter: &Painter, canvas: &Canvas<'_>, index: usize, color: Color32, width: f32) {
    let Some(points) = canvas.session.drawing().tracks.get(index) else { return };
    for &end in points.first().into_iter().chain(points.last()) {
        painter.circle_filled(canvas.to_screen(end), width + 1.5, color);
    }
    let Ground::Outline(surface) = canvas.ground else { return };
    for stretch in surface.tracks.get(index).into_iter().flatten() {
        let ends = stretch.ends.map(|p| canvas.to_screen(p));
        if stretch.inside {
            painter.line_segment(ends, Stroke::new(width, color));
        } else {
            painter.extend(Shape::dashed_line(&ends, Stroke::new(0.6 * width, color), 3.0, 4.0));
        }
    }
}
