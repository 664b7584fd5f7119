//! The rules of sewing, asked of a design: whether a hand can sew its networks.

use super::cables::points;
use super::piece::gap_mm;
use crate::design::Design;
use crate::motion::winch_labels;
use crate::outline::Point;
use crate::sewing::{self, Body, Breach, Rig};

/// Breaches told one by one among the remarks on a blueprint; the others are counted.
const TOLD: usize = 5;

/// Every breach of the design's rules of sewing, at rest; see [`sewing::judge`]. Winches and cables count as networks and tendons do. The
/// turning gap is the one that the pattern leaves open, which may be less than was asked for. Networks that are switched off are not judged.
pub fn judge_design(design: &Design) -> Vec<Breach> {
    let rigs = rigs(design);
    let gap_mm = if rigs.is_empty() { 0.0 } else { gap_mm(design) };
    numbered(design, sewing::judge(&design.sewing, &Body::new(&design.outline), &rigs, gap_mm))
}

/// Pieces of cable that lie outside of the body with its nodes at `nodes`, mm, as many as the mesh has; see [`sewing::judge_pieces`].
pub fn judge_pose(design: &Design, nodes: &[Point]) -> Vec<Breach> {
    let mut posed = design.clone();
    posed.mesh.nodes = nodes.to_vec();
    let ring = |ring: Vec<usize>| ring.into_iter().map(|node| nodes[node]).collect();
    let rings: Vec<Vec<Point>> = design.mesh.boundary().into_iter().map(ring).collect();
    numbered(design, sewing::judge_pieces(rings.iter().map(Vec::as_slice), &rigs(&posed)))
}

/// Remarks for the maker of a blueprint on the rules that it breaks, the most severe breaches first.
pub(super) fn remarks(design: &Design) -> Vec<String> {
    let breaches = judge_design(design);
    let names = winch_labels(design);
    let sentence = |breach: &Breach| format!("Hard to sew: {}.", breach.words(&names));
    let mut remarks: Vec<String> = sewing::most_severe(&breaches, TOLD).iter().map(sentence).collect();
    match breaches.len().saturating_sub(TOLD) {
        0 => {}
        1 => remarks.push("Hard to sew: one more place breaks a rule.".into()),
        others => remarks.push(format!("Hard to sew: {others} more places break a rule.")),
    }
    remarks
}

/// Breaches of the winches that act, by their numbers among all.
fn numbered(design: &Design, breaches: Vec<Breach>) -> Vec<Breach> {
    let numbers = design.acting_numbers();
    breaches.into_iter().map(|breach| breach.renumbered(&numbers)).collect()
}

/// The winches of a design that act, with their cables, mm, on its mesh as it lies.
fn rigs(design: &Design) -> Vec<Rig> {
    let rig = |cables: Vec<Vec<Point>>| Rig { winch: cables[0][0], cables };
    design
        .networks
        .iter()
        .filter(|n| !n.muted)
        .map(|n| rig(n.tendons.iter().map(|t| points(design, t)).collect()))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::testing;
    use crate::sewing::{OUTSIDE_MM, Place, Rules};

    /// The sample with one cable from the middle to a corner, and rules that nothing else breaks.
    fn cornered() -> Design {
        let mut design = testing::sample();
        design.networks.truncate(1);
        design.keyframes.clear();
        design.networks[0].tendons.truncate(1);
        design.sewing = Rules { hole_to_seam_mm: 0.0, ..Rules::default() };
        design
    }

    #[test]
    fn a_design_is_judged_by_its_own_rules_and_gap() {
        let design = cornered();
        assert_eq!(judge_design(&design), []);
        let judged = |change: &dyn Fn(&mut Design)| {
            let mut changed = design.clone();
            change(&mut changed);
            judge_design(&changed)
        };
        let at = Place { winch: 0, cable: 0 };
        let strict = judged(&|d| d.sewing.hole_to_seam_mm = 5.0);
        assert_eq!(strict, [Breach::NearSeam { at, hole: 1, distance_mm: 0.0, least_mm: 5.0 }]);
        let gap = judged(&|d| d.fabrication.turning_gap_mm = 20.0);
        assert_eq!(gap, [Breach::HousingAtGap { winch: 0, gap_mm: 20.0, housing_mm: 24.0 }]);
        // At most a quarter of the seam is left open: 60 of 240 mm.
        let wide = judged(&|d| (d.fabrication.turning_gap_mm, d.sewing.housing_mm) = (500.0, 48.0));
        assert_eq!(wide, []);
        let thin = judged(&|d| (d.networks.clear(), d.sewing.housing_mm = 100.0).1);
        assert!(matches!(thin[..], [Breach::ThinBody { room_mm, .. }] if (room_mm - 48.0).abs() < 0.2), "{thin:?}");
    }

    #[test]
    fn a_pose_is_judged_where_its_nodes_are() {
        let design = cornered();
        assert_eq!(judge_pose(&design, &design.mesh.nodes), []);
        // The left side is pushed in to x = 30 but for its corners, the middle beyond it: the straight cable leaves the body.
        let mut design = design;
        design.mesh.nodes.push([0.0, 30.0]);
        design.mesh.triangles = vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 5, 4], [5, 0, 4]];
        design.outline.outer = vec![[0.0, 0.0], [60.0, 0.0], [60.0, 60.0], [0.0, 60.0], [0.0, 30.0]];
        design.validate().expect("sound");
        let mut nodes = design.mesh.nodes.clone();
        (nodes[4], nodes[5]) = ([45.0, 45.0], [30.0, 10.0]);
        // y = x meets the side from (30, 10) to (0, 0) at the corner alone, and that to (0, 60) at x = 22.5.
        let found = judge_pose(&design, &nodes);
        let at = Place { winch: 0, cable: 0 };
        let [Breach::Outside { at: place, piece: 0, length_mm, most_mm: OUTSIDE_MM }] = found[..] else {
            panic!("{found:?}")
        };
        assert!(place == at && (length_mm - 22.5 * 2f64.sqrt()).abs() < 1e-12, "{length_mm}");
    }
}
