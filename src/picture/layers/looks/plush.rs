//! Plush: stuffed felt in soft light, with its grain and texture.

use crate::engine::Shape;
use crate::outline::Point;
use crate::picture::layers::layer::{Layer, Shared};
use crate::picture::layers::look::Look;
use crate::picture::layers::subject::Subject;
use crate::picture::layers::texture::Textured;
use crate::picture::palette::{Palette, Theme};
use crate::picture::plush::Felt;
use crate::picture::scene::Item;
use crate::picture::silhouette::Silhouette;
use crate::picture::texture::Texture;
use std::sync::Arc;

/// The body as it would be made.
#[derive(Debug, PartialEq)]
pub struct Plush {
    silhouette: Shared<Silhouette>,
    shape: Shared<Shape>,
    /// With its lower left and upper right corner, mm.
    texture: Option<(Shared<Texture>, [Point; 2])>,
    theme: Theme,
}

impl Layer for Plush {
    const NAME: &'static str = "plush";

    fn of(subject: &Subject<'_>) -> Option<Self> {
        let texture = subject.texture.filter(|_| subject.shown.asked(Textured::NAME).unwrap_or(true));
        Some(Self {
            silhouette: Shared::of(&subject.silhouette),
            shape: Shared::of(subject.shape),
            texture: texture.map(|texture| (Shared::of(texture), subject.design.texture_rect())),
            theme: subject.theme,
        })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        let Some(points) = self.silhouette.places(&self.shape.nodes) else { return };
        let texture = self.texture.as_ref().map(|(texture, frame)| (Arc::clone(texture), *frame));
        let color = Palette::of(self.theme).plush;
        items.push(Item::Plush(Felt::of(Arc::clone(&self.silhouette), points, color, texture)));
    }
}

impl Look for Plush {
    const LABEL: &'static str = "Plush";
    const TIP: &'static str = "The stuffed plushie in soft light, as it would be made";
    const REPLACES: &'static [&'static str] = &[Textured::NAME];
}
