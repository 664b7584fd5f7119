//! Many candidates tried out on all poses, and put in order.

use super::candidate::{Baseline, Candidate, with_network};
use super::criteria;
use super::criterion::Judged;
use super::trial::{Reached, Scrutiny, Trial};
use crate::design::Design;
use crate::threads::in_order;
use std::sync::atomic::{AtomicBool, Ordering};

/// Candidates that are posed carefully after a quick screening.
const SETTLED: usize = 10;

/// The candidates that lower the cost of the poses, best first, with what each pose reaches. Quick screening of all, then care
/// for the best. Empty when cancelled.
pub(super) fn rank(
    design: &Design,
    candidates: Vec<Candidate>,
    poses: &[Baseline],
    cancel: &AtomicBool,
) -> Vec<(Candidate, Vec<Reached>)> {
    let cost =
        |network: Option<&Candidate>, reached: &[Reached]| criteria::cost(&Judged { design, network, poses, reached });
    let screened = try_all(design, &candidates, poses, Scrutiny::Screen, cancel);
    let costs: Vec<f64> = candidates.iter().zip(&screened).map(|(c, r)| cost(Some(c), r)).collect();
    let mut order: Vec<usize> = (0..candidates.len()).collect();
    order.sort_by(|&a, &b| costs[a].total_cmp(&costs[b]));
    order.truncate(SETTLED);
    let best: Vec<Candidate> = order.into_iter().map(|k| candidates[k].clone()).collect();
    if cancel.load(Ordering::Relaxed) {
        return Vec::new();
    }
    let settled = try_all(design, &best, poses, Scrutiny::Look, cancel);
    let before: Vec<Reached> = poses.iter().map(|p| p.before.clone()).collect();
    let before = cost(None, &before);
    let judged = best.into_iter().zip(settled).map(|(c, r)| (cost(Some(&c), &r), c, r));
    let mut out: Vec<(f64, Candidate, Vec<Reached>)> = judged.filter(|(cost, ..)| *cost < before).collect();
    out.sort_by(|a, b| a.0.total_cmp(&b.0));
    out.into_iter().map(|(_, candidate, reached)| (candidate, reached)).collect()
}

/// Tries every candidate on every pose, on all processors. An empty list stands for a candidate that has no model.
fn try_all(
    design: &Design,
    candidates: &[Candidate],
    poses: &[Baseline],
    scrutiny: Scrutiny,
    cancel: &AtomicBool,
) -> Vec<Vec<Reached>> {
    in_order(candidates, |candidate| match cancel.load(Ordering::Relaxed) {
        true => Vec::new(),
        false => try_one(design, candidate, poses, scrutiny, cancel),
    })
}

fn try_one(
    design: &Design,
    candidate: &Candidate,
    poses: &[Baseline],
    scrutiny: Scrutiny,
    cancel: &AtomicBool,
) -> Vec<Reached> {
    let with = with_network(design, &candidate.tendons);
    let Some(mut trial) = Trial::new(&with) else { return Vec::new() };
    poses.iter().map(|p| trial.pose(&with, p.targets, Some(&p.before.posture), scrutiny, cancel)).collect()
}
