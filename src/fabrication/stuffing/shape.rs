//! A stuffed sheet, solved, and seen from the front.

use super::membrane::Membrane;
use super::relax;
use crate::mesh::{Mesh, subdivided};
use crate::outline::Point;

/// Triangles that a body is solved with, at least: fewer leave thin limbs a row of triangles wide, which cannot round up.
const LEAST_TRIANGLES: usize = 500;
/// Most parts that each edge of a mesh is cut into for that.
const MOST_PARTS: usize = 4;

/// A solved sheet.
pub struct Shape {
    /// Nodes in space, the rim at z = 0, mm.
    pub nodes: Vec<[f64; 3]>,
    /// Nodes seen from the front, moved and turned to lie over the flat ones.
    pub seen: Vec<Point>,
    pub volume_mm3: f64,
    pub thickness_mm: f64,
    /// Whether its forces are in balance.
    pub is_settled: bool,
}

impl Shape {
    /// The stuffed sheet of a mesh, from an earlier one of the same mesh if there is one.
    pub fn of(mesh: &Mesh, before: Option<&[[f64; 3]]>) -> Self {
        let rim = mesh.boundary();
        let membrane = Membrane::new(mesh, &rim);
        let start = before.map_or_else(|| membrane.dome(mesh), <[_]>::to_vec);
        let (nodes, is_settled) = relax::relaxed(&membrane, start);
        let thickness_mm = 2.0 * nodes.iter().map(|p| p[2]).fold(0.0, f64::max);
        let seen = smoothed(&rim, aligned(&rim, &mesh.nodes, &nodes));
        Self { volume_mm3: membrane.volume(&nodes), seen, thickness_mm, is_settled, nodes }
    }
}

/// A mesh fine enough to be solved.
pub fn refined(mesh: &Mesh) -> Mesh {
    let needed = (LEAST_TRIANGLES as f64 / mesh.triangles.len().max(1) as f64).sqrt().ceil() as usize;
    subdivided(mesh, needed.clamp(1, MOST_PARTS))
}

/// The rims of a mesh with its nodes at `places`.
pub fn rings(mesh: &Mesh, places: &[Point]) -> Vec<Vec<Point>> {
    mesh.boundary().into_iter().map(|ring| ring.into_iter().map(|node| places[node]).collect()).collect()
}

/// Places with those of the rim moved to the middle between themselves and their neighbours: a rim that is gathered puckers from node to node, and
/// what is seen is the line through the middle of that.
fn smoothed(rim: &[Vec<usize>], mut places: Vec<Point>) -> Vec<Point> {
    for ring in rim {
        let own: Vec<Point> = ring.iter().map(|&i| places[i]).collect();
        let n = own.len();
        for (k, &i) in ring.iter().enumerate() {
            let (before, after) = (own[(k + n - 1) % n], own[(k + 1) % n]);
            places[i] = [0, 1].map(|c| 0.25 * before[c] + 0.5 * own[k][c] + 0.25 * after[c]);
        }
    }
    places
}

/// Places moved and turned as a whole so that those of the rim of a mesh lie nearest to where they are drawn (least squares).
pub fn over(rim: &[Vec<usize>], drawn: &[Point], seen: &[Point]) -> Vec<Point> {
    let nodes: Vec<[f64; 3]> = seen.iter().map(|p| [p[0], p[1], 0.0]).collect();
    aligned(rim, drawn, &nodes)
}

/// Nodes seen from the front, moved and turned so that their rim lies nearest to the flat one (least squares).
fn aligned(rim: &[Vec<usize>], flat: &[Point], nodes: &[[f64; 3]]) -> Vec<Point> {
    let on_rim: Vec<usize> = rim.iter().flatten().copied().collect();
    let count = on_rim.len().max(1) as f64;
    let mean = |at: &dyn Fn(usize) -> Point| -> Point {
        [0, 1].map(|k| on_rim.iter().map(|&i| at(i)[k]).sum::<f64>() / count)
    };
    let (from, to) = (mean(&|i| [nodes[i][0], nodes[i][1]]), mean(&|i| flat[i]));
    let (mut along, mut across) = (0.0, 0.0);
    for &i in &on_rim {
        let (p, q) = ([nodes[i][0] - from[0], nodes[i][1] - from[1]], [flat[i][0] - to[0], flat[i][1] - to[1]]);
        along += p[0] * q[0] + p[1] * q[1];
        across += p[0] * q[1] - p[1] * q[0];
    }
    let whole = along.hypot(across).max(f64::MIN_POSITIVE);
    let (cosine, sine) = (along / whole, across / whole);
    let turned = |p: &[f64; 3]| {
        let [x, y] = [p[0] - from[0], p[1] - from[1]];
        [to[0] + cosine * x - sine * y, to[1] + sine * x + cosine * y]
    };
    nodes.iter().map(turned).collect()
}
