//! What a criterion of networks is.

use super::candidate::{Baseline, Candidate};
use super::trial::Reached;
use crate::design::Design;

/// A measure of a tried-out rig.
pub trait Criterion: Sync {
    /// Cost, dimensionless and at least zero; the costs of all criteria are added. Infinity refuses the rig.
    fn cost(&self, judged: &Judged) -> f64;
}

/// A rig in the poses that it should serve.
pub struct Judged<'a> {
    /// The design without the network that is judged.
    pub design: &'a Design,
    /// `None` for the rig as it was before.
    pub network: Option<&'a Candidate>,
    pub poses: &'a [Baseline<'a>],
    /// What was reached in each pose; empty where the design with the network has no model.
    pub reached: &'a [Reached],
}
