//! Commands that take a tool.

use super::command::{Command, Group, Keys, Place, Scope};
use crate::studio::icons::Icon;
use crate::studio::session::Tool;
use crate::studio::sketching::{Pencil, Sketch};
use eframe::egui::Key;

pub static ALL: [&Command; 8] = [&DRAG, &PIN, &SELECT, &FREEHAND, &POLYGON, &CIRCLE, &CAPSULE, &TRACK];

pub static DRAG: Command = Command {
    icon: Some(Icon::Hand),
    keys: &[Keys::plain(Key::V)],
    scope: Scope::Views,
    places: &[Place::Toolbar(Group::Tools)],
    on: Some(&|session| session.tool == Tool::Drag && !session.sketching().open),
    run: &|session, _| session.tool = Tool::Drag,
    ..Command::new("tool.drag", "Drag tool", "Drag points of the body; every drag makes or moves a target")
};

pub static PIN: Command = Command {
    icon: Some(Icon::Pin),
    keys: &[Keys::plain(Key::P)],
    scope: Scope::Views,
    places: &[Place::Toolbar(Group::Tools)],
    on: Some(&|session| session.tool == Tool::Pin && !session.sketching().open),
    run: &|session, _| session.tool = Tool::Pin,
    ..Command::new("tool.pin", "Pin tool", "Click the body to pin it there, click a pin to remove it")
};

macro_rules! pencil {
    ($name:ident, $pencil:expr, $key:expr, $id:literal, $label:literal, $tip:literal) => {
        pub static $name: Command = Command {
            keys: &[Keys::plain($key)],
            scope: Scope::Outline,
            ends_drawing: true,
            on: Some(&|session| session.sketching().pencil == $pencil),
            run: &|session, _| session.sketch(Sketch::Take($pencil)),
            ..Command::new($id, $label, $tip)
        };
    };
}

pencil!(SELECT, Pencil::Select, Key::V, "tool.select", "Select", "Pick parts out, move them and their points");
pencil!(
    FREEHAND,
    Pencil::Sketch,
    Key::S,
    "tool.freehand",
    "Sketch",
    "Draw a line around with the mouse; it becomes a curve with few points"
);
pencil!(
    POLYGON,
    Pencil::Polygon,
    Key::P,
    "tool.polygon",
    "Polygon",
    "Click the corners; Enter or a click on the first one closes it"
);
pencil!(CIRCLE, Pencil::Circle, Key::C, "tool.circle", "Circle", "Drag from the middle");
pencil!(CAPSULE, Pencil::Capsule, Key::L, "tool.capsule", "Capsule", "A limb: drag from one end to the other");
pencil!(
    TRACK,
    Pencil::Track,
    Key::R,
    "tool.track",
    "Tendon track",
    "A line inside the body along which mesh edges run, for tendons to follow: click its points; a double click or Enter ends it"
);
