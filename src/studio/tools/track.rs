//! A line inside the body for tendons to run along, point by point.

use super::parts::{self, REACH};
use super::tool::{Drawn, Entry, Tool};
use crate::outline::drawing::Item;
use crate::outline::{Point, polygon};
use crate::studio::action::Actions;
use crate::studio::canvas::{Canvas, Hit};
use crate::studio::commands::command::{Keys, Scope};
use crate::studio::language::{mark, t};
use crate::studio::session::Session;
use eframe::egui::{CursorIcon, Key, Painter, Pos2, Shape, Stroke};

pub static ENTRY: Entry = Entry {
    id: "tool.track",
    label: "Tendon track",
    tip: "A line inside the body along which mesh edges run, for tendons to follow: click its points; a double click or Enter ends it",
    icon: None,
    keys: &[Keys::plain(Key::R)],
    canvas: Scope::Outline,
    hint: "click the points of a line inside the body; tendons can run along it",
    make: || Box::new(Track::default()),
};

#[derive(Default)]
struct Track {
    points: Vec<Point>,
}

impl Track {
    /// Ends it, if there are points enough.
    fn end(&mut self, session: &Session, actions: &mut Actions) {
        if let Some(drawn) = self.pending(session, 1.0) {
            actions.extend(drawn.actions());
            self.points.clear();
        }
    }
}

impl Tool for Track {
    /// A drag is a click that was not held still.
    fn release(&mut self, canvas: &Canvas<'_>, at: Option<Point>, actions: &mut Actions) {
        if let Some(at) = at {
            self.click(canvas, at, false, actions);
        }
    }

    fn click(&mut self, canvas: &Canvas<'_>, at: Point, _twice: bool, actions: &mut Actions) {
        // The second click of a double click falls on the last point, which ends it.
        let reach = REACH * canvas.mm_per_pixel();
        if self.points.last().is_some_and(|&last| polygon::length(last, at) <= reach) {
            self.end(canvas.session, actions);
        } else {
            self.points.push(at);
        }
    }

    fn key(&mut self, session: &Session, key: Key, actions: &mut Actions) -> bool {
        match key {
            Key::Enter if self.waits() => {
                self.end(session, actions);
                true
            }
            Key::Escape => !std::mem::take(&mut self.points).is_empty(),
            _ => false,
        }
    }

    fn pending(&self, session: &Session, _mm_per_pixel: f64) -> Option<Drawn> {
        if self.points.len() < 2 {
            return None;
        }
        let mut drawing = session.drawing().clone();
        drawing.tracks.push(self.points.clone());
        let new = Item::Track(drawing.tracks.len() - 1);
        Some(Drawn { what: mark("Draw a track"), drawing, new })
    }

    fn waits(&self) -> bool {
        !self.points.is_empty()
    }

    fn hint(&self, _session: &Session) -> Option<&'static str> {
        self.waits().then_some(t("click the last point again, or press Enter, to end it; Escape drops it"))
    }

    fn cursor(&self, _canvas: &Canvas<'_>, _under: Hit) -> CursorIcon {
        CursorIcon::Crosshair
    }

    fn paint(&self, canvas: &Canvas<'_>, painter: &Painter, pointer: Option<Pos2>) {
        let color = parts::thread(canvas);
        let points = self.points.iter().map(|&p| canvas.to_screen(p));
        let line = points.clone().chain(pointer.filter(|_| self.waits())).collect();
        painter.add(Shape::line(line, Stroke::new(2.0, color)));
        for p in points {
            painter.circle_filled(p, 3.5, color);
        }
    }
}
