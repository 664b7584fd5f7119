//! Wireframe: the triangles that are computed.

use crate::design::Design;
use crate::engine::Shape;
use crate::picture::layers::fibers::Fibers;
use crate::picture::layers::layer::{Layer, Shared};
use crate::picture::layers::look::Look;
use crate::picture::layers::marks::body;
use crate::picture::layers::subject::Subject;
use crate::picture::layers::texture::Textured;
use crate::picture::palette::{Palette, Theme, with_alpha};
use crate::picture::ramp::ground;
use crate::picture::scene::{Item, Strands};
use crate::picture::silhouette::Silhouette;

/// The mesh on the drawn silhouette: how far both differ is seen too.
#[derive(Debug, PartialEq)]
pub struct Wireframe {
    design: Shared<Design>,
    silhouette: Shared<Silhouette>,
    shape: Shared<Shape>,
    theme: Theme,
}

/// Width of an edge, logical pixels.
const EDGE: f32 = 1.0;

impl Layer for Wireframe {
    const NAME: &'static str = "wireframe";

    fn of(subject: &Subject<'_>) -> Option<Self> {
        let (design, silhouette) = (Shared::of(subject.design), Shared::of(&subject.silhouette));
        Some(Self { design, silhouette, shape: Shared::of(subject.shape), theme: subject.theme })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        items.extend(body(&self.silhouette, &self.shape, ground(self.theme)));
        let color = with_alpha(Palette::of(self.theme).pin, 150);
        let mut edges = Strands::default();
        for edge in self.design.mesh.edges() {
            edges.push(edge.map(|n| self.shape.nodes[n]), EDGE, color);
        }
        items.push(Item::Strands(edges));
    }
}

impl Look for Wireframe {
    const LABEL: &'static str = "Wireframe";
    const TIP: &'static str = "The triangles that are computed, and the silhouette that is seen";
    const REPLACES: &'static [&'static str] = &[Textured::NAME, Fibers::NAME];
}
