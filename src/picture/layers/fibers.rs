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
        let (weave, shape) = (Shared::of(&subject.weave), Shared::of(subject.shape));
        let drawn = subject.fibers && subject.stage.is_none();
        let textured = subject.texture.is_some() && subject.shown.asked(Textured::NAME).unwrap_or(true);
        drawn.then_some(Self { weave, shape, textured, theme: subject.theme })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        let palette = Palette::of(self.theme);
        let routings = &self.weave.routings;
        let activity = activity(&self.weave, &self.shape);
        let mut order: Vec<usize> = (0..routings.len()).collect();
        order.sort_by(|&a, &b| activity[a].total_cmp(&activity[b]));
        let (mut strands, nodes) = (Strands::default(), &self.shape.nodes);
        for fiber in order {
            let line = || routings[fiber].iter().filter_map(|&node| nodes.get(node).copied());
            let t = activity[fiber] as f32;
            let color = mix(palette.fiber_passive, palette.fiber_active, t);
            let width = marks::FIBER_PASSIVE + t * (marks::FIBER_ACTIVE - marks::FIBER_PASSIVE);
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

/// How active each fibre looks, 0 to 1: its contraction by its rest length, relative to the largest of all.
fn activity(weave: &Weave, shape: &Shape) -> Vec<f64> {
    let strains = weave.contracted(&shape.fiber_contractions_mm);
    let full = strains.iter().copied().fold(LEAST_FULL_CONTRACTION, f64::max);
    strains.iter().map(|s| (s / full).powf(SPREADING)).collect()
}
