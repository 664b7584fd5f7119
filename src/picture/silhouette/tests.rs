//! Exact at rest and in rigid motions, smooth in bends, round where a disc is stuffed.

use super::tie::doubled_area;
use super::*;
use crate::outline::{Outline, polygon};
use std::f64::consts::PI;

fn circle(count: usize, radius: f64) -> Vec<Point> {
    let at = |i: usize| 2.0 * PI * i as f64 / count as f64;
    (0..count).map(|i| [radius * at(i).cos(), radius * at(i).sin()]).collect()
}

/// A coarse disc: its mesh has far fewer corners than its outline.
fn disc() -> Design {
    let outline = Outline { outer: circle(240, 100.0), holes: Vec::new() };
    let mesh = crate::mesh::generate(&outline, 60).unwrap();
    Design::new("disc", outline, mesh)
}

/// A ring with a hole, as meshes are that come with their own outline.
fn ring() -> Design {
    let (outer, inner) = (circle(12, 100.0), circle(12, 50.0));
    let nodes: Vec<Point> = outer.iter().chain(&inner).copied().collect();
    let triangles = (0..12).flat_map(|i| {
        let j = (i + 1) % 12;
        [[i, j, 12 + i], [j, 12 + j, 12 + i]]
    });
    let mesh = Mesh { nodes: nodes.clone(), triangles: triangles.collect() };
    let hole = inner.iter().rev().copied().collect();
    Design::new("ring", Outline { outer, holes: vec![hole] }, mesh)
}

#[test]
fn at_rest_it_is_the_drawing_and_a_rigid_motion_moves_it_so() {
    for design in [disc(), ring(), crate::design::testing::sample()] {
        let silhouette = Silhouette::of(&design);
        let mesh = Mesh::from((&silhouette, silhouette.rest.clone()));
        // Between the nodes of a mesh that has no other outline the rim is round.
        assert!((mesh.area() / design.outline.area() - 1.0).abs() < 0.05, "{} {}", mesh.area(), design.outline.area());
        let places = silhouette.places(&design.mesh.nodes).unwrap();
        let far = |a: &[Point], b: &[Point]| a.iter().zip(b).map(|(p, q)| polygon::length(*p, *q)).fold(0.0, f64::max);
        assert!(far(&places, &silhouette.rest) < 1e-9);
        let moved = |p: &Point| [7.0 + 0.6 * p[0] - 0.8 * p[1], -3.0 + 0.8 * p[0] + 0.6 * p[1]];
        let nodes: Vec<Point> = design.mesh.nodes.iter().map(moved).collect();
        let expected: Vec<Point> = silhouette.rest.iter().map(moved).collect();
        assert!(far(&silhouette.places(&nodes).unwrap(), &expected) < 1e-9);
        assert!(silhouette.places(&nodes[1..]).is_none());
    }
    let design = disc();
    let silhouette = Silhouette::of(&design);
    for &p in silhouette.rings.iter().flatten() {
        let [x, y] = silhouette.rest[p];
        assert!((x.hypot(y) - 100.0).abs() < 0.1, "{x} {y}");
    }
}

/// Sharpest turn of a line, rad.
fn sharpest(line: &[Point]) -> f64 {
    let count = line.len();
    let turn = |i: usize| {
        let [a, b, c] = [i, i + 1, i + 2].map(|k| line[k % count]);
        doubled_area(a, b, c).atan2((b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1])).abs()
    };
    (0..count).map(turn).fold(0.0, f64::max)
}

#[test]
fn a_bent_body_has_no_corners_that_were_not_drawn() {
    // Bent about an axis: the mesh's own polygon turns by far more at its nodes.
    let bend = |p: &Point| {
        let angle = 0.008 * p[0];
        [(125.0 - p[1]) * angle.sin(), 125.0 - (125.0 - p[1]) * angle.cos()]
    };
    for design in [disc(), ring()] {
        let silhouette = Silhouette::of(&design);
        let nodes: Vec<Point> = design.mesh.nodes.iter().map(bend).collect();
        let places = silhouette.places(&nodes).unwrap();
        let lines = silhouette.lines(&places);
        let polygon: Vec<Point> = design.mesh.boundary()[0].iter().map(|&n| nodes[n]).collect();
        assert!(sharpest(&lines[0]) < 0.4 * sharpest(&polygon), "{} {}", sharpest(&lines[0]), sharpest(&polygon));
        // And lies where the drawing would, bent like the body.
        for (&p, place) in silhouette.rings[0].iter().zip(&lines[0]) {
            assert!(polygon::length(bend(&silhouette.rest[p]), *place) < 3.5, "{place:?}");
        }
    }
}

#[test]
fn corners_of_a_mesh_without_a_drawing_stay() {
    let mut design = crate::design::testing::sample();
    design.outline = Outline { outer: circle(3, 9000.0), holes: Vec::new() };
    let silhouette = Silhouette::of(&design);
    let area = Mesh::from((&silhouette, silhouette.rest.clone())).area();
    assert!((area / design.mesh.area() - 1.0).abs() < 1e-9, "{area} {}", design.mesh.area());
}

#[test]
fn a_disc_becomes_a_ball() {
    let silhouette = Silhouette::of(&disc());
    for (p, &height) in silhouette.rest.iter().zip(&silhouette.heights) {
        let expected = 0.5 * (100.0 * 100.0 - p[0] * p[0] - p[1] * p[1]);
        assert!((height - expected).abs() < 0.04 * 5000.0, "{p:?}: {height}, not {expected}");
    }
}
