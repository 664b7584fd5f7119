//! What the tools that draw parts have in common.

use super::tool::Drawn;
use crate::outline::Point;
use crate::outline::drawing::{Item, Part, Primitive};
use crate::picture::palette::Palette;
use crate::studio::canvas::{Canvas, closed};
use crate::studio::session::Session;
use crate::studio::style;
use eframe::egui::{Color32, Painter, Stroke};

/// How near to a point a click counts as on it, logical pixels.
pub const REACH: f64 = 9.0;
/// Least radius of what is drawn, logical pixels.
pub const LEAST: f64 = 3.0;
/// Radius of a circle or capsule that was clicked and not dragged, logical pixels.
pub const CLICKED: f64 = 30.0;

/// A part of a drawing under the hand, from where it was begun to where the pointer is.
pub type Span = (Point, Point);

/// The drawing with one more part, joined to the others or cut out of them.
pub fn with(session: &Session, primitive: Primitive) -> Drawn {
    let cut = session.sketching().cut;
    let what = match (&primitive, cut) {
        (_, true) => "Cut out a part",
        (Primitive::Circle { .. }, _) => "Draw a circle",
        (Primitive::Capsule { .. }, _) => "Draw a capsule",
        (Primitive::Path { .. }, _) => "Draw a path",
    };
    let mut drawing = session.drawing().clone();
    drawing.parts.push(Part { primitive, cut });
    let new = Item::Part(drawing.parts.len() - 1);
    Drawn { what, drawing, new }
}

/// Shows a part that is not there yet.
pub fn paint(canvas: &Canvas<'_>, painter: &Painter, primitive: &Primitive) {
    closed(painter, canvas, &primitive.polygon(), stroke(canvas));
}

/// Of parts that are being drawn.
pub fn stroke(canvas: &Canvas<'_>) -> Stroke {
    Stroke::new(2.0, style::accent(canvas.session.look().theme))
}

/// The colour of tracks.
pub fn thread(canvas: &Canvas<'_>) -> Color32 {
    style::color32(Palette::of(canvas.session.look().theme).track)
}
