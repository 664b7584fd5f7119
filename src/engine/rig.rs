//! The design loop without a hand: over all poses, solve, discover, try out, accept (section 3).

use crate::design::Design;
use std::sync::atomic::AtomicBool;

/// What the loop may build and try.
#[derive(Clone, Debug, PartialEq)]
pub struct RigOptions {
    pub max_winches: usize,
    pub tendons: TendonChoice,
    /// Parameters of Algorithm 2 held at these values; `None` lets the loop vary them.
    pub seed_num: Option<usize>,
    pub join_depth: Option<usize>,
    pub join_len: Option<usize>,
    pub phi: Option<f64>,
}

/// How many tendons each winch gets.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TendonChoice {
    /// Winch by winch; the last number holds for all further ones.
    PerWinch(Vec<usize>),
    /// Whatever serves best between the two, both included.
    Between(usize, usize),
}

/// Why no rig was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RigError {
    #[error("the design has no pose with targets, so there is nothing to rig for")]
    NoTargets,
    #[error("no network brings any pose closer to its targets")]
    NothingFound,
    #[error("cancelled")]
    Cancelled,
    #[error("rigging is not available")]
    NotAvailable,
}

/// Adds networks to `design` until its poses are served or `options` are used up. `progress` gets one line a step.
pub fn rig(
    design: &Design,
    options: &RigOptions,
    progress: &mut dyn FnMut(&str),
    cancel: &AtomicBool,
) -> Result<Design, RigError> {
    let _ = (options, progress, cancel);
    if design.poses.iter().all(|pose| pose.targets.is_empty()) {
        return Err(RigError::NoTargets);
    }
    Err(RigError::NotAvailable)
}
