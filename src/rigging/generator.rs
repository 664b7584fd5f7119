//! What a generator of candidate networks is.

use super::activation::ActivationGraph;
use super::candidate::{Baseline, Candidate};
use crate::design::Design;
use crate::discovery::{Parameters, Stages};

/// A way to candidate networks.
pub trait Generator: Sync {
    /// Networks for the pose whose activations are given, the most promising first; empty where this way leads nowhere.
    fn generate(&self, given: &Given) -> Vec<Candidate>;
}

/// Everything that a generator may draw on.
pub struct Given<'a> {
    pub design: &'a Design,
    /// What the fibres of the idealized plushie do in the pose at hand.
    pub graph: &'a ActivationGraph,
    /// Networks of Algorithm 2 on that graph, its parameters varied; never empty, the asked parameters first.
    pub found: &'a [(Parameters, Stages)],
    /// All poses that the network should serve.
    pub poses: &'a [Baseline<'a>],
    /// Numbers of tendons, the preferred one first.
    pub tendon_nums: &'a [usize],
}
