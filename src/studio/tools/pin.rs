//! Pins the body where it is clicked, and takes pins out. Targets can be dragged with it too.

use super::grip::Gripping;
use super::tool::Entry;
use crate::studio::action::Action;
use crate::studio::canvas::Hit;
use crate::studio::change::Change;
use crate::studio::commands::command::{Keys, Scope};
use crate::studio::icons::Icon;
use crate::studio::language::mark;
use crate::studio::session::Selection;
use eframe::egui::{CursorIcon, Key};

pub static ENTRY: Entry = Entry {
    id: "tool.pin",
    label: "Pin tool",
    tip: "Click the body to pin it there, click a pin to remove it",
    icon: Some(Icon::Pin),
    keys: &[Keys::plain(Key::P)],
    canvas: Scope::Views,
    hint: "Click the body to pin it, click a pin to remove it",
    make: || Box::new(Gripping::new(false, CursorIcon::Crosshair, pin, foretells)),
};

fn foretells(under: Hit) -> Option<&'static str> {
    Some(match under {
        Hit::Target(_) => mark("Drag moves the goal of this target, a click selects it"),
        Hit::Pin(_) => mark("Click takes this pin out, drag puts it elsewhere on the body"),
        Hit::Body(_) => mark("Click pins the body here"),
        Hit::Part(_) | Hit::Nothing => return None,
    })
}

fn pin(under: Hit) -> Action {
    match under {
        Hit::Body(at) => Action::Change(Change::AddPin(at)),
        Hit::Pin(index) => Action::Change(Change::RemovePin(index)),
        Hit::Target(index) => Action::Select(Selection::Target(index)),
        Hit::Part(part) => Action::Select(Selection::Part(part)),
        Hit::Nothing => Action::Select(Selection::Nothing),
    }
}
