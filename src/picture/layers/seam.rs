//! The seam: the edge of the felt.

use super::layer::{Layer, Shared};
use super::looks::Plush;
use super::marks;
use super::subject::Subject;
use crate::engine::Shape;
use crate::picture::palette::{Palette, Theme};
use crate::picture::scene::Item;
use crate::picture::silhouette::Silhouette;

/// A line along the drawn silhouette.
#[derive(Debug, PartialEq)]
pub struct Seam {
    silhouette: Shared<Silhouette>,
    shape: Shared<Shape>,
    width: f32,
    theme: Theme,
}

impl Layer for Seam {
    const NAME: &'static str = "seam";

    fn of(subject: &Subject<'_>) -> Option<Self> {
        let (silhouette, shape) = (Shared::of(&subject.silhouette), Shared::of(subject.shape));
        let width = if subject.look == Plush::NAME { marks::SEWN } else { marks::SEAM };
        Some(Self { silhouette, shape, width, theme: subject.theme })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        let color = Palette::of(self.theme).seam;
        let Some(places) = self.silhouette.places(&self.shape.nodes) else { return };
        for points in self.silhouette.lines(&places) {
            items.push(Item::Line { points, width: self.width, color, closed: true });
        }
    }
}
