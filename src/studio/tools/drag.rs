//! Drags points of the body: each drag makes or moves a target, and is one undo step.

use super::grip::Gripping;
use super::tool::Entry;
use crate::studio::action::Action;
use crate::studio::canvas::Hit;
use crate::studio::commands::command::{Keys, Scope};
use crate::studio::icons::Icon;
use crate::studio::language::mark;
use crate::studio::session::Selection;
use eframe::egui::{CursorIcon, Key};

pub static ENTRY: Entry = Entry {
    id: "tool.drag",
    label: "Drag tool",
    tip: "Drag points of the body; every drag makes or moves a target",
    icon: Some(Icon::Hand),
    keys: &[Keys::plain(Key::V)],
    canvas: Scope::Views,
    hint: "Drag the body to pose it. Right-click for pins and targets",
    make: || Box::new(Gripping::new(true, CursorIcon::Grab, pick_out, foretells)),
};

fn foretells(under: Hit) -> Option<&'static str> {
    Some(match under {
        Hit::Target(_) => {
            mark("Drag moves the goal of this target; click selects it, then Delete removes it. Right-click has more")
        }
        Hit::Pin(_) => mark(
            "Drag moves this pin and what it holds; click selects it, then Delete removes it. Right-click has more",
        ),
        Hit::Body(_) | Hit::Part(_) | Hit::Nothing => return None,
    })
}

fn pick_out(under: Hit) -> Action {
    Action::Select(match under {
        Hit::Target(index) => Selection::Target(index),
        Hit::Pin(index) => Selection::Pin(index),
        Hit::Part(part) => Selection::Part(part),
        Hit::Body(_) | Hit::Nothing => Selection::Nothing,
    })
}
