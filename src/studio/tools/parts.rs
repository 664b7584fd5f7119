//! What the tools that draw parts have in common.

use super::tool::{Drawn, Tool};
use crate::outline::Point;
use crate::outline::drawing::{Item, Part, Primitive};
use crate::picture::palette::Palette;
use crate::studio::action::Actions;
use crate::studio::canvas::{Canvas, Hit, closed};
use crate::studio::language::mark;
use crate::studio::session::Session;
use crate::studio::style;
use eframe::egui::{Color32, CursorIcon, Key, Painter, Pos2, Stroke};

/// How near to a point a click counts as on it, logical pixels.
pub const REACH: f64 = 9.0;
/// Least radius of what is drawn, logical pixels.
pub const LEAST: f64 = 3.0;
/// Radius of a circle or capsule that was clicked and not dragged, logical pixels.
pub const CLICKED: f64 = 30.0;

/// A part of a drawing under the hand, from where it was begun to where the pointer is.
pub type Span = (Point, Point);

/// A tool that draws a part from where the hand takes hold to where it lets go.
pub struct Spanned {
    /// The part, and how many mm a logical pixel is.
    part: fn(Span, f64) -> Primitive,
    span: Option<Span>,
}

impl Spanned {
    pub fn new(part: fn(Span, f64) -> Primitive) -> Self {
        Self { part, span: None }
    }

    fn primitive(&self, mm_per_pixel: f64) -> Option<Primitive> {
        self.span.map(|span| (self.part)(span, mm_per_pixel))
    }
}

impl Tool for Spanned {
    fn press(&mut self, _canvas: &Canvas<'_>, at: Point, _actions: &mut Actions) {
        self.span = Some((at, at));
    }

    fn drag(&mut self, _canvas: &Canvas<'_>, way: &[Point], _actions: &mut Actions) {
        if let (Some((_, to)), Some(&at)) = (&mut self.span, way.last()) {
            *to = at;
        }
    }

    fn release(&mut self, canvas: &Canvas<'_>, _at: Option<Point>, actions: &mut Actions) {
        actions.extend(self.pending(canvas.session, canvas.mm_per_pixel()).into_iter().flat_map(Drawn::actions));
        self.span = None;
    }

    fn click(&mut self, canvas: &Canvas<'_>, at: Point, _twice: bool, actions: &mut Actions) {
        self.span = Some((at, at));
        self.release(canvas, Some(at), actions);
    }

    fn key(&mut self, _session: &Session, key: Key, _actions: &mut Actions) -> bool {
        key == Key::Escape && self.span.take().is_some()
    }

    fn pending(&self, session: &Session, mm_per_pixel: f64) -> Option<Drawn> {
        Some(with(session, self.primitive(mm_per_pixel)?))
    }

    fn is_drawing(&self) -> bool {
        self.span.is_some()
    }

    fn cursor(&self, _canvas: &Canvas<'_>, _under: Hit) -> CursorIcon {
        CursorIcon::Crosshair
    }

    fn paint(&self, canvas: &Canvas<'_>, painter: &Painter, _pointer: Option<Pos2>) {
        if let Some(primitive) = self.primitive(canvas.mm_per_pixel()) {
            closed(painter, canvas, &primitive.polygon(), stroke(canvas));
        }
    }
}

/// The drawing with one more part, joined to the others or cut out of them.
pub fn with(session: &Session, primitive: Primitive) -> Drawn {
    let cut = session.sketching().cut;
    let what = match (&primitive, cut) {
        (_, true) => mark("Cut out a part"),
        (Primitive::Circle { .. }, _) => mark("Draw a circle"),
        (Primitive::Capsule { .. }, _) => mark("Draw a capsule"),
        (Primitive::Path { .. }, _) => mark("Draw a path"),
    };
    let mut drawing = session.drawing().clone();
    drawing.parts.push(Part { primitive, cut });
    let new = Item::Part(drawing.parts.len() - 1);
    Drawn { what, drawing, new }
}

/// Of parts that are being drawn.
pub fn stroke(canvas: &Canvas<'_>) -> Stroke {
    Stroke::new(2.0, style::accent(canvas.session.look().theme))
}

/// The colour of tracks.
pub fn thread(canvas: &Canvas<'_>) -> Color32 {
    style::color32(Palette::of(canvas.session.look().theme).track)
}
