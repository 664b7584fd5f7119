//! Places where cables and winches pass the felt, and whether there is felt enough around them to cut a hole.

use crate::defaults;
use crate::design::Design;
use crate::fabrication::cables::holes;
use crate::motion::winch_labels;
use crate::outline::Point;
use crate::outline::polygon::length;

/// Least felt between the edge of a hole and the stitches, mm: less tears when the seam is turned.
pub const LEAST_FELT_MM: f64 = 3.0;
/// Least felt between the edges of two holes that are both cut, mm: below, the bridge tears and leaves one hole.
const LEAST_BRIDGE_MM: f64 = 1.0;

/// A place where a cable or a winch passes the felt.
#[derive(Clone, Debug, PartialEq)]
pub struct Passage {
    pub at: Point,
    pub radius_mm: f64,
    /// Its number on every sheet.
    pub number: usize,
    /// The winches whose cables begin there, by their names; none at a plain hole.
    pub winches: Vec<String>,
    /// Felt between its edge and the stitches, mm; negative where they overlap.
    pub felt_mm: f64,
    /// Whether it is cut; otherwise it is marked, and the cable is led through the seam or past the hole beside it.
    pub is_cut: bool,
}

/// The passages of a design, by their numbers. Openings of winches come before the holes beside them.
pub fn passages(design: &Design) -> Vec<Passage> {
    let names = winch_labels(design);
    let near = design.outline.near();
    let winches: Vec<(Point, String)> = design
        .networks
        .iter()
        .zip(names)
        .filter_map(|(network, name)| Some((network.winch()?.place(&design.mesh.nodes), name)))
        .collect();
    let mut all: Vec<Passage> = (1..)
        .zip(holes(design))
        .map(|(number, at)| {
            let own = winches.iter().filter(|w| w.0 == at).map(|w| w.1.clone());
            let winches: Vec<String> = own.collect();
            let radius_mm = if winches.is_empty() {
                0.5 * design.fabrication.tendon_hole_mm
            } else {
                0.5 * defaults::WINCH_OPENING_MM
            };
            let distance = near.distance(at);
            let depth = if design.outline.contains(at) { distance } else { -distance };
            let felt_mm = depth - radius_mm;
            Passage { at, radius_mm, number, winches, felt_mm, is_cut: felt_mm >= LEAST_FELT_MM }
        })
        .collect();
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_by_key(|&i| all[i].winches.is_empty());
    for (k, &i) in order.iter().enumerate() {
        let beside = |&j: &usize| {
            all[j].is_cut && length(all[i].at, all[j].at) < all[i].radius_mm + all[j].radius_mm + LEAST_BRIDGE_MM
        };
        if order[..k].iter().any(beside) {
            all[i].is_cut = false;
        }
    }
    all
}
