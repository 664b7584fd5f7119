//! What is to be meshed.

use super::budget::WorkBudget;
use crate::mesh::sample::Rim;
use crate::mesh::symmetry::Axis;
use crate::mesh::tracks::Sampled;
use crate::outline::{Outline, Point};
use std::cell::{Cell, OnceCell, RefCell};

/// The outline that is to be meshed, or one half of it.
pub(in crate::mesh) struct Subject<'a> {
    /// The whole, for its size and its fit.
    pub(super) whole: &'a Outline,
    pub(super) rim: Rim<'a>,
    pub(super) tracks: &'a [Vec<Point>],
    /// Their nodes at the spacing that was tried last.
    pub(super) sampled: RefCell<Option<(f64, Option<Sampled>)>>,
    pub(super) axis: Option<Axis>,
    pub(super) height: f64,
    /// The closeness that is lost by taking the image of one half for the other, mm.
    pub(super) off: f64,
    /// Vertices of the outline.
    pub(super) vertices: usize,
    /// Work done for the mesh that is sought.
    pub(super) spent: Cell<usize>,
    pub(super) budget: WorkBudget,
    pub(super) has_fine_features: OnceCell<bool>,
    /// Whether an outline may be followed less closely than it should.
    pub(super) lenient: Cell<bool>,
}

/// Boundary nodes of a mesh with `edges` edges: those without an interior node. `None` where the rings cannot have so few.
pub(super) fn most_nodes(outline: &Outline, edges: usize) -> Option<usize> {
    let rings = outline.holes.len() + 1;
    let most = (edges + 3).checked_sub(3 * outline.holes.len())? / 2;
    (most >= 3 * rings).then_some(most)
}
