//! Networks as a hand with a needle meets them: where cables run, how long they are, which rules of sewing they break.

use super::{Design, Network, Tendon};
use crate::outline::{Point, polygon};
use crate::sewing::{self, Body, Breach, Rig};

/// A turning gap takes at most this part of the outline: more would leave no seam that holds.
const GAP_LARGEST_PART: f64 = 0.25;

impl Tendon {
    /// The places of its routing with the body's nodes at `nodes`, from the winch to its end, mm.
    pub fn places(&self, nodes: &[Point]) -> Vec<Point> {
        self.routing.iter().map(|point| point.place(nodes)).collect()
    }

    /// Length of its cable with the body's nodes at `nodes`, mm, without slack.
    pub fn cable_mm(&self, nodes: &[Point]) -> f64 {
        self.places(nodes).windows(2).map(|s| polygon::length(s[0], s[1])).sum()
    }

    /// Holes between the winch and its end.
    pub fn holes(&self) -> usize {
        self.routing.len().saturating_sub(2)
    }
}

impl Network {
    /// The winch and its cables with the body's nodes at `nodes`; `None` without tendons.
    pub fn rig(&self, nodes: &[Point]) -> Option<Rig> {
        let cables: Vec<Vec<Point>> = self.tendons.iter().map(|tendon| tendon.places(nodes)).collect();
        Some(Rig { winch: self.winch()?.place(nodes), cables })
    }
}

impl Design {
    /// Length of the seam that stays open to turn and stuff the body, mm: what is asked for, as far as the outline allows.
    pub fn turning_gap_mm(&self) -> f64 {
        let outer = &self.outline.outer;
        let around = (0..outer.len()).map(|k| polygon::length(outer[k], outer[(k + 1) % outer.len()]));
        self.fabrication.turning_gap_mm.min(GAP_LARGEST_PART * around.sum::<f64>())
    }

    /// Every breach of the design's rules of sewing, at rest; see [`sewing::judge`]. Winches and cables count as networks and tendons do.
    /// The turning gap is the one that the pattern leaves open. Networks that are switched off are not judged.
    pub fn breaches(&self) -> Vec<Breach> {
        let rigs = self.rigs(&self.mesh.nodes);
        let gap_mm = if rigs.is_empty() { 0.0 } else { self.turning_gap_mm() };
        self.numbered(sewing::judge(&self.sewing, &Body::new(&self.outline), &rigs, gap_mm))
    }

    /// Pieces of cable that lie outside of the body with its nodes at `nodes`, mm, as many as the mesh has; see [`sewing::judge_pieces`].
    pub fn breaches_in(&self, nodes: &[Point]) -> Vec<Breach> {
        let ring = |ring: Vec<usize>| ring.into_iter().map(|node| nodes[node]).collect();
        let rings: Vec<Vec<Point>> = self.mesh.boundary().into_iter().map(ring).collect();
        self.numbered(sewing::judge_pieces(rings.iter().map(Vec::as_slice), &self.rigs(nodes)))
    }

    /// The networks that act, as the rules of sewing see them.
    fn rigs(&self, nodes: &[Point]) -> Vec<Rig> {
        self.networks.iter().filter(|network| !network.muted).filter_map(|network| network.rig(nodes)).collect()
    }

    /// Breaches of the winches that act, by their numbers among all.
    fn numbered(&self, breaches: Vec<Breach>) -> Vec<Breach> {
        let numbers = self.acting_numbers();
        breaches.into_iter().map(|breach| breach.renumbered(&numbers)).collect()
    }
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
        assert_eq!(design.breaches(), []);
        let judged = |change: &dyn Fn(&mut Design)| {
            let mut changed = design.clone();
            change(&mut changed);
            changed.breaches()
        };
        let at = Place { winch: 0, cable: 0 };
        let strict = judged(&|d| d.sewing.hole_to_seam_mm = 5.0);
        assert_eq!(strict, [Breach::NearSeam { at, hole: 1, distance_mm: 0.0, least_mm: 5.0 }]);
        let gap = judged(&|d| d.fabrication.turning_gap_mm = 20.0);
        assert_eq!(gap, [Breach::HousingAtGap { winch: 0, gap_mm: 20.0, housing_mm: 24.0 }]);
        // At most a quarter of the seam is left open: 60 of 240 mm.
        let mut wide = design.clone();
        wide.fabrication.turning_gap_mm = 500.0;
        assert_eq!(wide.turning_gap_mm(), 60.0);
        let wide = judged(&|d| (d.fabrication.turning_gap_mm, d.sewing.housing_mm) = (500.0, 48.0));
        assert_eq!(wide, []);
        let thin = judged(&|d| (d.networks.clear(), d.sewing.housing_mm = 100.0).1);
        assert!(matches!(thin[..], [Breach::ThinBody { room_mm, .. }] if (room_mm - 48.0).abs() < 0.2), "{thin:?}");
    }

    #[test]
    fn a_pose_is_judged_where_its_nodes_are() {
        let design = cornered();
        assert_eq!(design.breaches_in(&design.mesh.nodes), []);
        // The left side is pushed in to x = 30 but for its corners, the middle beyond it: the straight cable leaves the body.
        let mut design = design;
        design.mesh.nodes.push([0.0, 30.0]);
        design.mesh.triangles = vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 5, 4], [5, 0, 4]];
        design.outline.outer = vec![[0.0, 0.0], [60.0, 0.0], [60.0, 60.0], [0.0, 60.0], [0.0, 30.0]];
        design.validate().expect("sound");
        let mut nodes = design.mesh.nodes.clone();
        (nodes[4], nodes[5]) = ([45.0, 45.0], [30.0, 10.0]);
        // y = x meets the side from (30, 10) to (0, 0) at the corner alone, and that to (0, 60) at x = 22.5.
        let found = design.breaches_in(&nodes);
        let at = Place { winch: 0, cable: 0 };
        let [Breach::Outside { at: place, piece: 0, length_mm, most_mm: OUTSIDE_MM }] = found[..] else {
            panic!("{found:?}")
        };
        assert!(place == at && (length_mm - 22.5 * 2f64.sqrt()).abs() < 1e-12, "{length_mm}");
    }
}
