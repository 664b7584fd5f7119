//! The muscle fibres, coloured by contraction, the most contracted on top.

use super::layer::{Layer, Shared, Stroke, Switch};
use super::marks::{self, path};
use super::subject::Subject;
use super::texture::Textured;
use crate::design::Design;
use crate::engine::Shape;
use crate::outline::Point;
use crate::picture::color::Color;
use crate::picture::palette::{Palette, Theme, mix};
use crate::picture::scene::Item;

/// The fibres of the idealized plushie. Without contractions in the shape all are passive.
#[derive(Debug, PartialEq)]
pub struct Fibers {
    design: Shared<Design>,
    shape: Shared<Shape>,
    /// Whether a texture lies below.
    textured: bool,
    theme: Theme,
}

/// Fibres contracted by less than this fraction of their rest length look passive, however little the others are
/// contracted: noise of the solver must not turn the body red.
const LEAST_FULL_CONTRACTION: f64 = 0.08;
/// Exponent that spreads the middle of the range away from the bottom, so that the eye can tell them apart.
const SPREADING: f64 = 0.75;

/// Width of the rim of a fibre over a texture on each side, logical pixels, and its strength there at least, of 255.
const RIM: f32 = 0.8;
const OVER_TEXTURE: u8 = 200;

const ICON: &[Stroke] = &[
    Stroke::Line(&[(0.08, 0.88), (0.5, 0.1), (0.92, 0.88), (0.08, 0.88)]),
    Stroke::Line(&[(0.29, 0.49), (0.71, 0.49), (0.5, 0.88), (0.29, 0.49)]),
];

impl Layer for Fibers {
    const NAME: &'static str = "fibers";
    const SWITCH: Option<Switch> = Some(Switch {
        label: "Show fibres",
        tip: "Show the muscle fibres of the idealized plushie",
        key: Some('M'),
        icon: ICON,
        at_first: true,
    });

    fn of(subject: &Subject<'_>) -> Option<Self> {
        let (design, shape) = (Shared::of(subject.design), Shared::of(subject.shape));
        let drawn = subject.fibers && subject.stage.is_none();
        let textured = subject.texture.is_some() && subject.shown.asked(Textured::NAME).unwrap_or(true);
        drawn.then_some(Self { design, shape, textured, theme: subject.theme })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        let palette = Palette::of(self.theme);
        let routings = self.design.fiber_routings();
        let activity = activity(&self.design, &routings, &self.shape);
        let mut order: Vec<usize> = (0..routings.len()).collect();
        order.sort_by(|&a, &b| activity[a].total_cmp(&activity[b]));
        for fiber in order {
            let t = activity[fiber] as f32;
            let color = mix(palette.fiber_passive, palette.fiber_active, t);
            let width = marks::FIBER_PASSIVE + t * (marks::FIBER_ACTIVE - marks::FIBER_PASSIVE);
            if self.textured {
                // Whatever colours the picture has, a line between two rims differs from it or from them.
                items.push(path(&routings[fiber], &self.shape, width + 2.0 * RIM, palette.casing));
                let color = Color(color.0, color.1, color.2, color.3.max(OVER_TEXTURE));
                items.push(path(&routings[fiber], &self.shape, width, color));
                continue;
            }
            items.push(path(&routings[fiber], &self.shape, width, color));
        }
    }
}

/// How active each fibre looks, 0 to 1: its contraction by its rest length, relative to the largest of all.
fn activity(design: &Design, routings: &[Vec<usize>], shape: &Shape) -> Vec<f64> {
    let strains = contractions(design, routings, shape);
    let full = strains.iter().copied().fold(LEAST_FULL_CONTRACTION, f64::max);
    strains.iter().map(|s| (s / full).powf(SPREADING)).collect()
}

/// Contraction of each fibre as a part of its rest length; zeros for a shape without fibres.
pub fn contractions(design: &Design, routings: &[Vec<usize>], shape: &Shape) -> Vec<f64> {
    if shape.fiber_contractions_mm.len() != routings.len() {
        return vec![0.0; routings.len()];
    }
    let strain = |(routing, contraction): (&Vec<usize>, &f64)| {
        let rest = length(routing, &design.mesh.nodes);
        if rest > 0.0 { (contraction / rest).max(0.0) } else { 0.0 }
    };
    routings.iter().zip(&shape.fiber_contractions_mm).map(strain).collect()
}

/// Length of a routing, mm.
fn length(routing: &[usize], nodes: &[Point]) -> f64 {
    routing
        .windows(2)
        .filter_map(|w| Some((nodes.get(w[0])?, nodes.get(w[1])?)))
        .map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]))
        .sum()
}
