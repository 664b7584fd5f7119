//! Networks for one pose, ranked by simulation.

use super::candidate::{Baseline, with_network};
use super::generators::candidates;
use super::rank::rank;
use super::trial::{Scrutiny, Trial};
use crate::design::{Design, Network, Target};
use crate::discovery::{Parameters, Stages};
use crate::engine::Shape;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Proposals returned.
const PROPOSALS: usize = 8;
/// Candidates that are simulated for one set of proposals, the most promising first: a few seconds of work.
const SCREENED: usize = 100;

/// A network found for a pose and tried out by simulation.
#[derive(Clone, Debug)]
pub struct Proposal {
    pub network: Network,
    pub parameters: Parameters,
    /// The stages of discovery, to be shown (fig. 6).
    pub stages: Arc<Stages>,
    /// The realizable plushie with this network added, posed towards the same targets.
    pub preview: Arc<Shape>,
    /// Target error before and after, in body lengths.
    pub error_before: f64,
    pub error_after: f64,
}

/// Proposes networks of `base.tendon_num` tendons (fewer or more where that serves better) for a pose, best simulated pose
/// error first. Empty where nothing helps, or when cancelled.
pub fn propose(design: &Design, targets: &[Target], base: &Parameters, cancel: &AtomicBool) -> Vec<Proposal> {
    let mut tendon_nums = vec![base.tendon_num];
    tendon_nums.extend((1..=3).filter(|n| *n != base.tendon_num));
    let Some(before) = Trial::new(design).map(|mut t| t.pose(design, targets, None, Scrutiny::Whole, cancel)) else {
        return Vec::new();
    };
    let poses = [Baseline { targets, before: &before }];
    let mut candidates = candidates(design, targets, &poses, base, &tendon_nums, cancel);
    candidates.truncate(SCREENED);
    let ranked = rank(design, candidates, &poses, cancel);
    let mut out = Vec::new();
    for (candidate, mut reached) in ranked.into_iter().take(PROPOSALS) {
        let with = with_network(design, &candidate.tendons);
        let (Some(reached), Some(mut trial)) = (reached.pop(), Trial::new(&with)) else { continue };
        let Some(network) = with.networks.last().cloned() else { continue };
        out.push(Proposal {
            network,
            parameters: candidate.parameters,
            stages: Arc::new(candidate.stages),
            preview: Arc::new(trial.shape(&with, targets, &reached)),
            error_before: before.error,
            error_after: reached.error,
        });
    }
    out
}
