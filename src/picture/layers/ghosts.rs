//! Ghosts: outlines of the same plushie in other states, over what is shown: neighbouring keyframes, the other plushie.

use super::layer::{Layer, Shared};
use super::subject::Subject;
use crate::engine::Shape;
use crate::picture::color::Color;
use crate::picture::palette::with_alpha;
use crate::picture::scene::Item;
use crate::picture::silhouette::Silhouette;

/// Outlines over the body.
#[derive(Debug, PartialEq)]
pub struct Ghosts {
    silhouette: Shared<Silhouette>,
    ghosts: Vec<(Shared<Shape>, Color)>,
}

/// Width of an outline, logical pixels, and its strength, of 255.
const LINE: f32 = 2.0;
const STRONG: u8 = 210;

impl Layer for Ghosts {
    const NAME: &'static str = "ghosts";

    fn of(subject: &Subject<'_>) -> Option<Self> {
        let drawn = !subject.ghosts.is_empty();
        drawn.then(|| Self {
            silhouette: Shared::of(&subject.silhouette),
            ghosts: subject.ghosts.iter().map(|ghost| (Shared::of(&ghost.shape), ghost.color)).collect(),
        })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        for (shape, color) in &self.ghosts {
            let Some(points) = self.silhouette.places(&shape.nodes) else { continue };
            let lines = self.silhouette.lines(&points);
            let color = with_alpha(*color, STRONG);
            items.extend(lines.into_iter().map(|points| Item::Line { points, width: LINE, color, closed: true }));
        }
    }
}
