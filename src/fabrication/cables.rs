//! How the cables run: holes of the felt, and lengths.

use crate::design::{Design, Tendon};
use crate::outline::{Point, polygon};
use std::collections::HashSet;

/// The mesh nodes at which cables pass the felt, each once, in the order in which routings reach them. The hole of
/// `holes[i]` has the number `i + 1` on every sheet.
pub fn holes(design: &Design) -> Vec<usize> {
    let mut seen = HashSet::new();
    let tendons = design.networks.iter().flat_map(|n| &n.tendons);
    tendons.flat_map(|t| &t.routing).copied().filter(|&node| seen.insert(node)).collect()
}

/// Length of a tendon at assembly, mm: the polyline of its routing and its slack, from the winch to its end.
pub fn tendon_length_mm(design: &Design, tendon: &Tendon) -> f64 {
    let points = points(design, tendon);
    points.windows(2).map(|s| polygon::length(s[0], s[1])).sum::<f64>() + tendon.slack_mm
}

/// The places of a tendon's routing at rest, from the winch to its end, mm.
pub fn points(design: &Design, tendon: &Tendon) -> Vec<Point> {
    tendon.routing.iter().map(|&node| design.mesh.nodes[node]).collect()
}
