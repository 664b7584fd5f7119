//! The stages of network discovery, like fig. 6 of the paper.

use super::layer::{Layer, Shared};
use super::marks::{self, disc, path};
use super::subject::{Stage, Subject};
use crate::design::Design;
use crate::discovery::Stages;
use crate::engine::Shape;
use crate::picture::color::Color;
use crate::picture::palette::{Palette, Theme, mix, with_alpha};
use crate::picture::scene::Item;

/// One stage of discovery, in the place of fibres and tendons.
#[derive(Debug, PartialEq)]
pub struct Discovery {
    design: Shared<Design>,
    shape: Shared<Shape>,
    stage: Stage,
    stages: Shared<Stages>,
    theme: Theme,
}

/// Widths of a fibre in the graph without weight, and what the heaviest has more, logical pixels.
const LIGHT: f32 = 1.0;
const HEAVIER: f32 = 2.6;
/// Exponent that spreads the middle of the weights away from the bottom, so that the eye can tell them apart.
const SPREADING: f64 = 0.75;

impl Layer for Discovery {
    const NAME: &'static str = "discovery";

    fn of(subject: &Subject<'_>) -> Option<Self> {
        let (stage, stages) = subject.stage?;
        let (design, shape) = (Shared::of(subject.design), Shared::of(subject.shape));
        Some(Self { design, shape, stage, stages: Shared::of(stages), theme: subject.theme })
    }

    fn draw(&self, items: &mut Vec<Item>) {
        let (palette, stages) = (Palette::of(self.theme), &*self.stages);
        self.graph(items, &palette);
        match self.stage {
            Stage::Activation => {}
            Stage::Seeds => {
                self.edges(items, &stages.seeds, 3.2, palette.fiber_active);
                self.edges(items, &stages.start, 4.4, palette.start);
            }
            Stage::Tree => {
                self.edges(items, &stages.tree, 3.2, palette.fiber_active);
                self.edges(items, &stages.start, 4.4, palette.start);
                for join in &stages.joins {
                    items.push(path(join, &self.shape, 4.0, palette.join));
                }
            }
            Stage::Result => {
                self.edges(items, &stages.tree, 2.2, with_alpha(palette.fiber_active, 110));
                self.winch(items, &palette);
            }
        }
    }
}

impl Discovery {
    /// All edges of the mesh; in the first stage by their weight, the heaviest on top.
    fn graph(&self, items: &mut Vec<Item>, palette: &Palette) {
        let (edges, weights) = (self.design.mesh.edges(), &self.stages.weights);
        let heaviest = weights.iter().copied().fold(0.0, f64::max);
        let weighted = self.stage == Stage::Activation && weights.len() == edges.len() && heaviest > 0.0;
        let weight = |i: usize| if weighted { (weights[i] / heaviest).clamp(0.0, 1.0) } else { 0.0 };
        let mut graph: Vec<(f64, [usize; 2])> =
            edges.into_iter().enumerate().map(|(i, edge)| (weight(i), edge)).collect();
        graph.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (weight, edge) in graph {
            let t = weight.powf(SPREADING) as f32;
            let color = mix(palette.fiber_passive, palette.fiber_active, t);
            items.push(path(&edge, &self.shape, LIGHT + HEAVIER * t, color));
        }
    }

    fn edges(&self, items: &mut Vec<Item>, edges: &[[usize; 2]], width: f32, color: Color) {
        for edge in edges {
            items.push(path(edge, &self.shape, width, color));
        }
    }

    fn winch(&self, items: &mut Vec<Item>, palette: &Palette) {
        for tendon in &self.stages.tendons {
            items.push(path(tendon, &self.shape, marks::CASING, palette.casing));
        }
        for tendon in &self.stages.tendons {
            items.push(path(tendon, &self.shape, marks::TENDON, palette.proposed));
        }
        if let Some(&winch) = self.shape.nodes.get(self.stages.winch) {
            items.push(disc(winch, marks::WINCH, palette.winch_fill, Some((2.0, palette.winch_stroke))));
        }
    }
}
