//! Plain felt: the drawn silhouette in one colour.

use crate::engine::Shape;
use crate::picture::layers::layer::{Layer, Shared};
use crate::picture::layers::look::Look;
use crate::picture::layers::marks::body;
use crate::picture::layers::subject::Subject;
use crate::picture::palette::{Palette, Theme};
use crate::picture::scene::Item;
use crate::picture::silhouette::Silhouette;

/// The body, seen through where its texture is clear.
#[derive(Debug, PartialEq)]
pub struct Plain {
    silhouette: Shared<Silhouette>,
    shape: Shared<Shape>,
    theme: Theme,
}

impl Layer for Plain {
    const NAME: &'static str = "plain";

    fn of(subject: &Subject<'_>) -> Option<Self> {
        let (silhouette, shape) = (Shared::of(&subject.silhouette), Shared::of(subject.shape));
        Some(Self { silhouette, shape, theme: subject.theme })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        items.extend(body(&self.silhouette, &self.shape, Palette::of(self.theme).body));
    }
}

impl Look for Plain {
    const LABEL: &'static str = "Plain";
    const TIP: &'static str = "Felt in one colour, with the texture where there is one";
    const REPLACES: &'static [&'static str] = &[];
}
