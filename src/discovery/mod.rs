//! Network discovery: from co-active fibres to a winch-tendon network (section 6, Algorithm 2).
//!
//! The idealized plushie's fibres form the *activation graph*, whose edge weights are the fibres' contractions. The
//! heaviest edges are the *seeds*; their heaviest component grows to the *winch tree* by joining others over short
//! paths; a root of that tree becomes the winch and some of the ways to its leaves the tendons.
//!
//! Where the paper is silent:
//! - Seeds are the largest contractions, whatever their sign; equal ones by the smaller node ids. The same order decides
//!   which edge of a cycle goes: the last in it.
//! - The starting component has the largest total contraction once the cycles are broken (equal totals: the smallest
//!   node).
//! - A joining path has the fewest edges, then the largest total weight, then the smallest node list from the tree
//!   outward. It may use any fibre. One round of joining sees only the tree of its start. Cycles that paths close are
//!   broken as well.
//! - Candidate tendons overlap where they share an edge, so a set holds one a branch at the root. A root with fewer
//!   than TENDON_NUM branches is skipped. The variance is that of a population.
//! - Equal scores go to the smallest root, then to the smallest sorted list of leaves.
//!
//! Sums that differ only by rounding count as equal.

mod candidates;
mod discover;
mod error;
mod graph;
mod parameters;
pub mod path_variants;
mod select;
mod sets;
mod stages;
mod tree;

pub use candidates::candidates;
pub use discover::{discover, propose};
pub use error::DiscoveryError;
pub use parameters::{Parameters, Spread};
pub use stages::Stages;
