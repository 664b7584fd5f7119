//! A line around, as the hand draws it; it becomes a curve with few points.

use super::parts;
use super::tool::{Drawn, Entry, Tool};
use crate::outline::drawing::Primitive;
use crate::outline::{Point, polygon};
use crate::studio::action::Actions;
use crate::studio::canvas::{Canvas, Hit, open};
use crate::studio::commands::command::{Keys, Scope};
use crate::studio::session::FREEHAND;
use crate::studio::session::Session;
use eframe::egui::{CursorIcon, Key, Painter, Pos2, Shape};

/// Distance between the points of the line, and how far its path may stray from it, logical pixels.
const STEP: f64 = 2.0;
const STRAY: f64 = 2.0;

pub static ENTRY: Entry = Entry {
    id: FREEHAND,
    label: "Sketch",
    tip: "Draw a line around with the mouse; it becomes a curve with few points",
    icon: None,
    keys: &[Keys::plain(Key::S)],
    canvas: Scope::Outline,
    hint: "draw a line around; its ends are joined",
    make: || Box::new(Freehand::default()),
};

#[derive(Default)]
struct Freehand {
    /// Nothing while it is not drawn.
    line: Vec<Point>,
}

impl Tool for Freehand {
    fn press(&mut self, _canvas: &Canvas<'_>, at: Point, _actions: &mut Actions) {
        self.line = vec![at];
    }

    fn drag(&mut self, canvas: &Canvas<'_>, way: &[Point], _actions: &mut Actions) {
        let step = STEP * canvas.mm_per_pixel();
        for &p in way {
            if self.line.last().is_some_and(|&last| polygon::length(last, p) >= step) {
                self.line.push(p);
            }
        }
    }

    fn release(&mut self, canvas: &Canvas<'_>, _at: Option<Point>, actions: &mut Actions) {
        actions.extend(self.pending(canvas.session, canvas.mm_per_pixel()).into_iter().flat_map(Drawn::actions));
        self.line.clear();
    }

    fn key(&mut self, _session: &Session, key: Key, _actions: &mut Actions) -> bool {
        key == Key::Escape && !std::mem::take(&mut self.line).is_empty()
    }

    fn pending(&self, session: &Session, mm_per_pixel: f64) -> Option<Drawn> {
        Some(parts::with(session, Primitive::along(&self.line, STRAY * mm_per_pixel)?))
    }

    fn is_drawing(&self) -> bool {
        !self.line.is_empty()
    }

    fn cursor(&self, _canvas: &Canvas<'_>, _under: Hit) -> CursorIcon {
        CursorIcon::Crosshair
    }

    fn paint(&self, canvas: &Canvas<'_>, painter: &Painter, _pointer: Option<Pos2>) {
        let stroke = parts::stroke(canvas);
        open(painter, canvas, &self.line, stroke);
        if let [first, .., last] = self.line.as_slice() {
            let ends = [canvas.to_screen(*last), canvas.to_screen(*first)];
            painter.extend(Shape::dashed_line(&ends, stroke, 4.0, 4.0));
        }
    }
}
