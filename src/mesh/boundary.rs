//! A boundary as nodes and edges.

use crate::outline::Point;

/// Sampled boundary. Nodes of a ring are consecutive and in the ring's order.
#[derive(Clone, Debug, Default)]
pub(super) struct Boundary {
    pub nodes: Vec<Point>,
    /// Ring and arc length of each node.
    pub places: Vec<(usize, f64)>,
    /// Index pairs of consecutive nodes: the constrained edges.
    pub segments: Vec<[usize; 2]>,
}
