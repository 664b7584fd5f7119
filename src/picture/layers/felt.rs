//! The felt: all triangles in one colour.

use super::layer::{Layer, Shared};
use super::subject::Subject;
use crate::design::Design;
use crate::engine::Shape;
use crate::picture::palette::{Palette, Theme};
use crate::picture::scene::Item;

/// The body, seen through where its texture is clear.
#[derive(Debug, PartialEq)]
pub struct Felt {
    design: Shared<Design>,
    shape: Shared<Shape>,
    theme: Theme,
}

impl Layer for Felt {
    const NAME: &'static str = "felt";

    fn of(subject: &Subject<'_>) -> Option<Self> {
        let (design, shape) = (Shared::of(subject.design), Shared::of(subject.shape));
        Some(Self { design, shape, theme: subject.theme })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        let (points, triangles) = (self.shape.nodes.clone(), self.design.mesh.triangles.clone());
        items.push(Item::Mesh { points, triangles, color: Palette::of(self.theme).body });
    }
}
