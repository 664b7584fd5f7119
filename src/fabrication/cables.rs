//! How the cables run: holes of the felt, and lengths.

use crate::design::{Design, Tendon};
use crate::outline::Point;
use std::collections::HashSet;

/// The places at rest where cables pass the felt, mm, each once, in the order in which routings reach them. The hole at
/// `holes[i]` has the number `i + 1` on every sheet.
pub fn holes(design: &Design) -> Vec<Point> {
    let mut seen = HashSet::new();
    let tendons = design.networks.iter().flat_map(|n| &n.tendons);
    tendons.flat_map(|t| points(design, t)).filter(|p| seen.insert(p.map(f64::to_bits))).collect()
}

/// Length of a tendon at assembly, mm: the polyline of its routing and its slack, from the winch to its end.
pub fn tendon_length_mm(design: &Design, tendon: &Tendon) -> f64 {
    tendon.cable_mm(&design.mesh.nodes) + tendon.slack_mm
}

/// The places of a tendon's routing at rest, from the winch to its end, mm.
pub fn points(design: &Design, tendon: &Tendon) -> Vec<Point> {
    tendon.places(&design.mesh.nodes)
}
