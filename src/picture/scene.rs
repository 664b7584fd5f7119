//! Builds the drawing of one plushie: body, texture, fibres, tendons, winches, pins, targets, stages of discovery.
//!
//! Painting order is from the body upward: felt, texture, outline, fibres or a stage of discovery, tendons, winches, pins,
//! targets. Fibres are drawn in the order of their contraction, so that the active ones lie on top.

use super::palette::{Palette, Theme, mix, with_alpha};
use super::{Color, Item, Scene, Texture};
use crate::design::{Design, Target};
use crate::discovery::Stages;
use crate::engine::Shape;
use crate::mesh::Mesh;
use crate::outline::Point;
use std::sync::Arc;

/// What to draw beside the body.
#[derive(Clone, Copy, Debug)]
pub struct Options<'a> {
    pub theme: Theme,
    /// The picture on the body, if it shall be drawn.
    pub texture: Option<&'a Arc<Texture>>,
    /// Muscle fibres, coloured by contraction. Without contractions in the shape all are passive.
    pub fibers: bool,
    /// Tendons and winches of the design's networks.
    pub networks: bool,
    pub pins: bool,
    /// Targets of the pose that the shape belongs to.
    pub targets: &'a [Target],
    /// The target that is picked out, if any.
    pub selected_target: Option<usize>,
    /// A stage of network discovery, drawn instead of the fibres.
    pub stage: Option<(Stage, &'a Stages)>,
}

/// The four pictures of fig. 6.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// (a) the activation graph: every fibre, weighted by contraction.
    Activation,
    /// (b) the heaviest fibres; the starting component stands out.
    Seeds,
    /// (c) the winch tree: components and the joining paths between them.
    Tree,
    /// (d) the winch and its tendons.
    Result,
}

impl Stage {
    pub const ALL: [Self; 4] = [Self::Activation, Self::Seeds, Self::Tree, Self::Result];
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self {
            theme: Theme::Light,
            texture: None,
            fibers: true,
            networks: true,
            pins: true,
            targets: &[],
            selected_target: None,
            stage: None,
        }
    }
}

/// Line widths and radii, logical pixels.
mod size {
    pub const SEAM: f32 = 3.0;
    pub const FIBER_PASSIVE: f32 = 1.0;
    pub const FIBER_ACTIVE: f32 = 3.2;
    pub const TENDON: f32 = 3.4;
    pub const CASING: f32 = 6.0;
    pub const VIA: f32 = 2.6;
    pub const WINCH: f32 = 8.5;
    pub const PIN: f32 = 6.0;
    pub const TARGET: f32 = 5.0;
    pub const GOAL: f32 = 7.0;
}

/// Fibres contracted by less than this fraction of their rest length look passive, however little the others are
/// contracted: noise of the solver must not turn the body red.
const LEAST_FULL_CONTRACTION: f64 = 0.08;

/// Draws `shape` of `design`. Shapes of another mesh give an empty scene.
pub fn scene(design: &Design, shape: &Shape, options: &Options<'_>) -> Scene {
    let mesh = &design.mesh;
    let mut scene = Scene::default();
    if shape.nodes.len() != mesh.nodes.len() {
        return scene;
    }
    let palette = Palette::of(options.theme);
    let items = &mut scene.items;
    body(items, design, shape, &palette, options.texture);
    match options.stage {
        Some((stage, stages)) => draw_stage(items, design, shape, &palette, stage, stages),
        None => {
            if options.fibers {
                fibers(items, design, shape, &palette);
            }
            if options.networks {
                networks(items, design, shape, &palette);
            }
        }
    }
    if options.pins {
        pins(items, design, shape, &palette);
    }
    for (index, target) in options.targets.iter().enumerate() {
        draw_target(items, mesh, shape, &palette, target, options.selected_target == Some(index));
    }
    scene
}

