//! The rules of sewing, asked of a design: whether a hand can sew its networks.

use super::cables::points;
use super::products::seam;
use crate::design::Design;
use crate::outline::Point;
use crate::sewing::{self, Body, Breach, Rig};

/// Breaches told one by one among the remarks on a blueprint; the others are counted.
const TOLD: usize = 5;

/// Every breach of the design's rules of sewing, at rest; see [`sewing::judge`]. Winches and cables count as networks and tendons do. The
/// turning gap is the one that the pattern leaves open, which may be less than was asked for.
pub fn judge_design(design: &Design) -> Vec<Breach> {
    let rigs = rigs(design);
    let gap_mm = if rigs.is_empty() { 0.0 } else { seam::of(design).gap_mm };
    sewing::judge(&design.sewing, &Body::new(&design.outline), &rigs, gap_mm)
}

/// Pieces of cable that lie outside of the body with its nodes at `nodes`, mm, as many as the mesh has; see [`sewing::judge_pieces`].
pub fn judge_pose(design: &Design, nodes: &[Point]) -> Vec<Breach> {
    let mut posed = design.clone();
    posed.mesh.nodes = nodes.to_vec();
    let ring = |ring: Vec<usize>| ring.into_iter().map(|node| nodes[node]).collect();
    let rings: Vec<Vec<Point>> = design.mesh.boundary().into_iter().map(ring).collect();
    sewing::judge_pieces(rings.iter().map(Vec::as_slice), &rigs(&posed))
}

/// What the maker of a blueprint should know of the rules that it breaks, the most severe breaches first.
pub(super) fn remarks(design: &Design) -> Vec<String> {
    let breaches = judge_design(design);
    let sentence = |breach: &Breach| format!("Hard to sew: {breach}.");
    let mut remarks: Vec<String> = sewing::most_severe(&breaches, TOLD).iter().map(sentence).collect();
    match breaches.len().saturating_sub(TOLD) {
        0 => {}
        1 => remarks.push("Hard to sew: one more place breaks a rule.".into()),
        others => remarks.push(format!("Hard to sew: {others} more places break a rule.")),
    }
    remarks
}

/// The winches of a design with their cables, mm, on its mesh as it lies.
fn rigs(design: &Design) -> Vec<Rig> {
    let rig = |cables: Vec<Vec<Point>>| Rig { winch: cables[0][0], cables };
    design.networks.iter().map(|n| rig(n.tendons.iter().map(|t| points(design, t)).collect())).collect()
}
