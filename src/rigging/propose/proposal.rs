//! A proposal, and the options of the search for it.

use crate::design::Network;
use crate::discovery::{Parameters, Stages};
use crate::engine::Shape;
use crate::rigging::Sewn;
use crate::sewing::Breach;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What a network of Algorithm 2 was found with.
pub(super) type Paper = Option<(Parameters, Arc<Stages>)>;

/// A pose counts as served where a network takes this part of its error or more.
const SERVED: f64 = 0.2;

/// What may be proposed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct ProposeOptions {
    /// Of Algorithm 2; its TENDON_NUM is the number of tendons of all networks.
    pub parameters: Parameters,
    /// Whether networks of fewer tendons are proposed as well.
    pub fewer: bool,
    /// Whether only what keeps the rules of sewing is proposed.
    pub rules: bool,
    pub seed: u64,
}

impl Default for ProposeOptions {
    fn default() -> Self {
        Self { parameters: Parameters::default(), fewer: true, rules: true, seed: 1 }
    }
}

/// A network for a pose, with what a check says of the design that has it. Errors are rms distances of the targets in body lengths.
#[derive(Clone, Debug)]
pub struct Proposal {
    pub network: Network,
    /// All poses with targets, as the design has them; where the targets at hand are of none, they come last.
    pub poses: Vec<PoseServed>,
    /// The pose at hand among them.
    pub current: usize,
    /// What remains of the pose at hand when a hand sews the network; `None` where that was not worked out.
    pub sewn: Option<Sewn>,
    /// Cable from the winch to the ends, all tendons together.
    pub thread_mm: f64,
    /// Holes between the winch and the ends.
    pub holes: usize,
    /// Largest turn at one hole, and of one cable in all, degrees.
    pub turn_degrees: f64,
    pub turning_degrees: f64,
    /// Largest force in one of its cables over all poses, without friction, N.
    pub force_n: f64,
    /// Largest pull of all its cables together over all poses, each by its ratio, N: with the spool's radius what they ask of the motor.
    pub spool_n: f64,
    /// Rules of sewing that the design would break and in which this network has a part, at rest and in every pose.
    pub breaches: Vec<Breach>,
    /// The realizable plushie with this network, in the pose at hand.
    pub preview: Arc<Shape>,
    /// The parameters and stages of Algorithm 2 (fig. 6), where it has found this network. Its points have moved since where the rules ask
    /// for that.
    pub paper: Option<(Parameters, Arc<Stages>)>,
}

/// A pose without and with a network.
#[derive(Clone, Debug, PartialEq)]
pub struct PoseServed {
    /// `None`: the targets at hand, where no pose has them.
    pub name: Option<String>,
    pub before: f64,
    pub after: f64,
    /// Both when cables rub, where the design has friction; infinite where there is no such figure.
    pub with_friction: Option<[f64; 2]>,
}

impl PoseServed {
    /// Whether the network brings it closer to its targets.
    pub fn is_served(&self) -> bool {
        let [before, after] = self.with_friction.unwrap_or([self.before, self.after]);
        after <= (1.0 - SERVED) * before
    }
}

impl Proposal {
    /// Error of the pose at hand without the network; without friction, as [`Self::error_after`].
    pub fn error_before(&self) -> f64 {
        self.poses[self.current].before
    }

    /// Error of the pose at hand with the network.
    pub fn error_after(&self) -> f64 {
        self.poses[self.current].after
    }

    /// The names of the poses that it serves.
    pub fn serves(&self) -> impl Iterator<Item = &str> {
        self.poses.iter().filter(|pose| pose.is_served()).map(|pose| pose.name.as_deref().unwrap_or("this pose"))
    }

    /// The error that proposals are sorted by: as sewn by hand where that is known, with friction where there is any.
    pub fn rank(&self) -> f64 {
        let current = &self.poses[self.current];
        let exact = current.with_friction.map_or(current.after, |[_, after]| after);
        self.sewn.map_or(exact, |sewn| sewn.median.max(exact))
    }
}