fn body(items: &mut Vec<Item>, design: &Design, shape: &Shape, palette: &Palette, texture: Option<&Arc<Texture>>) {
    let mesh = &design.mesh;
    let (points, triangles) = (shape.nodes.clone(), mesh.triangles.clone());
    if let Some(texture) = texture {
        // Felt shows through where the picture is clear.
        items.push(Item::Mesh { points: points.clone(), triangles: triangles.clone(), color: palette.body });
        let [low, high] = design.texture_rect();
        let place = |p: &Point| [(p[0] - low[0]) / (high[0] - low[0]), (high[1] - p[1]) / (high[1] - low[1])];
        let places = mesh.nodes.iter().map(place).collect();
        items.push(Item::Picture { points, places, triangles, texture: texture.clone() });
    } else {
        items.push(Item::Mesh { points, triangles, color: palette.body });
    }
    for edge in mesh.boundary() {
        let points = edge.iter().map(|&n| shape.nodes[n]).collect();
        items.push(Item::Line { points, width: size::SEAM, color: palette.seam, closed: true });
    }
}

fn fibers(items: &mut Vec<Item>, design: &Design, shape: &Shape, palette: &Palette) {
    let routings = design.fiber_routings();
    let activity = fiber_activity(design, &routings, shape);
    let mut order: Vec<usize> = (0..routings.len()).collect();
    order.sort_by(|&a, &b| activity[a].total_cmp(&activity[b]));
    for fiber in order {
        let t = activity[fiber] as f32;
        let color = mix(palette.fiber_passive, palette.fiber_active, t);
        let width = size::FIBER_PASSIVE + t * (size::FIBER_ACTIVE - size::FIBER_PASSIVE);
        items.push(path(&routings[fiber], shape, width, color));
    }
}

/// How active each fibre looks, 0 to 1: its contraction by its rest length, relative to the largest of all.
pub fn fiber_activity(design: &Design, routings: &[Vec<usize>], shape: &Shape) -> Vec<f64> {
    if shape.fiber_contractions_mm.len() != routings.len() {
        return vec![0.0; routings.len()];
    }
    let strain = |(routing, contraction): (&Vec<usize>, &f64)| {
        let rest = length(routing, &design.mesh.nodes);
        if rest > 0.0 { (contraction / rest).max(0.0) } else { 0.0 }
    };
    let strains: Vec<f64> = routings.iter().zip(&shape.fiber_contractions_mm).map(strain).collect();
    let full = strains.iter().copied().fold(LEAST_FULL_CONTRACTION, f64::max);
    // A power below one, so that the middle of the range can be told from the bottom by eye.
    strains.iter().map(|s| (s / full).powf(0.75)).collect()
}

fn networks(items: &mut Vec<Item>, design: &Design, shape: &Shape, palette: &Palette) {
    let tendons = || {
        let numbered = design.networks.iter().enumerate();
        numbered.flat_map(|(winch, network)| network.tendons.iter().map(move |tendon| (winch, tendon)))
    };
    for (_, tendon) in tendons() {
        items.push(path(&tendon.routing, shape, size::CASING, palette.casing));
    }
    for (index, (winch, tendon)) in tendons().enumerate() {
        let slack = shape.tendon_tensions.get(index).is_some_and(|&t| t <= 0.0);
        let color = palette.winch(winch);
        let color = if slack { with_alpha(color, 170) } else { color };
        items.push(path(&tendon.routing, shape, size::TENDON, color));
        for &node in tendon.routing.iter().skip(1).filter(|&&n| n < shape.nodes.len()) {
            items.push(disc(shape.nodes[node], size::VIA, color, None));
        }
    }
    for (winch, network) in design.networks.iter().enumerate() {
        if let Some(node) = network.winch_node().filter(|&n| n < shape.nodes.len()) {
            items.push(disc(shape.nodes[node], size::WINCH, palette.winch_fill, Some((2.0, palette.winch_stroke))));
            items.push(disc(shape.nodes[node], 3.0, palette.winch(winch), None));
        }
    }
}

