//! What a rig still misses of its poses.

use crate::engine::target_error;
use crate::rigging::criterion::{Criterion, Judged};
use crate::rigging::{Baseline, Reached};

/// The fourth powers of the errors relative to the rest pose, summed, so that the worst pose counts most. Infinite where nothing
/// was reached.
pub(super) struct PoseError;

impl Criterion for PoseError {
    fn cost(&self, judged: &Judged) -> f64 {
        let &Judged { design, poses, reached, .. } = judged;
        if reached.len() != poses.len() {
            return f64::INFINITY;
        }
        let ratio = |pose: &Baseline, reached: &Reached| {
            let rest = target_error(design, pose.targets, &design.mesh.nodes);
            if rest > 0.0 { reached.error / rest } else { 0.0 }
        };
        poses.iter().zip(reached).map(|(p, r)| ratio(p, r).powi(4)).sum()
    }
}
