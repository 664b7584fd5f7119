//! Items that the layers draw, and pictures that are the same.

use super::*;
use crate::design::{Design, MaterialPoint, Network, Pin, Target, Tendon};
use crate::discovery::Stages;
use crate::engine::Shape;
use crate::mesh::{BodyPoint, Mesh};
use crate::outline::Outline;
use crate::picture::color::Color;
use crate::picture::palette::{Palette, Theme};
use crate::picture::scene::Item;
use crate::picture::weave::Weave;
use std::sync::Arc;

/// A square of two triangles with a pin, a target and a network along its diagonal.
fn design() -> Arc<Design> {
    let mesh =
        Mesh { nodes: vec![[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]], triangles: vec![[0, 1, 2], [0, 2, 3]] };
    let at = BodyPoint { triangle: 0, weights: [1.0, 0.0, 0.0] };
    let outline = Outline { outer: mesh.nodes.clone(), holes: Vec::new() };
    let mut design = Design::new("square", outline, mesh);
    design.pins.push(Pin::at_rest(at, 1.0));
    let tendon = Tendon { routing: MaterialPoint::through([0, 2]), ratio: 1.0, slack_mm: 0.0 };
    design.networks.push(Network::new("A", vec![tendon]));
    Arc::new(design)
}

fn rest(design: &Design) -> Arc<Shape> {
    Arc::new(Shape { nodes: design.mesh.nodes.clone(), ..Shape::default() })
}

fn lines_of(scene: &Scene, wanted: Color) -> usize {
    let of = |item: &Item| match item {
        Item::Line { color, .. } => usize::from(*color == wanted),
        Item::Strands(strands) => strands.iter().filter(|(_, _, color)| *color == wanted).count(),
        _ => 0,
    };
    scene.items.iter().map(of).sum()
}

#[test]
fn every_part_is_drawn_once() {
    let design = design();
    let palette = Palette::of(Theme::Light);
    let target = Target { at: design.pins[0].at, to: [5.0, 20.0], weight: 1.0 };
    let scene = Layers::of(&Subject { targets: &[target], ..Subject::new(&design, &rest(&design)) }).scene();
    assert_eq!(lines_of(&scene, palette.seam), 1);
    assert_eq!(lines_of(&scene, palette.fiber_passive), 5);
    assert_eq!(lines_of(&scene, palette.winch(0)), 1);
    let winches = scene.items.iter().filter(|i| matches!(i, Item::Disc { fill, .. } if *fill == palette.winch_fill));
    assert_eq!(winches.count(), 1);
    let goals = scene.items.iter().filter(|i| matches!(i, Item::Disc { center, .. } if *center == [5.0, 20.0]));
    assert_eq!(goals.count(), 2);
}

#[test]
fn the_most_contracted_fibre_is_the_reddest_and_on_top() {
    let design = design();
    let contracted = Shape { fiber_contractions_mm: vec![0.0, 3.0, 1.0, 0.0, 0.0], ..Shape::clone(&rest(&design)) };
    let shape = Arc::new(contracted);
    let shown = Shown::default().with(Tendons::NAME, false).with(Pins::NAME, false);
    let scene = Layers::of(&Subject { shown: &shown, ..Subject::new(&design, &shape) }).scene();
    let Some(Item::Strands(fibers)) = scene.items.last() else { panic!("no fibre") };
    let (points, _, color) = fibers.iter().last().unwrap();
    assert_eq!(color, Palette::of(Theme::Light).fiber_active);
    assert_eq!(points, [[0.0, 0.0], [10.0, 10.0]]);
}

#[test]
fn a_shape_of_another_mesh_is_not_drawn() {
    let design = design();
    assert_eq!(Layers::of(&Subject::new(&design, &Arc::default())).scene(), Scene::default());
}

#[test]
fn every_stage_of_discovery_has_its_colours() {
    let design = design();
    let palette = Palette::of(Theme::Dark);
    let stages = Arc::new(Stages {
        weights: vec![1.0, 2.0, 0.0, 0.5, 0.0],
        seeds: vec![[0, 1], [2, 3]],
        start: vec![[0, 1]],
        joins: vec![vec![1, 2]],
        tree: vec![[0, 1], [1, 2], [2, 3]],
        winch: 1,
        tendons: vec![vec![1, 0], vec![1, 2, 3]],
        score: 1.0,
    });
    let draw = |stage| {
        let (theme, stage) = (Theme::Dark, Some((stage, &stages)));
        Layers::of(&Subject { theme, stage, ..Subject::new(&design, &rest(&design)) }).scene()
    };
    assert_eq!(lines_of(&draw(Stage::Activation), palette.fiber_active), 1);
    assert_eq!(lines_of(&draw(Stage::Seeds), palette.start), 1);
    assert_eq!(lines_of(&draw(Stage::Tree), palette.join), 1);
    assert_eq!(lines_of(&draw(Stage::Result), palette.proposed), 2);
}

