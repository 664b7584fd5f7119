//! What the inaccuracy of a hand costs: a rig sewn a few times, no hole where it should be.
//!
//! A frictionless search likes places where a millimetre decides. In every draw each hole lies [`defaults::SEWN_HOLE_MM`] away from its
//! mark, in a random direction, and each winch [`defaults::SEWN_WINCH_MM`]; the winches are then wound as serves the pose best, which is what
//! somebody does who has sewn a plushie. The draws are the same for every rig, so that rigs compare.

use super::checked::Checked;
use crate::defaults;
use crate::design::{Design, MaterialPoint, Target};
use crate::outline::Point;
use crate::random::Random;
use crate::threads::in_order;
use serde::Serialize;
use std::sync::atomic::{AtomicBool, Ordering};

/// Seed of the draws.
const SEED: u64 = 1;

/// The error of a pose over several plushies sewn by hand: rms distances of the targets in body lengths, with friction where there is
/// any. Infinite where a pose has no figure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Sewn {
    pub median: f64,
    pub worst: f64,
}

impl Sewn {
    /// What a maker may expect of a pose that misses by `exact` as it is drawn: the mean of that, of the plushie that is sewn as most are and of
    /// the one that is sewn worst. A hand that is careful comes near the first, and where sewing seems to help it is luck.
    pub fn expected(self, exact: f64) -> f64 {
        (exact + self.median.max(exact) + self.worst.max(exact)) / 3.0
    }
}

/// What sewing costs each pose, given by its targets. Empty without winches, and when cancelled.
pub fn sewn(design: &Design, poses: &[&[Target]], friction: f64, cancel: &AtomicBool) -> Vec<Sewn> {
    if design.networks.is_empty() {
        return Vec::new();
    }
    let draws: Vec<Design> = (0..defaults::SEWN_DRAWS).map(|draw| by_hand(design, draw)).collect();
    let all: Vec<(&[Target], &Design)> = poses.iter().flat_map(|pose| draws.iter().map(move |d| (*pose, d))).collect();
    let errors = in_order(&all, |(targets, sewn)| Checked::of(sewn, targets, friction, cancel).real_error());
    if cancel.load(Ordering::Relaxed) {
        return Vec::new();
    }
    let summary = |errors: &[f64]| {
        let mut sorted = errors.to_vec();
        sorted.sort_by(f64::total_cmp);
        Sewn { median: sorted[sorted.len() / 2], worst: sorted[sorted.len() - 1] }
    };
    errors.chunks_exact(defaults::SEWN_DRAWS).map(summary).collect()
}

/// The design as a hand sews it. Holes that would be outside of the body are at its rim.
///
/// `draw`: which plushie; a search judges rigs by the first [`defaults::SEWN_DRAWS`].
pub fn by_hand(design: &Design, draw: usize) -> Design {
    let random = &mut Random::of(SEED, "sewn", draw as u64);
    let mut sewn = design.clone();
    let moved = |point: &MaterialPoint, by_mm: f64, direction: Point| {
        let [x, y] = point.place(&design.mesh.nodes);
        let there = [x + by_mm * direction[0], y + by_mm * direction[1]];
        design.mesh.locate_nearest(there, &design.mesh.nodes).map_or_else(
            || point.clone(),
            |(at, _)| MaterialPoint::of_triangle(design.mesh.triangles[at.triangle], at.weights),
        )
    };
    for network in &mut sewn.networks {
        let winch = random.direction();
        for tendon in &mut network.tendons {
            for (k, point) in tendon.routing.iter_mut().enumerate() {
                *point = match k {
                    0 => moved(point, defaults::SEWN_WINCH_MM, winch),
                    _ => moved(point, defaults::SEWN_HOLE_MM, random.direction()),
                };
            }
        }
    }
    sewn
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::testing;

    #[test]
    fn what_may_be_expected_lies_between_the_drawing_and_the_worst_hand() {
        let sewn = Sewn { median: 0.05, worst: 0.09 };
        assert!((sewn.expected(0.01) - 0.05).abs() < 1e-15);
        let is = |exact: f64, expected: f64| (sewn.expected(exact) - expected).abs() < 1e-15;
        assert!(is(0.07, 0.23 / 3.0) && is(0.1, 0.1));
        assert_eq!(Sewn { worst: f64::INFINITY, ..sewn }.expected(0.01), f64::INFINITY);
    }

    #[test]
    fn every_hole_is_off_by_as_much_and_the_cables_of_a_winch_stay_together() {
        let design = testing::sample();
        let mut different = false;
        for draw in 0..defaults::SEWN_DRAWS {
            let sewn = by_hand(&design, draw);
            sewn.validate().expect("sound");
            assert_eq!(sewn, by_hand(&design, draw));
            different |= sewn != by_hand(&design, draw + 1);
            for (before, after) in design.networks.iter().zip(&sewn.networks) {
                assert!(after.tendons.iter().all(|tendon| Some(&tendon.routing[0]) == after.winch()));
                for (before, after) in before.tendons.iter().zip(&after.tendons) {
                    for (k, (p, q)) in before.routing.iter().zip(&after.routing).enumerate() {
                        let [p, q] = [p, q].map(|point| point.place(&design.mesh.nodes));
                        let (far, most) = ((q[0] - p[0]).hypot(q[1] - p[1]), if k == 0 { 1.0 } else { 2.0 });
                        let at_rim = [p, q].iter().flatten().any(|v| v.min(60.0 - v) < 2.0);
                        assert!(far <= most + 1e-9 && (at_rim || (far - most).abs() < 1e-9), "{far} {most}");
                    }
                }
            }
        }
        assert!(different);
    }

    #[test]
    fn sewing_costs_little_where_it_hardly_matters_and_is_told_for_every_pose() {
        let design = testing::sample();
        let go = AtomicBool::new(false);
        let poses: Vec<&[Target]> =
            design.poses.iter().map(|p| p.targets.as_slice()).filter(|t| !t.is_empty()).collect();
        let found = sewn(&design, &poses, 0.0, &go);
        assert_eq!(found.len(), poses.len());
        for (targets, sewn) in poses.iter().zip(&found) {
            let exact = Checked::of(&design, targets, 0.0, &go).error();
            assert!(sewn.median <= sewn.worst && (sewn.median - exact).abs() < 0.05, "{sewn:?} {exact}");
        }
        assert_eq!(found, sewn_again(&design, &poses));
        let bare = Design { networks: Vec::new(), keyframes: Vec::new(), ..design.clone() };
        assert!(sewn(&bare, &poses, 0.0, &go).is_empty());
        assert!(sewn(&design, &poses, 0.0, &AtomicBool::new(true)).is_empty());
    }

    fn sewn_again(design: &Design, poses: &[&[Target]]) -> Vec<Sewn> {
        sewn(design, poses, 0.0, &AtomicBool::new(false))
    }
}
