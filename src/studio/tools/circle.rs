//! A circle, from its middle.

use super::parts::{self, CLICKED, LEAST, Span};
use super::tool::{Drawn, Entry, Tool};
use crate::outline::drawing::Primitive;
use crate::outline::{Point, polygon};
use crate::studio::action::Actions;
use crate::studio::canvas::{Canvas, Hit};
use crate::studio::commands::command::{Keys, Scope};
use crate::studio::session::Session;
use eframe::egui::{CursorIcon, Key, Painter, Pos2};

pub static ENTRY: Entry = Entry {
    id: "tool.circle",
    label: "Circle",
    tip: "Drag from the middle",
    icon: None,
    keys: &[Keys::plain(Key::C)],
    canvas: Scope::Outline,
    hint: "drag from the middle",
    make: || Box::new(Circle::default()),
};

#[derive(Default)]
struct Circle {
    span: Option<Span>,
}

impl Circle {
    fn primitive(&self, mm_per_pixel: f64) -> Option<Primitive> {
        let (center, to) = self.span?;
        let length = polygon::length(center, to);
        let clicked = length < LEAST * mm_per_pixel;
        Some(Primitive::Circle { center, radius: if clicked { CLICKED * mm_per_pixel } else { length } })
    }
}

impl Tool for Circle {
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
        Some(parts::with(session, self.primitive(mm_per_pixel)?))
    }

    fn cursor(&self, _canvas: &Canvas<'_>, _under: Hit) -> CursorIcon {
        CursorIcon::Crosshair
    }

    fn paint(&self, canvas: &Canvas<'_>, painter: &Painter, _pointer: Option<Pos2>) {
        if let Some(primitive) = self.primitive(canvas.mm_per_pixel()) {
            parts::paint(canvas, painter, &primitive);
        }
    }
}