#[test]
fn a_picture_is_the_same_until_the_inputs_of_a_layer_differ() {
    let design = design();
    let shape = rest(&design);
    let subject = Subject::new(&design, &shape);
    let before = Layers::of(&subject);
    assert_eq!(before, Layers::of(&subject));
    let target = Target { at: design.pins[0].at, to: [5.0, 20.0], weight: 1.0 };
    let (moved, hidden) = (rest(&design), Shown::default().with(Fibers::NAME, false));
    let changed = Arc::new(Design { networks: Vec::new(), ..Design::clone(&design) });
    let weave = Arc::new(Weave::clone(&subject.weave));
    let others = [
        Subject { design: &changed, ..subject.clone() },
        Subject { weave, ..subject.clone() },
        Subject { shape: &moved, ..subject.clone() },
        Subject { theme: Theme::Dark, ..subject.clone() },
        Subject { shown: &hidden, ..subject.clone() },
        Subject { targets: &[target], ..subject.clone() },
        Subject { proposed: Some(&design.networks[0]), ..subject.clone() },
    ];
    for other in &others {
        assert_ne!(before, Layers::of(other), "{other:?}");
    }
    // A target that moves leaves all other layers as they are.
    let posed = Layers::of(&others[5]);
    let kept = (0..posed.count()).filter(|&layer| posed.same_in(layer, &before).is_some()).count();
    // The layer of targets is there without any, too.
    assert_eq!((kept, posed.count()), (before.count() - 1, before.count()));
    let drawn: Vec<Item> = (0..posed.count()).flat_map(|layer| posed.scene_of(layer).items).collect();
    assert_eq!(drawn, posed.scene().items);
    // What no layer takes is no reason to draw anew: a document that has another name, or another pose.
    let renamed = Arc::new(Design { name: "other".into(), ..Design::clone(&design) });
    assert_eq!(before, Layers::of(&Subject { design: &renamed, selected_target: Some(3), ..subject }));
}

#[test]
fn fibres_are_seen_on_textures_of_every_colour() {
    use crate::picture::{Texture, raster};
    let design = design();
    let shape = rest(&design);
    let hidden = [Tendons::NAME, Pins::NAME].iter().fold(Shown::default(), |shown, name| shown.with(name, false));
    for theme in [Theme::Light, Theme::Dark] {
        let palette = Palette::of(theme);
        let colors =
            [palette.body, palette.seam, palette.fiber_passive, Color(255, 255, 255, 255), Color(0, 0, 0, 255)];
        for Color(r, g, b, _) in colors.into_iter().chain([Color(200, 30, 40, 255), Color(120, 120, 120, 255)]) {
            let texture = Arc::new(Texture::of(image::RgbaImage::from_pixel(4, 4, image::Rgba([r, g, b, 255]))));
            let picture = |fibers: bool| {
                let shown = hidden.clone().with(Fibers::NAME, fibers);
                let subject =
                    Subject { theme, shown: &shown, texture: Some(&texture), ..Subject::new(&design, &shape) };
                let scene = Layers::of(&subject).scene();
                let png = raster::png(&scene, &scene, (1440, 720), palette.background).unwrap();
                image::load_from_memory(&png).unwrap().to_rgb8()
            };
            let (with, without) = (picture(true), picture(false));
            // Across the diagonal, in the middle of the left view.
            let most = (345..375).map(|x| {
                let (p, q) = (with.get_pixel(x, 360).0, without.get_pixel(x, 360).0);
                p.iter().zip(q).map(|(a, b)| a.abs_diff(b)).max().unwrap()
            });
            assert!(most.max().unwrap() > 60, "{theme:?} {r} {g} {b}");
        }
    }
}

#[test]
fn looks_have_names_and_take_the_place_of_layers_that_are_there() {
    let mut names: Vec<_> = LOOKS.iter().flat_map(|look| [look.name, look.label]).collect();
    let count = names.len();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), count);
    let known = |name: &&str| LAYERS.iter().any(|layer| layer.name == *name);
    assert!(LOOKS.iter().all(|look| look.replaces.iter().all(known) && !look.tip.ends_with('.')));
}

#[test]
fn both_plushies_of_a_look_have_one_scale() {
    let design = design();
    let shape = rest(&design);
    let pulled = |n: f64| Arc::new(Shape { tendon_tensions: vec![n], ..Shape::clone(&shape) });
    let (weak, strong) = (pulled(1.0), pulled(8.0));
    let bar = |shape, beside| {
        Layers::of(&Subject { look: "force", beside: Some(beside), ..Subject::new(&design, shape) }).bar().cloned()
    };
    assert_eq!(bar(&weak, &strong), bar(&strong, &weak));
    assert_eq!(bar(&weak, &strong).unwrap().high, 8.0);
    // Pressed to half its width, and turned: the strain is what remains of the area, the gap how far the corners went.
    let nodes: Vec<_> = shape.nodes.iter().map(|p| [-p[1], 0.5 * p[0]]).collect();
    let pressed = Arc::new(Shape { nodes, ..Shape::clone(&shape) });
    let of =
        |look| Layers::of(&Subject { look, beside: Some(&shape), ..Subject::new(&design, &pressed) }).bar().cloned();
    assert!((of("strain").unwrap().high - 2.0).abs() < 1e-9);
    assert!((of("gap").unwrap().high - (20.0_f64.hypot(5.0))).abs() < 1e-9, "{:?}", of("gap"));
    assert!(of("crumpling").unwrap().high > 0.1 && of("plush").is_none() && of("wireframe").is_none());
}

#[test]
fn names_and_keys_are_told_apart() {
    let mut names: Vec<_> = LAYERS.iter().map(|entry| entry.name).collect();
    let mut keys: Vec<_> = LAYERS.iter().filter_map(|entry| entry.switch?.key).collect();
    let counts = (names.len(), keys.len());
    names.sort_unstable();
    names.dedup();
    keys.sort_unstable();
    keys.dedup();
    assert_eq!((names.len(), keys.len()), counts);
}
