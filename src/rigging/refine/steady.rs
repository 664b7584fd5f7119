//! Fits improved for plushies as a hand sews them, too: no hole quite where it should be.
//!
//! A valley of `C` can be so narrow that two millimetres at a hole lose the pose. So a fit is improved together with samples of its own layout
//! in which every hole and winch is off ([`defaults::SEWN_HOLE_MM`], [`defaults::SEWN_WINCH_MM`]), each with activations of its own,
//! for
//!
//! ```text
//! C + (1 / m) sum_s C_s
//! ```
//!
//! with `m` samples `s`, which come in opposite pairs, so that their mean is the layout itself. The rules count for the layout alone.

use super::improve::improved_together;
use super::local::{Sample, cost};
use super::task::{Fit, Task};
use crate::defaults;
use crate::random::Random;
use crate::rigging::layout::Layout;

/// Pairs of samples, and how often they are drawn anew.
const PAIRS: usize = 2;
const DRAWS: usize = 2;
/// Steps in which the activations of a sample follow it, and those of all together.
const FOLLOWING: usize = 8;
const TOGETHER: usize = 15;
/// Seed of the draws: others than those by which rigs are judged in the end.
const SEED: u64 = 2;

impl Task<'_> {
    /// A fit improved for sewn plushies too; as it was where that gains nothing.
    pub fn steadied(&self, fit: Fit, stop: &dyn Fn() -> bool) -> Fit {
        let bare = Task {
            poses: self.poses.clone(),
            served: self.served.clone(),
            rings: self.rings.clone(),
            sewable: None,
            ..*self
        };
        let mut now = fit;
        for draw in 0..DRAWS {
            let Some(samples) = self.samples(&bare, &now, draw, stop) else { break };
            let before = cost(&samples);
            let after = improved_together(samples, TOGETHER, false, stop);
            if cost(&after) >= before || stop() {
                break;
            }
            // What is seen in one plushie must be so when it is wound from rest.
            let Some(wound) = after.into_iter().next().and_then(|sample| self.wound(sample.fit, 0, stop)) else {
                break;
            };
            now = wound;
        }
        now
    }

    /// The layout itself, and as a hand may sew it.
    fn samples<'t>(
        &'t self,
        bare: &'t Task<'t>,
        fit: &Fit,
        draw: usize,
        stop: &dyn Fn() -> bool,
    ) -> Option<Vec<Sample<'t>>> {
        let mut samples = vec![Sample { task: self, fit: fit.clone(), built: self.build(&fit.layout)?, weight: 1.0 }];
        for pair in 0..PAIRS {
            for sign in [1.0, -1.0] {
                let layout = self.off(&fit.layout, (draw * PAIRS + pair) as u64, sign);
                let begun = bare.resume(layout, fit, stop)?;
                let followed = bare.wound(bare.improve(begun, FOLLOWING, true, stop), 0, stop)?;
                let built = bare.build(&followed.layout)?;
                samples.push(Sample { task: bare, fit: followed, built, weight: 0.5 / PAIRS as f64 });
            }
        }
        Some(samples)
    }

    /// A layout whose points are all off; those that would leave the body stay.
    fn off(&self, layout: &Layout, number: u64, sign: f64) -> Layout {
        let random = &mut Random::of(SEED, "steadied", number);
        let mut out = layout.clone();
        let mesh = &self.design.mesh;
        for spot in layout.spots() {
            let by = sign * if spot.cable.is_none() { defaults::SEWN_WINCH_MM } else { defaults::SEWN_HOLE_MM };
            let (at, way) = (layout.point(spot), random.direction());
            let there = [at[0] + by * way[0], at[1] + by * way[1]];
            if mesh.locate(there, &mesh.nodes).is_some() {
                *out.point_mut(spot) = there;
            }
        }
        out
    }
}
