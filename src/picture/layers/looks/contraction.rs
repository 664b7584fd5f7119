//! Contraction: how much each muscle fibre of the idealized plushie is shortened.

use crate::engine::Shape;
use crate::picture::layers::fibers::Fibers;
use crate::picture::layers::layer::{Layer, Shared};
use crate::picture::layers::look::Look;
use crate::picture::layers::marks::body;
use crate::picture::layers::subject::Subject;
use crate::picture::layers::texture::Textured;
use crate::picture::ramp::{Bar, ground};
use crate::picture::scene::{Item, Strands};
use crate::picture::silhouette::Silhouette;
use crate::picture::weave::Weave;

/// Contraction as a part of the rest length, the largest on top.
#[derive(Debug, PartialEq)]
pub struct Contraction {
    weave: Shared<Weave>,
    silhouette: Shared<Silhouette>,
    shape: Shared<Shape>,
    fibers: bool,
    bar: Bar,
}

/// End of the bar where no fibre contracts, percent.
const LEAST: f64 = 1.0;
/// Widths of a fibre at the ends of the bar, logical pixels.
const WIDTHS: [f32; 2] = [1.2, 4.0];

impl Layer for Contraction {
    const NAME: &'static str = "contraction";

    fn of(subject: &Subject<'_>) -> Option<Self> {
        let both = [Some(subject.shape), subject.beside];
        let all = both.into_iter().flatten().flat_map(|shape| percents(&subject.weave, shape));
        let bar = Bar::rising("Contraction of fibres", "%", &all.collect::<Vec<_>>(), LEAST, subject.theme);
        let (weave, silhouette) = (Shared::of(&subject.weave), Shared::of(&subject.silhouette));
        Some(Self { weave, silhouette, shape: Shared::of(subject.shape), fibers: subject.fibers, bar })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        items.extend(body(&self.silhouette, &self.shape, ground(self.bar.theme)));
        if !self.fibers {
            return;
        }
        let percents = percents(&self.weave, &self.shape);
        let mut order: Vec<usize> = (0..self.weave.count()).collect();
        order.sort_by(|&a, &b| percents[a].total_cmp(&percents[b]));
        let (mut strands, nodes) = (Strands::with_capacity(order.len()), &self.shape.nodes);
        for fiber in order {
            let place = self.bar.place(percents[fiber]);
            let width = WIDTHS[0] + place as f32 * (WIDTHS[1] - WIDTHS[0]);
            let line = self.weave.routing(fiber).iter().filter_map(|&node| nodes.get(node).copied());
            strands.push(line, width, self.bar.color_at(place));
        }
        items.push(Item::Strands(strands));
    }
}

fn percents(weave: &Weave, shape: &Shape) -> Vec<f64> {
    weave.contracted(&shape.fiber_contractions_mm).iter().map(|part| 100.0 * part).collect()
}

impl Look for Contraction {
    const LABEL: &'static str = "Fibre contraction";
    const TIP: &'static str = "How much each muscle fibre of the idealized plushie is shortened";
    const REPLACES: &'static [&'static str] = &[Textured::NAME, Fibers::NAME];

    fn bar(&self) -> Option<Bar> {
        Some(self.bar.clone())
    }
}
