//! A circle, from its middle.

use super::parts::{CLICKED, LEAST, Span, Spanned};
use super::tool::Entry;
use crate::outline::drawing::Primitive;
use crate::outline::polygon;
use crate::studio::commands::command::{Keys, Scope};
use eframe::egui::Key;

pub static ENTRY: Entry = Entry {
    id: "tool.circle",
    label: "Circle",
    tip: "Drag from the middle",
    icon: None,
    keys: &[Keys::plain(Key::C)],
    canvas: Scope::Outline,
    hint: "drag from the middle",
    make: || Box::new(Spanned::new(circle)),
};

fn circle((center, to): Span, mm_per_pixel: f64) -> Primitive {
    let length = polygon::length(center, to);
    let clicked = length < LEAST * mm_per_pixel;
    Primitive::Circle { center, radius: if clicked { CLICKED * mm_per_pixel } else { length } }
}
