//! The pins: where the body is held.

use super::layer::Layer;
use super::marks::{self, disc};
use super::subject::Subject;
use crate::design::Hold;
use crate::outline::Point;
use crate::picture::color::Color;
use crate::picture::palette::{Palette, Theme};
use crate::picture::scene::Item;
use std::f64::consts::TAU;

/// A disc on every pinned point of the body, with the line that it slides along or the ring of what it holds.
#[derive(Debug, PartialEq)]
pub struct Pins {
    /// Places of the pinned points now, mm, and how they are held.
    at: Vec<(Point, Hold)>,
    /// Half a line that a pin slides along, mm.
    way_mm: f64,
    theme: Theme,
}

/// Half a line that a pin slides along, as a part of the body length.
const WAY: f64 = 0.06;
/// Corners of a ring.
const CORNERS: usize = 48;

impl Layer for Pins {
    const NAME: &'static str = "pins";

    fn of(subject: &Subject<'_>) -> Option<Self> {
        let mesh = &subject.design.mesh;
        let known = subject.design.pins.iter().filter(|pin| pin.at.triangle < mesh.triangles.len());
        let at = known.map(|pin| (mesh.position(&pin.at, &subject.shape.nodes), pin.hold)).collect();
        Some(Self { at, way_mm: WAY * mesh.body_length(), theme: subject.theme })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        let palette = Palette::of(self.theme);
        for &(at, hold) in &self.at {
            items.extend(kind(at, hold, self.way_mm, palette.pin));
            items.push(disc(at, marks::PIN, palette.pin, Some((1.5, palette.pin_stroke))));
            items.push(disc(at, 1.8, palette.pin_stroke, None));
        }
    }
}

/// The line that a pin slides along, or the ring around what it holds.
fn kind(at: Point, hold: Hold, way_mm: f64, color: Color) -> Option<Item> {
    let about = |radius: f64, angle: f64| [at[0] + radius * angle.cos(), at[1] + radius * angle.sin()];
    let points = match hold {
        Hold::Point => return None,
        Hold::Line { degrees } => [way_mm, -way_mm].map(|way| about(way, degrees.to_radians())).to_vec(),
        Hold::Region { radius_mm, .. } => {
            (0..=CORNERS).map(|k| about(radius_mm, TAU * k as f64 / CORNERS as f64)).collect()
        }
    };
    Some(Item::Line { points, color, width: 1.5, closed: false })
}
