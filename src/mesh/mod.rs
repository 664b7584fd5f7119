//! Outline to triangle mesh, and points of the body.
//!
//! [`generate()`] makes a mesh with an asked number of edges; [`Mesh::validate`] says whether one from a file is sound;
//! [`Mesh::locate`] finds the point of the body at a place.

mod boundary;
mod check;
mod circle;
mod curve;
mod generate;
mod grid;
pub mod limbs;
mod locate;
mod order;
pub mod quality;
mod queue;
mod refine;
mod sample;
mod search;
mod smooth;
mod subdivide;
mod symmetry;
mod tracks;
mod tri;
mod triangulate;

pub use generate::{MAX_FIBERS, MeshSpec, Meshed, Size, build, build_or_finer, generate};
pub use subdivide::subdivided;
pub use symmetry::{Axis, axis, is_mirrored};

use crate::outline::Point;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A triangle mesh of the rest silhouette. Triangles are counter-clockwise, 0-based.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Mesh {
    /// Rest positions `X`, mm.
    pub nodes: Vec<Point>,
    pub triangles: Vec<[usize; 3]>,
}

/// A material point of the body: a triangle and the barycentric weights of its three nodes (they sum to 1).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodyPoint {
    pub triangle: usize,
    pub weights: [f64; 3],
}

/// Why there is no mesh, or a mesh is refused.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum MeshError {
    #[error("the outline is not a simple polygon with an area")]
    BadOutline,
    #[error("a tendon track is not finite")]
    BadTrack,
    #[error("no mesh of this outline has {asked} muscle fibres; the nearest possible count found is {nearest}")]
    Unreachable { asked: usize, nearest: usize },
    #[error("the outline is too fine to be meshed: not even {most} muscle fibres give good triangles")]
    TooFine { most: usize },
    #[error(
        "the outline is too intricate: no mesh with good triangles was found within the work allowed; fill its holes or widen its thin parts"
    )]
    TooIntricate,
    #[error(
        "the tendon tracks are too intricate: the outline can be meshed, but no mesh with good triangles that follows them was found within the work allowed; give them fewer points, keep them farther apart, let them cross less often, or leave them out"
    )]
    IntricateTracks,
    #[error("the mesh has no triangles")]
    Empty,
    #[error("node {node} of the mesh is not finite")]
    NotFinite { node: usize },
    #[error("triangle {triangle} names node {node}, which does not exist")]
    NoSuchNode { triangle: usize, node: usize },
    #[error("triangle {triangle} is flat or not counter-clockwise")]
    NotCounterClockwise { triangle: usize },
    #[error("node {node} belongs to no triangle")]
    UnusedNode { node: usize },
    #[error("nodes {a} and {b} are at the same place")]
    SameNode { a: usize, b: usize },
    #[error("the edge from node {a} to {b} is used twice in the same direction: triangles overlap")]
    SharedEdge { a: usize, b: usize },
    #[error("the mesh falls into {pieces} pieces")]
    Pieces { pieces: usize },
    #[error("the mesh hangs together by the single node {node}")]
    PinchedNode { node: usize },
    #[error("node {node} hangs in the middle of another triangle's edge")]
    HangingNode { node: usize },
}

impl Mesh {
    /// The undirected edges `[i, j]`, `i < j`, each once, in lexicographic order: the muscle fibres of the paper.
    pub fn edges(&self) -> Vec<[usize; 2]> {
        let mut edges: Vec<[usize; 2]> = self
            .triangles
            .iter()
            .flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]])
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// The nodes beside each node, by their numbers.
    pub fn neighbours(&self) -> Vec<Vec<usize>> {
        let mut beside = vec![Vec::new(); self.nodes.len()];
        for [a, b] in self.edges() {
            beside[a].push(b);
            beside[b].push(a);
        }
        beside
    }

    /// Where a body point is when the nodes are at `positions`.
    pub fn position(&self, at: &BodyPoint, positions: &[Point]) -> Point {
        let mut p = [0.0; 2];
        for (&node, &weight) in self.triangles[at.triangle].iter().zip(&at.weights) {
            p[0] += weight * positions[node][0];
            p[1] += weight * positions[node][1];
        }
        p
    }

    /// The body point that is exactly `node` (the first triangle that has it), or `None` for a node without a triangle.
    pub fn node_point(&self, node: usize) -> Option<BodyPoint> {
        let triangle = self.triangles.iter().position(|t| t.contains(&node))?;
        let weights = self.triangles[triangle].map(|n| if n == node { 1.0 } else { 0.0 });
        Some(BodyPoint { triangle, weights })
    }

    /// The node nearest to `p` when the nodes are at `positions`; ties go to the smaller id.
    pub fn nearest_node(&self, p: Point, positions: &[Point]) -> usize {
        let distance2 = |q: &Point| (q[0] - p[0]).powi(2) + (q[1] - p[1]).powi(2);
        (0..positions.len()).min_by(|&a, &b| distance2(&positions[a]).total_cmp(&distance2(&positions[b]))).unwrap_or(0)
    }

    /// The longer side of the box around the rest nodes, mm: the unit in which pose errors are stated.
    pub fn body_length(&self) -> f64 {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for p in &self.nodes {
            for axis in 0..2 {
                low[axis] = low[axis].min(p[axis]);
                high[axis] = high[axis].max(p[axis]);
            }
        }
        (high[0] - low[0]).max(high[1] - low[1])
    }
}
