//! The order in which triangles get nodes.

use std::cmp::Ordering;

/// Why a triangle wants a node; the last goes first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Why {
    Size,
    Angle,
    /// So large for its place that it is split whatever its angles: nodes for the angles' sake lie better afterwards.
    Large,
    /// Sees a fixed edge under too large an angle.
    Edge,
}

/// A triangle that wants a node.
pub(super) struct Entry {
    pub why: Why,
    pub weight: f64,
    pub corners: [usize; 3],
    pub triangle: usize,
}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        self.why
            .cmp(&other.why)
            .then(self.weight.total_cmp(&other.weight))
            .then_with(|| other.corners.cmp(&self.corners))
    }
}
impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Entry {}