fn pins(items: &mut Vec<Item>, design: &Design, shape: &Shape, palette: &Palette) {
    for pin in design.pins.iter().filter(|pin| pin.at.triangle < design.mesh.triangles.len()) {
        let at = design.mesh.position(&pin.at, &shape.nodes);
        items.push(disc(at, size::PIN, palette.pin, Some((1.5, palette.pin_stroke))));
        items.push(disc(at, 1.8, palette.pin_stroke, None));
    }
}

fn draw_target(items: &mut Vec<Item>, mesh: &Mesh, shape: &Shape, palette: &Palette, target: &Target, selected: bool) {
    if target.at.triangle >= mesh.triangles.len() {
        return;
    }
    let at = mesh.position(&target.at, &shape.nodes);
    let color = if selected { palette.target_selected } else { palette.target };
    items.push(Item::Line { points: vec![at, target.to], width: 2.0, color: with_alpha(color, 200), closed: false });
    items.push(disc(target.to, size::GOAL, with_alpha(color, 45), Some((2.0, color))));
    items.push(disc(target.to, 1.8, color, None));
    items.push(disc(at, size::TARGET, palette.target_fill, Some((2.0, color))));
}

fn draw_stage(items: &mut Vec<Item>, design: &Design, shape: &Shape, palette: &Palette, stage: Stage, stages: &Stages) {
    let edges = design.mesh.edges();
    let heaviest = stages.weights.iter().copied().fold(0.0, f64::max);
    let weighted = stage == Stage::Activation && stages.weights.len() == edges.len() && heaviest > 0.0;
    let mut graph: Vec<(f64, [usize; 2])> = edges
        .into_iter()
        .enumerate()
        .map(|(i, edge)| (if weighted { (stages.weights[i] / heaviest).clamp(0.0, 1.0) } else { 0.0 }, edge))
        .collect();
    graph.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (weight, edge) in graph {
        let t = weight.powf(0.75) as f32;
        let color = mix(palette.fiber_passive, palette.fiber_active, t);
        items.push(path(&edge, shape, 1.0 + 2.6 * t, color));
    }
    let mut edges = |edges: &[[usize; 2]], width: f32, color: Color| {
        for edge in edges {
            items.push(path(edge, shape, width, color));
        }
    };
    match stage {
        Stage::Activation => {}
        Stage::Seeds => {
            edges(&stages.seeds, 3.2, palette.fiber_active);
            edges(&stages.start, 4.4, palette.start);
        }
        Stage::Tree => {
            edges(&stages.tree, 3.2, palette.fiber_active);
            edges(&stages.start, 4.4, palette.start);
            for join in &stages.joins {
                items.push(path(join, shape, 4.0, palette.join));
            }
        }
        Stage::Result => {
            edges(&stages.tree, 2.2, with_alpha(palette.fiber_active, 110));
            for tendon in &stages.tendons {
                items.push(path(tendon, shape, size::CASING, palette.casing));
            }
            for tendon in &stages.tendons {
                items.push(path(tendon, shape, size::TENDON, palette.proposed));
            }
            if let Some(&winch) = shape.nodes.get(stages.winch) {
                items.push(disc(winch, size::WINCH, palette.winch_fill, Some((2.0, palette.winch_stroke))));
            }
        }
    }
}

fn path(routing: &[usize], shape: &Shape, width: f32, color: Color) -> Item {
    let points = routing.iter().filter_map(|&n| shape.nodes.get(n).copied()).collect();
    Item::Line { points, width, color, closed: false }
}

fn disc(center: Point, radius: f32, fill: Color, stroke: Option<(f32, Color)>) -> Item {
    Item::Disc { center, radius, fill, stroke }
}

