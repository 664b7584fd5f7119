//! How the cables run: holes of the felt, and lengths.

use crate::design::{Design, Tendon};
use crate::outline::{Point, polygon};
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
    let points = points(design, tendon);
    points.windows(2).map(|s| polygon::length(s[0], s[1])).sum::<f64>() + tendon.slack_mm
}

/// The places of a tendon's routing at rest, from the winch to its end, mm.
pub fn points(design: &Design, tendon: &Tendon) -> Vec<Point> {
    tendon.routing.iter().map(|point| point.place(&design.mesh.nodes)).collect()
}
