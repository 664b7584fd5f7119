//! The quality of a mesh's triangles: coloured by their smallest angle, and by their size.

use super::color::Color;
use super::palette::{Palette, Theme, mix, with_alpha};
use super::scene::{Item, Scene};
use crate::mesh::Mesh;
use crate::mesh::quality::{area, min_angle};

/// Colours from poor to good.
const POOR: Color = Color(200, 40, 40, 255);
const FAIR: Color = Color(240, 200, 80, 255);
const GOOD: Color = Color(70, 150, 110, 255);
/// Smallest angles that have the colours, degrees: what the generator avoids, a usual one, and the most there can be.
const ANGLES_DEG: [f64; 3] = [20.0, 35.0, 60.0];
/// Colours from small to large triangles.
const SMALL: Color = Color(60, 100, 180, 255);
const LARGE: Color = Color(250, 235, 200, 255);
/// Number of shades.
const SHADES: usize = 24;
const EDGE_WIDTH: f32 = 0.8;
const SEAM_WIDTH: f32 = 2.4;

/// Two drawings of the rest mesh: by the smallest angle of each triangle (red 20 degrees and less, yellow 35, green 60), and by
/// size (blue the smallest, pale the largest, in proportion to the length of an edge).
pub fn scenes(mesh: &Mesh, theme: Theme) -> [Scene; 2] {
    let corners = |t: &[usize; 3]| t.map(|n| mesh.nodes[n]);
    let angles: Vec<f64> = mesh.triangles.iter().map(|t| min_angle(corners(t))).collect();
    let sizes: Vec<f64> = mesh.triangles.iter().map(|t| area(corners(t)).max(0.0).sqrt()).collect();
    let (low, high) = sizes.iter().fold((f64::INFINITY, 0.0), |(l, h): (f64, f64), &s| (l.min(s), h.max(s)));
    let extent = (high - low).max(f64::MIN_POSITIVE);
    let by_angle = |t: usize| {
        let [poor, fair, good] = ANGLES_DEG;
        if angles[t] < fair {
            0.5 * (angles[t] - poor) / (fair - poor)
        } else {
            0.5 + 0.5 * (angles[t] - fair) / (good - fair)
        }
    };
    let angle_color =
        |s: f64| if s < 0.5 { mix(POOR, FAIR, 2.0 * s as f32) } else { mix(FAIR, GOOD, 2.0 * s as f32 - 1.0) };
    let by_size = |t: usize| (sizes[t] - low) / extent;
    [scene(mesh, theme, &by_angle, &angle_color), scene(mesh, theme, &by_size, &|s| mix(SMALL, LARGE, s as f32))]
}

/// Every triangle in the colour of its value from 0 to 1.
fn scene(mesh: &Mesh, theme: Theme, value: &dyn Fn(usize) -> f64, color: &dyn Fn(f64) -> Color) -> Scene {
    let palette = Palette::of(theme);
    let mut shades: Vec<Vec<[usize; 3]>> = vec![Vec::new(); SHADES];
    for (t, &triangle) in mesh.triangles.iter().enumerate() {
        let shade = (value(t).clamp(0.0, 1.0) * (SHADES - 1) as f64).round();
        shades[shade as usize].push(triangle);
    }
    let mut scene = Scene::default();
    for (k, triangles) in shades.into_iter().enumerate().filter(|(_, t)| !t.is_empty()) {
        let color = color(k as f64 / (SHADES - 1) as f64);
        scene.items.push(Item::Mesh { points: mesh.nodes.clone(), triangles, color });
    }
    let line = with_alpha(palette.pin, 130);
    for edge in mesh.edges() {
        let points = edge.map(|n| mesh.nodes[n]).to_vec();
        scene.items.push(Item::Line { points, width: EDGE_WIDTH, color: line, closed: false });
    }
    for ring in mesh.boundary() {
        let points = ring.iter().map(|&n| mesh.nodes[n]).collect();
        scene.items.push(Item::Line { points, width: SEAM_WIDTH, color: palette.pin, closed: true });
    }
    scene
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_triangle_is_painted_once_and_slivers_are_red() {
        let mesh = Mesh {
            nodes: vec![[0.0, 0.0], [10.0, 0.0], [5.0, 8.66], [5.0, -0.5]],
            triangles: vec![[0, 1, 2], [0, 3, 1]],
        };
        for scene in scenes(&mesh, Theme::Light) {
            let painted = scene.items.iter().map(|item| match item {
                Item::Mesh { triangles, .. } => triangles.len(),
                _ => 0,
            });
            assert_eq!(painted.sum::<usize>(), 2);
        }
        let [by_angle, _] = scenes(&mesh, Theme::Light);
        let red = by_angle
            .items
            .iter()
            .any(|i| matches!(i, Item::Mesh { color, triangles, .. } if *color == POOR && *triangles == [[0, 3, 1]]));
        assert!(red);
    }
}
