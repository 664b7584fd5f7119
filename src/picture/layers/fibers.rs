//! The muscle fibres, coloured by contraction, the most contracted on top.

use super::layer::{Layer, Shared, Stroke, Switch};
use super::marks;
use super::subject::Subject;
use super::texture::Textured;
use crate::engine::Shape;
use crate::picture::color::Color;
use crate::picture::palette::{Palette, Theme, mix};
use crate::picture::scene::{Item, Strands};
use crate::picture::weave::Weave;

/// The fibres of the idealized plushie. Without contractions in the shape all are passive.
#[derive(Debug, PartialEq)]
pub struct Fibers {
    weave: Shared<Weave>,
    shape: Shared<Shape>,
    /// Whether a texture lies below.
    textured: bool,
    theme: Theme,
}

/// Fibres contracted by less than this fraction of their rest length look passive, however little the others are
/// contracted: noise of the solver must not turn the body red.
const LEAST_FULL_CONTRACTION: f64 = 0.08;
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
        let (weave, shape) = (Shared::of(&subject.weave), Shared::of(subject.shape));
        let drawn = subject.fibers && subject.stage.is_none();
        let textured = subject.texture.is_some() && subject.shown.asked(Textured::NAME).unwrap_or(true);
        drawn.then_some(Self { weave, shape, textured, theme: subject.theme })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        let palette = Palette::of(self.theme);
        let shades = shades(&self.weave, &self.shape);
        let paints: Vec<(f32, Color)> = (0..=u8::MAX)
            .map(|shade| {
                let t = f32::from(shade) / f32::from(u8::MAX);
                let width = marks::FIBER_PASSIVE + t * (marks::FIBER_ACTIVE - marks::FIBER_PASSIVE);
                (width, mix(palette.fiber_passive, palette.fiber_active, t))
            })
            .collect();
        let (mut strands, nodes) = (Strands::with_capacity(self.weave.count()), &self.shape.nodes);
        for fiber in rising(&shades) {
            let line = || self.weave.routing(fiber).iter().filter_map(|&node| nodes.get(node).copied());
            let (width, color) = paints[usize::from(shades[fiber])];
            if self.textured {
                // Whatever colours the picture has, a line between two rims differs from it or from them.
                strands.push(line(), width + 2.0 * RIM, palette.casing);
                let color = Color(color.0, color.1, color.2, color.3.max(OVER_TEXTURE));
                strands.push(line(), width, color);
                continue;
            }
            strands.push(line(), width, color);
        }
        items.push(Item::Strands(strands));
    }
}

/// How active each fibre looks: its contraction by its rest length, relative to the largest of all. In as many steps as a colour has.
fn shades(weave: &Weave, shape: &Shape) -> Vec<u8> {
    let strains = weave.contracted(&shape.fiber_contractions_mm);
    let full = strains.iter().copied().fold(LEAST_FULL_CONTRACTION, f64::max);
    // To the power of 3/4, which spreads the middle of the range away from the bottom, so that the eye can tell them apart.
    let spread = |part: f64| part.sqrt() * part.sqrt().sqrt();
    strains.iter().map(|s| (f64::from(u8::MAX) * spread(s / full)).round() as u8).collect()
}

/// The numbers of the shades from the lowest to the highest, equal ones in their order. Cost: linear, every frame of a drag.
fn rising(shades: &[u8]) -> Vec<usize> {
    let mut next = [0; 256];
    for &shade in shades {
        next[usize::from(shade)] += 1;
    }
    let mut before = 0;
    for count in &mut next {
        before += std::mem::replace(count, before);
    }
    let mut order = vec![0; shades.len()];
    for (fiber, &shade) in shades.iter().enumerate() {
        let place = &mut next[usize::from(shade)];
        order[*place] = fiber;
        *place += 1;
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_order_is_that_of_a_stable_sort() {
        let shades: Vec<u8> = (0..1000_u32).map(|k| (k.wrapping_mul(2_654_435_761) >> 24) as u8 / 3 * 3).collect();
        let mut sorted: Vec<usize> = (0..shades.len()).collect();
        sorted.sort_by_key(|&fiber| shades[fiber]);
        assert_eq!(rising(&shades), sorted);
        assert!(rising(&[]).is_empty());
    }
}
