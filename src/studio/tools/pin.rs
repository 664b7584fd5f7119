//! Pins the body where it is clicked, and takes pins out. Targets can be dragged with it too.

use super::grip::Grip;
use super::tool::{Entry, Tool};
use crate::outline::Point;
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::{Canvas, Hit};
use crate::studio::change::Change;
use crate::studio::commands::command::{Keys, Scope};
use crate::studio::icons::Icon;
use crate::studio::session::{Selection, Session};
use eframe::egui::{CursorIcon, Key};

pub static ENTRY: Entry = Entry {
    id: "tool.pin",
    label: "Pin tool",
    tip: "Click the body to pin it there, click a pin to remove it",
    icon: Some(Icon::Pin),
    keys: &[Keys::plain(Key::P)],
    canvas: Scope::Views,
    hint: "Click the body to pin it, click a pin to remove it",
    make: || Box::new(Pin::default()),
};

#[derive(Default)]
struct Pin {
    grip: Grip,
}

impl Tool for Pin {
    fn press(&mut self, canvas: &Canvas<'_>, at: Point, actions: &mut Actions) {
        self.grip = Grip::take(canvas, at, false, actions);
    }

    fn drag(&mut self, canvas: &Canvas<'_>, way: &[Point], actions: &mut Actions) {
        if let Some(&at) = way.last() {
            self.grip.pull(canvas, at, actions);
        }
    }

    fn release(&mut self, _canvas: &Canvas<'_>, _at: Option<Point>, _actions: &mut Actions) {
        self.grip = Grip::Nothing;
    }

    fn click(&mut self, canvas: &Canvas<'_>, at: Point, _twice: bool, actions: &mut Actions) {
        actions.push(match canvas.hit(at) {
            Hit::Body(at) => Action::Change(Change::AddPin(at)),
            Hit::Pin(index) => Action::Change(Change::RemovePin(index)),
            Hit::Target(index) => Action::Select(Selection::Target(index)),
            Hit::Nothing => Action::Select(Selection::Nothing),
        });
    }

    fn key(&mut self, _session: &Session, key: Key, _actions: &mut Actions) -> bool {
        if key == Key::Escape {
            self.grip = Grip::Nothing;
        }
        false
    }

    fn cursor(&self, _canvas: &Canvas<'_>, under: Hit) -> CursorIcon {
        match (self.grip, under) {
            (Grip::Target { .. }, _) => CursorIcon::Grabbing,
            (_, Hit::Body(_)) => CursorIcon::Crosshair,
            (_, Hit::Nothing) => CursorIcon::Default,
            _ => CursorIcon::Grab,
        }
    }
}