fn length(routing: &[usize], nodes: &[Point]) -> f64 {
    routing
        .windows(2)
        .filter_map(|w| Some((nodes.get(w[0])?, nodes.get(w[1])?)))
        .map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Network, Pin, Tendon};
    use crate::mesh::BodyPoint;
    use crate::outline::Outline;

    /// A square of two triangles with a pin, a target and a network along its diagonal.
    fn design() -> Design {
        let mesh = Mesh {
            nodes: vec![[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
        };
        let at = BodyPoint { triangle: 0, weights: [1.0, 0.0, 0.0] };
        let outline = Outline { outer: mesh.nodes.clone(), holes: Vec::new() };
        let mut design = Design::new("square", outline, mesh);
        design.pins.push(Pin { at, position: None, stiffness: 1.0 });
        let tendon = Tendon { routing: vec![0, 2], ratio: 1.0, slack_mm: 0.0 };
        design.networks.push(Network { name: "A".to_owned(), tendons: vec![tendon] });
        design
    }

    fn rest(design: &Design) -> Shape {
        Shape { nodes: design.mesh.nodes.clone(), ..Shape::default() }
    }

    fn lines_of(scene: &Scene, wanted: Color) -> usize {
        scene.items.iter().filter(|item| matches!(item, Item::Line { color, .. } if *color == wanted)).count()
    }

    #[test]
    fn every_part_is_drawn_once() {
        let design = design();
        let palette = Palette::of(Theme::Light);
        let target = Target { at: design.pins[0].at, to: [5.0, 20.0], weight: 1.0 };
        let options = Options { targets: &[target], ..Options::default() };
        let scene = scene(&design, &rest(&design), &options);
        assert_eq!(lines_of(&scene, palette.seam), 1);
        assert_eq!(lines_of(&scene, palette.fiber_passive), 5);
        assert_eq!(lines_of(&scene, palette.winch(0)), 1);
        let winches =
            scene.items.iter().filter(|i| matches!(i, Item::Disc { fill, .. } if *fill == palette.winch_fill));
        assert_eq!(winches.count(), 1);
        let goals = scene.items.iter().filter(|i| matches!(i, Item::Disc { center, .. } if *center == [5.0, 20.0]));
        assert_eq!(goals.count(), 2);
    }

    #[test]
    fn the_most_contracted_fibre_is_the_reddest_and_on_top() {
        let design = design();
        let shape = Shape { fiber_contractions_mm: vec![0.0, 3.0, 1.0, 0.0, 0.0], ..rest(&design) };
        let options = Options { networks: false, pins: false, ..Options::default() };
        let scene = scene(&design, &shape, &options);
        let Some(Item::Line { points, color, .. }) = scene.items.last() else { panic!("no fibre") };
        assert_eq!(*color, Palette::of(Theme::Light).fiber_active);
        assert_eq!(*points, vec![[0.0, 0.0], [10.0, 10.0]]);
    }

    #[test]
    fn a_shape_of_another_mesh_is_not_drawn() {
        let design = design();
        assert_eq!(scene(&design, &Shape::default(), &Options::default()), Scene::default());
    }

    #[test]
    fn every_stage_of_discovery_has_its_colours() {
        let design = design();
        let palette = Palette::of(Theme::Dark);
        let stages = Stages {
            weights: vec![1.0, 2.0, 0.0, 0.5, 0.0],
            seeds: vec![[0, 1], [2, 3]],
            start: vec![[0, 1]],
            joins: vec![vec![1, 2]],
            tree: vec![[0, 1], [1, 2], [2, 3]],
            winch: 1,
            tendons: vec![vec![1, 0], vec![1, 2, 3]],
            score: 1.0,
        };
        let draw = |stage| {
            let options = Options { theme: Theme::Dark, stage: Some((stage, &stages)), ..Options::default() };
            scene(&design, &rest(&design), &options)
        };
        assert_eq!(lines_of(&draw(Stage::Activation), palette.fiber_active), 1);
        assert_eq!(lines_of(&draw(Stage::Seeds), palette.start), 1);
        assert_eq!(lines_of(&draw(Stage::Tree), palette.join), 1);
        assert_eq!(lines_of(&draw(Stage::Result), palette.proposed), 2);
    }
}
