//! A polygon, corner by corner.

use super::parts::{self, REACH};
use super::tool::{Drawn, Entry, Tool};
use crate::outline::drawing::{PathPoint, Primitive};
use crate::outline::{Point, polygon};
use crate::studio::action::Actions;
use crate::studio::canvas::{Canvas, HANDLE, Hit};
use crate::studio::commands::command::{Keys, Scope};
use crate::studio::language::t;
use crate::studio::session::Session;
use eframe::egui::{CursorIcon, Key, Painter, Pos2, Shape};

pub static ENTRY: Entry = Entry {
    id: "tool.polygon",
    label: "Polygon",
    tip: "Click the corners; Enter or a click on the first one closes it",
    icon: None,
    keys: &[Keys::plain(Key::P)],
    canvas: Scope::Outline,
    hint: "click the corners",
    make: || Box::new(Polygon::default()),
};

#[derive(Default)]
struct Polygon {
    corners: Vec<Point>,
}

impl Polygon {
    /// Closes it, if there are corners enough.
    fn close(&mut self, session: &Session, actions: &mut Actions) {
        if let Some(drawn) = self.pending(session, 1.0) {
            actions.extend(drawn.actions());
            self.corners.clear();
        }
    }
}

impl Tool for Polygon {
    /// A drag is a click that was not held still.
    fn release(&mut self, canvas: &Canvas<'_>, at: Option<Point>, actions: &mut Actions) {
        if let Some(at) = at {
            self.click(canvas, at, false, actions);
        }
    }

    fn click(&mut self, canvas: &Canvas<'_>, at: Point, twice: bool, actions: &mut Actions) {
        let near = |p: &Point, reach: f64| polygon::length(*p, at) <= reach * canvas.mm_per_pixel();
        let closes = self.corners.len() >= 3 && self.corners.first().is_some_and(|first| near(first, REACH));
        if !closes && !self.corners.last().is_some_and(|last| near(last, 1.0)) {
            self.corners.push(at);
        }
        if closes || twice {
            self.close(canvas.session, actions);
        }
    }

    fn key(&mut self, session: &Session, key: Key, actions: &mut Actions) -> bool {
        match key {
            Key::Enter if self.waits() => {
                self.close(session, actions);
                true
            }
            Key::Escape => !std::mem::take(&mut self.corners).is_empty(),
            _ => false,
        }
    }

    fn pending(&self, session: &Session, _mm_per_pixel: f64) -> Option<Drawn> {
        if self.corners.len() < 3 {
            return None;
        }
        let points = self.corners.iter().map(|&at| PathPoint { at, corner: true }).collect();
        Some(parts::with(session, Primitive::Path { points }))
    }

    fn waits(&self) -> bool {
        !self.corners.is_empty()
    }

    fn hint(&self, _session: &Session) -> Option<&'static str> {
        self.waits().then_some(t("click the first corner, or press Enter, to close it"))
    }

    fn cursor(&self, _canvas: &Canvas<'_>, _under: Hit) -> CursorIcon {
        CursorIcon::Crosshair
    }

    fn paint(&self, canvas: &Canvas<'_>, painter: &Painter, pointer: Option<Pos2>) {
        let stroke = parts::stroke(canvas);
        let corners = self.corners.iter().map(|&p| canvas.to_screen(p));
        painter.add(Shape::line(corners.clone().chain(pointer.filter(|_| self.waits())).collect(), stroke));
        for (k, p) in corners.enumerate() {
            painter.circle_filled(p, if k == 0 { HANDLE + 1.0 } else { 3.0 }, stroke.color);
        }
    }
}
