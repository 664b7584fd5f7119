//! A capsule, from one end to the other: a limb.

use super::parts::{CLICKED, Span, Spanned};
use super::tool::Entry;
use crate::outline::drawing::Primitive;
use crate::studio::commands::command::{Keys, Scope};
use eframe::egui::Key;

pub static ENTRY: Entry = Entry {
    id: "tool.capsule",
    label: "Capsule",
    tip: "A limb: drag from one end to the other",
    icon: None,
    keys: &[Keys::plain(Key::L)],
    canvas: Scope::Outline,
    hint: "drag from one end to the other",
    make: || Box::new(Spanned::new(capsule)),
};

fn capsule((from, to): Span, mm_per_pixel: f64) -> Primitive {
    Primitive::Capsule { ends: [from, to], radii: [CLICKED * mm_per_pixel; 2] }
}
