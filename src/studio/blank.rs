//! A plushie to begin with where there is no other: a rounded cushion.

use crate::design::Design;
use crate::mesh::Mesh;
use crate::outline::{Outline, Point};

/// mm.
const WIDTH: f64 = 240.0;
const HEIGHT: f64 = 150.0;
/// Nodes along the width and the height.
const ACROSS: usize = 13;
const UP: usize = 9;

pub fn design() -> Design {
    let mesh = mesh();
    let outer = mesh.boundary().into_iter().next().unwrap_or_default().into_iter().map(|n| mesh.nodes[n]).collect();
    Design::new("Cushion", Outline { outer, holes: Vec::new() }, mesh)
}

/// A grid whose corners are drawn in.
fn mesh() -> Mesh {
    let node = |i: usize, j: usize| -> Point {
        let (x, y) = (2.0 * i as f64 / (ACROSS - 1) as f64 - 1.0, 2.0 * j as f64 / (UP - 1) as f64 - 1.0);
        // From the square to the disc, two thirds of the way.
        let (u, v) = (x * (1.0 - y * y / 3.0).sqrt(), y * (1.0 - x * x / 3.0).sqrt());
        [WIDTH / 2.0 * (1.0 + u), HEIGHT / 2.0 * (1.0 + v)]
    };
    let nodes = (0..UP).flat_map(|j| (0..ACROSS).map(move |i| node(i, j))).collect();
    let mut triangles = Vec::new();
    for j in 0..UP - 1 {
        for i in 0..ACROSS - 1 {
            let [a, b, c, d] = [j * ACROSS + i, j * ACROSS + i + 1, (j + 1) * ACROSS + i + 1, (j + 1) * ACROSS + i];
            triangles.extend(if (i + j) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
        }
    }
    Mesh { nodes, triangles }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_cushion_is_a_sound_design() {
        super::design().validate().unwrap();
    }
}
