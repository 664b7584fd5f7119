//! The texture: the picture that the plushie was made of, on the felt.

use super::layer::{Layer, Shared, Stroke, Switch};
use super::subject::Subject;
use crate::engine::Shape;
use crate::outline::Point;
use crate::picture::scene::Item;
use crate::picture::silhouette::Silhouette;
use crate::picture::texture::{Texture, places};
use std::sync::Arc;

/// The design's texture on the deformed body.
#[derive(Debug, PartialEq)]
pub struct Textured {
    /// Lower left and upper right corner of the texture, mm.
    frame: [Point; 2],
    silhouette: Shared<Silhouette>,
    shape: Shared<Shape>,
    texture: Shared<Texture>,
}

/// A picture in its frame: a hill and the sun.
const ICON: &[Stroke] = &[
    Stroke::Line(&[(0.06, 0.12), (0.94, 0.12), (0.94, 0.88), (0.06, 0.88), (0.06, 0.12)]),
    Stroke::Line(&[(0.08, 0.8), (0.36, 0.46), (0.56, 0.68), (0.7, 0.54), (0.92, 0.8)]),
    Stroke::Dot(0.7, 0.33, 0.09),
];

impl Layer for Textured {
    const NAME: &'static str = "texture";
    const SWITCH: Option<Switch> = Some(Switch {
        label: "Show the texture",
        tip: "Show the texture: the picture that the plushie was made of",
        key: Some('X'),
        icon: ICON,
        at_first: true,
    });

    fn of(subject: &Subject<'_>) -> Option<Self> {
        let (frame, shape) = (subject.design.texture_rect(), Shared::of(subject.shape));
        let silhouette = Shared::of(&subject.silhouette);
        Some(Self { frame, silhouette, shape, texture: Shared::of(subject.texture?) })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        let Some(points) = self.silhouette.places(&self.shape.nodes) else { return };
        let places = places(self.frame, &self.silhouette.rest);
        let triangles = self.silhouette.triangles.clone();
        items.push(Item::Picture { points, places, triangles, texture: Arc::clone(&self.texture) });
    }
}
