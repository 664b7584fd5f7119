//! Soundness of a mesh, and its boundary.

use super::triangulate::doubled_area;
use super::{Mesh, MeshError};
use crate::outline::{Point, polygon};

/// Triangles smaller than this fraction of the mesh's box are taken for flat: rounding of the file format's digits.
const FLAT_FRACTION: f64 = 1e-12;

impl Mesh {
    /// Area of the rest triangles, mm^2.
    pub fn area(&self) -> f64 {
        self.triangles.iter().map(|&t| 0.5 * doubled_area(self.nodes[t[0]], self.nodes[t[1]], self.nodes[t[2]])).sum()
    }

    /// The boundary as loops of nodes, the body on the left: the outer one first and counter-clockwise, then the holes,
    /// clockwise, in the order of their smallest node. Each loop starts at its smallest node.
    ///
    /// On a mesh that [`Mesh::validate`] refuses the loops may be open.
    pub fn boundary(&self) -> Vec<Vec<usize>> {
        let mut sides: Vec<[usize; 2]> =
            self.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
        sides.sort_unstable();
        let rim: Vec<[usize; 2]> =
            sides.iter().filter(|&&[a, b]| sides.binary_search(&[b, a]).is_err()).copied().collect();
        let mut loops = Vec::new();
        let mut used = vec![false; rim.len()];
        for first in 0..rim.len() {
            if std::mem::replace(&mut used[first], true) {
                continue;
            }
            let [start, mut next] = rim[first];
            let mut ring = vec![start];
            while next != start {
                ring.push(next);
                let leaving = rim.partition_point(|side| side[0] < next)..rim.partition_point(|side| side[0] <= next);
                let Some(k) = leaving.into_iter().find(|&k| !used[k]) else { break };
                used[k] = true;
                next = rim[k][1];
            }
            loops.push(ring);
        }
        let area = |ring: &Vec<usize>| polygon::signed_area(&self.ring_points(ring));
        if let Some(outer) =
            (0..loops.len()).max_by(|&a, &b| area(&loops[a]).total_cmp(&area(&loops[b])).then(b.cmp(&a)))
        {
            loops[..=outer].rotate_right(1);
        }
        loops
    }

    fn ring_points(&self, ring: &[usize]) -> Vec<Point> {
        ring.iter().map(|&n| self.nodes[n]).collect()
    }

    /// Checks what the physics relies on: finite distinct nodes, each used; counter-clockwise triangles with area; no
    /// edge shared by more than two; one connected piece without pinched nodes; no node hanging in another's edge.
    ///
    /// # Errors
    /// [`MeshError`]: the first fault found.
    pub fn validate(&self) -> Result<(), MeshError> {
        if self.triangles.is_empty() {
            return Err(MeshError::Empty);
        }
        if let Some(node) = self.nodes.iter().position(|p| !p.iter().all(|v| v.is_finite())) {
            return Err(MeshError::NotFinite { node });
        }
        self.validate_triangles()?;
        self.validate_nodes()?;
        self.validate_topology()
    }

    fn validate_triangles(&self) -> Result<(), MeshError> {
        let (low, high) = polygon::bounding_box(&self.nodes);
        let flat = FLAT_FRACTION * (high[0] - low[0]) * (high[1] - low[1]);
        for (triangle, t) in self.triangles.iter().enumerate() {
            if let Some(&node) = t.iter().find(|&&node| node >= self.nodes.len()) {
                return Err(MeshError::NoSuchNode { triangle, node });
            }
            let doubled = doubled_area(self.nodes[t[0]], self.nodes[t[1]], self.nodes[t[2]]);
            if doubled.is_nan() || doubled <= flat {
                return Err(MeshError::NotCounterClockwise { triangle });
            }
        }
        Ok(())
    }

    fn validate_nodes(&self) -> Result<(), MeshError> {
        let mut used = vec![false; self.nodes.len()];
        for &node in self.triangles.iter().flatten() {
            used[node] = true;
        }
        if let Some(node) = used.iter().position(|used| !used) {
            return Err(MeshError::UnusedNode { node });
        }
        let mut order: Vec<usize> = (0..self.nodes.len()).collect();
        let key = |n: usize| self.nodes[n];
        order.sort_by(|&a, &b| key(a)[0].total_cmp(&key(b)[0]).then(key(a)[1].total_cmp(&key(b)[1])));
        match order.windows(2).find(|w| key(w[0]) == key(w[1])) {
            Some(w) => Err(MeshError::SameNode { a: w[0].min(w[1]), b: w[0].max(w[1]) }),
            None => Ok(()),
        }
    }

