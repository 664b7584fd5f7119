//! The pins: where the body is held.

use super::layer::Layer;
use super::marks::{self, disc};
use super::subject::Subject;
use crate::outline::Point;
use crate::picture::palette::{Palette, Theme};
use crate::picture::scene::Item;

/// A disc on every pinned point of the body.
#[derive(Debug, PartialEq)]
pub struct Pins {
    /// Places of the pinned points now, mm.
    at: Vec<Point>,
    theme: Theme,
}

impl Layer for Pins {
    const NAME: &'static str = "pins";

    fn of(subject: &Subject<'_>) -> Option<Self> {
        let mesh = &subject.design.mesh;
        let known = subject.design.pins.iter().filter(|pin| pin.at.triangle < mesh.triangles.len());
        let at = known.map(|pin| mesh.position(&pin.at, &subject.shape.nodes)).collect();
        Some(Self { at, theme: subject.theme })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        let palette = Palette::of(self.theme);
        for &at in &self.at {
            items.push(disc(at, marks::PIN, palette.pin, Some((1.5, palette.pin_stroke))));
            items.push(disc(at, 1.8, palette.pin_stroke, None));
        }
    }
}
