//! Drags points of the body: each drag makes or moves a target, and is one undo step.

use super::grip::Grip;
use super::tool::{Entry, Tool};
use crate::outline::Point;
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::{Canvas, Hit};
use crate::studio::commands::command::{Keys, Scope};
use crate::studio::icons::Icon;
use crate::studio::session::{Selection, Session};
use eframe::egui::{CursorIcon, Key};

pub static ENTRY: Entry = Entry {
    id: "tool.drag",
    label: "Drag tool",
    tip: "Drag points of the body; every drag makes or moves a target",
    icon: Some(Icon::Hand),
    keys: &[Keys::plain(Key::V)],
    canvas: Scope::Views,
    hint: "Drag the body to pose it. Right-click for pins and targets",
    make: || Box::new(Drag::default()),
};

#[derive(Default)]
struct Drag {
    grip: Grip,
}

impl Tool for Drag {
    fn press(&mut self, canvas: &Canvas<'_>, at: Point, actions: &mut Actions) {
        self.grip = Grip::take(canvas, at, true, actions);
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
        actions.push(Action::Select(match canvas.hit(at) {
            Hit::Target(index) => Selection::Target(index),
            Hit::Pin(index) => Selection::Pin(index),
            Hit::Body(_) | Hit::Nothing => Selection::Nothing,
        }));
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
            (_, Hit::Nothing) => CursorIcon::Default,
            _ => CursorIcon::Grab,
        }
    }
}
