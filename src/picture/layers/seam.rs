//! The seam: the edge of the felt.

use super::layer::{Layer, Shared};
use super::marks;
use super::subject::Subject;
use crate::design::Design;
use crate::engine::Shape;
use crate::picture::palette::{Palette, Theme};
use crate::picture::scene::Item;

/// A line along the boundary of the body.
#[derive(Debug, PartialEq)]
pub struct Seam {
    design: Shared<Design>,
    shape: Shared<Shape>,
    theme: Theme,
}

impl Layer for Seam {
    const NAME: &'static str = "seam";

    fn of(subject: &Subject<'_>) -> Option<Self> {
        let (design, shape) = (Shared::of(subject.design), Shared::of(subject.shape));
        Some(Self { design, shape, theme: subject.theme })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        let color = Palette::of(self.theme).seam;
        for ring in self.design.mesh.boundary() {
            let points = ring.iter().map(|&n| self.shape.nodes[n]).collect();
            items.push(Item::Line { points, width: marks::SEAM, color, closed: true });
        }
    }
}