    fn validate_topology(&self) -> Result<(), MeshError> {
        // With all triangles counter-clockwise, each directed side may occur once.
        let mut sides: Vec<[usize; 2]> =
            self.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
        sides.sort_unstable();
        if let Some(w) = sides.windows(2).find(|w| w[0] == w[1]) {
            return Err(MeshError::SharedEdge { a: w[0][0], b: w[0][1] });
        }
        let pieces = self.pieces();
        if pieces != 1 {
            return Err(MeshError::Pieces { pieces });
        }
        let mut leaving = vec![0; self.nodes.len()];
        for &[a, b] in &sides {
            leaving[a] += usize::from(sides.binary_search(&[b, a]).is_err());
        }
        if let Some(node) = leaving.iter().position(|&n| n > 1) {
            return Err(MeshError::PinchedNode { node });
        }
        // A node on the inside of another triangle's edge leaves a slit: a loop without area.
        for ring in self.boundary() {
            let points = self.ring_points(&ring);
            let around = polygon::perimeter(&points);
            if polygon::signed_area(&points).abs() < 1e-9 * around * around {
                return Err(MeshError::HangingNode { node: ring[0] });
            }
        }
        Ok(())
    }

    /// Number of parts connected by edges.
    fn pieces(&self) -> usize {
        let mut parent: Vec<usize> = (0..self.nodes.len()).collect();
        fn root(parent: &mut [usize], mut n: usize) -> usize {
            while parent[n] != n {
                parent[n] = parent[parent[n]];
                n = parent[n];
            }
            n
        }
        for t in &self.triangles {
            for other in [t[1], t[2]] {
                let (a, b) = (root(&mut parent, t[0]), root(&mut parent, other));
                parent[a.max(b)] = a.min(b);
            }
        }
        (0..parent.len()).filter(|&n| parent[n] == n).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(nodes: &[Point], triangles: &[[usize; 3]]) -> Mesh {
        Mesh { nodes: nodes.to_vec(), triangles: triangles.to_vec() }
    }

    const SQUARE: [Point; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

    #[test]
    fn a_sound_mesh_passes() {
        let square = mesh(&SQUARE, &[[0, 1, 2], [0, 2, 3]]);
        assert_eq!(square.validate(), Ok(()));
        assert_eq!(square.area(), 1.0);
        assert_eq!(square.boundary(), vec![vec![0, 1, 2, 3]]);
    }

    #[test]
    fn faults_are_told_apart() {
        assert_eq!(Mesh::default().validate(), Err(MeshError::Empty));
        assert_eq!(mesh(&SQUARE, &[[0, 1, 4]]).validate(), Err(MeshError::NoSuchNode { triangle: 0, node: 4 }));
        assert_eq!(
            mesh(&SQUARE, &[[0, 1, 2], [0, 3, 2]]).validate(),
            Err(MeshError::NotCounterClockwise { triangle: 1 })
        );
        assert_eq!(mesh(&SQUARE, &[[0, 1, 1]]).validate(), Err(MeshError::NotCounterClockwise { triangle: 0 }));
        assert_eq!(mesh(&SQUARE, &[[0, 1, 2]]).validate(), Err(MeshError::UnusedNode { node: 3 }));
        assert_eq!(
            mesh(&SQUARE, &[[0, 1, 2], [0, 1, 3], [0, 2, 3]]).validate(),
            Err(MeshError::SharedEdge { a: 0, b: 1 })
        );
        let mut nan = mesh(&SQUARE, &[[0, 1, 2], [0, 2, 3]]);
        nan.nodes[2][1] = f64::NAN;
        assert_eq!(nan.validate(), Err(MeshError::NotFinite { node: 2 }));
        let twice = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]];
        assert_eq!(mesh(&twice, &[[0, 1, 2], [4, 2, 3]]).validate(), Err(MeshError::SameNode { a: 0, b: 4 }));
        let apart = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [5.0, 0.0], [6.0, 0.0], [5.0, 1.0]];
        assert_eq!(mesh(&apart, &[[0, 1, 2], [3, 4, 5]]).validate(), Err(MeshError::Pieces { pieces: 2 }));
        let bow = [[0.0, 0.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]];
        assert_eq!(mesh(&bow, &[[0, 1, 2], [0, 3, 4]]).validate(), Err(MeshError::PinchedNode { node: 0 }));
    }

    #[test]
    fn a_hanging_node_is_found() {
        // Node 4 halves the side 1-2 for the outer pair of triangles, but not for the triangle 0 1 2.
        let nodes = [[0.0, 0.0], [2.0, -1.0], [2.0, 1.0], [4.0, 0.0], [2.0, 0.0]];
        let hanging = mesh(&nodes, &[[0, 1, 2], [1, 3, 4], [4, 3, 2]]);
        assert!(matches!(hanging.validate(), Err(MeshError::HangingNode { .. } | MeshError::PinchedNode { .. })));
    }
}
