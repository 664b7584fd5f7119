//! The silhouette as it was drawn, tied to the mesh: smooth in every pose, however coarse the mesh is.
//!
//! A mesh follows its outline from node to node in straight lines. What is seen follows the drawn outline instead: each of its points
//! is tied to the stretch of rim beside it (`rim`) and goes with that. The felt within is cut into cells between those points and the
//! inside of the mesh (`cells`), with a height over the plane as a stuffed body has one
//! (`height`), in an order in which limbs lie over each other as wholes (`order`).

mod cells;
mod height;
mod order;
mod rim;
mod tie;

use crate::design::Design;
use crate::mesh::Mesh;
use crate::outline::Point;
use rim::Rim;
use tie::Tie;

/// Triangles below which the mesh is cut finer, so that light and height look round: thin limbs of a coarse mesh have no node inside.
const LEAST_TRIANGLES: usize = 1500;
/// Most parts that each side of a triangle is cut into for that.
const MOST_PARTS: usize = 4;

/// The drawn silhouette of a design, and the felt within it.
#[derive(Clone, Debug, PartialEq)]
pub struct Silhouette {
    ties: Vec<Tie>,
    rim: Rim,
    /// Places of the points at rest, mm.
    pub rest: Vec<Point>,
    /// Counter-clockwise at rest, over the points; painted in this order limbs lie over the trunk and over each other.
    pub triangles: Vec<[usize; 3]>,
    /// Closed lines of points: the outer one first, the body on their left.
    pub rings: Vec<Vec<usize>>,
    /// Half the square of the height over the plane, mm^2, where a disc becomes a ball; zero on the rim.
    pub heights: Vec<f64>,
}

impl Silhouette {
    /// The silhouette of a design at rest. Where the outline is not the mesh's, a smooth curve through the nodes of the rim that
    /// keeps its corners. Cost: milliseconds; to be kept while [outline and mesh](Self::is_of) stay.
    pub fn of(design: &Design) -> Self {
        let mesh = &design.mesh;
        let finer = (LEAST_TRIANGLES as f64 / mesh.triangles.len().max(1) as f64).sqrt().ceil() as usize;
        let drawn = Rim::drawn(mesh, &design.outline);
        let mut parts = finer.clamp(1, MOST_PARTS);
        loop {
            let cut = cells::cut(mesh, &drawn, parts);
            // Where the outline goes far into a triangle, its pieces are too small to take that up.
            if cut.is_upright || parts == 1 {
                let heights = height::heights(&cut.rest, &cut.triangles, &cut.rings);
                let cells::Cut { ties, rest, triangles, rings, .. } = cut;
                let triangles = order::ordered(&rest, triangles, &heights);
                return Self { ties, rim: drawn, rest, triangles, rings, heights };
            }
            parts -= 1;
        }
    }

    /// Whether it would be the same for another design.
    pub fn is_of(before: &Design, design: &Design) -> bool {
        before.mesh == design.mesh && before.outline == design.outline
    }

    /// Places of all points where the nodes of the mesh are at `nodes`, mm. `None` for nodes of another mesh.
    pub fn places(&self, nodes: &[Point]) -> Option<Vec<Point>> {
        let turns = self.rim.turns(nodes)?;
        let place = |tie: &Tie| match tie {
            Tie::Inside(corners, weights) => {
                [0, 1].map(|k| corners.iter().zip(weights).map(|(&n, w)| w * nodes[n][k]).sum())
            }
            Tie::Rim(tie) => tie.place(nodes, &turns),
        };
        Some(self.ties.iter().map(place).collect())
    }

    /// The closed lines of the rim among [`places`](Self::places).
    pub fn lines(&self, places: &[Point]) -> Vec<Vec<Point>> {
        self.rings.iter().map(|ring| ring.iter().map(|&p| places[p]).collect()).collect()
    }
}

/// Its triangles as a mesh at places.
impl From<(&Silhouette, Vec<Point>)> for Mesh {
    fn from((silhouette, nodes): (&Silhouette, Vec<Point>)) -> Self {
        Self { nodes, triangles: silhouette.triangles.clone() }
    }
}

#[cfg(test)]
mod tests;
