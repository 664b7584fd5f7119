//! The gap between the two plushies: how far each point of the seam is from where the idealized one has it. The paper calls it a direct
//! measure of how much more the design could be improved.

use crate::engine::Shape;
use crate::outline::{Point, polygon};
use crate::picture::layers::fibers::Fibers;
use crate::picture::layers::layer::{Layer, Shared};
use crate::picture::layers::look::Look;
use crate::picture::layers::marks::{self, body};
use crate::picture::layers::seam::Seam;
use crate::picture::layers::subject::Subject;
use crate::picture::layers::texture::Textured;
use crate::picture::palette::{Palette, Theme};
use crate::picture::ramp::{Bar, ground};
use crate::picture::scene::Item;
use crate::picture::silhouette::Silhouette;

/// The outline of the idealized plushie over either, coloured by its distance from that of the realizable one.
#[derive(Debug, PartialEq)]
pub struct Gap {
    silhouette: Shared<Silhouette>,
    shape: Shared<Shape>,
    beside: Option<Shared<Shape>>,
    fibers: bool,
    theme: Theme,
}

/// End of the bar where both are the same, mm.
const LEAST_MM: f64 = 0.5;
/// Width of the outline, and of the rim that lifts it off the body, logical pixels.
const LINE: f32 = 4.5;
const CASING: f32 = 7.0;

impl Gap {
    /// Outlines of the idealized and the realizable plushie, point by point; one alone is both.
    fn outlines(&self) -> Option<[Vec<Vec<Point>>; 2]> {
        let own = self.silhouette.places(&self.shape.nodes)?;
        let other = self.beside.as_ref().and_then(|shape| self.silhouette.places(&shape.nodes));
        let other = other.unwrap_or_else(|| own.clone());
        let [ideal, real] = if self.fibers { [own, other] } else { [other, own] };
        Some([self.silhouette.lines(&ideal), self.silhouette.lines(&real)])
    }
}

/// Distances of the points of two lines.
fn distances(ideal: &[Point], real: &[Point]) -> Vec<f64> {
    ideal.iter().zip(real).map(|(p, q)| polygon::length(*p, *q)).collect()
}

impl Layer for Gap {
    const NAME: &'static str = "gap";

    fn of(subject: &Subject<'_>) -> Option<Self> {
        Some(Self {
            silhouette: Shared::of(&subject.silhouette),
            shape: Shared::of(subject.shape),
            beside: subject.beside.map(Shared::of),
            fibers: subject.fibers,
            theme: subject.theme,
        })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        items.extend(body(&self.silhouette, &self.shape, ground(self.theme)));
        let (Some([ideal, real]), Some(bar)) = (self.outlines(), self.bar()) else { return };
        // The seam of the plushie itself lies below.
        for line in if self.fibers { &ideal } else { &real } {
            let color = Palette::of(self.theme).seam;
            items.push(Item::Line { points: line.clone(), width: marks::SEAM, color, closed: true });
        }
        for line in &ideal {
            let color = Palette::of(self.theme).pin;
            items.push(Item::Line { points: line.clone(), width: CASING, color, closed: true });
        }
        for (ideal, real) in ideal.iter().zip(&real) {
            let far = distances(ideal, real);
            for i in 0..ideal.len() {
                let next = (i + 1) % ideal.len();
                let color = bar.color(0.5 * (far[i] + far[next]));
                let points = vec![ideal[i], ideal[next]];
                items.push(Item::Line { points, width: LINE, color, closed: false });
            }
        }
    }
}

impl Look for Gap {
    const LABEL: &'static str = "Gap";
    const TIP: &'static str =
        "The idealized outline by its distance from the realizable plushie: how much the design could be improved";
    const REPLACES: &'static [&'static str] = &[Textured::NAME, Fibers::NAME, Seam::NAME];

    fn bar(&self) -> Option<Bar> {
        let [ideal, real] = self.outlines()?;
        let all: Vec<f64> = ideal.iter().zip(&real).flat_map(|(p, q)| distances(p, q)).collect();
        Some(Bar::rising("Distance between the plushies", "mm", &all, LEAST_MM, self.theme))
    }
}
