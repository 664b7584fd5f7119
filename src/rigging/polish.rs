//! Small changes of a network's paths.

use super::candidate::{Baseline, Candidate};
use super::criteria;
use super::criterion::Judged;
use super::rank::try_all;
use super::trial::{Reached, Scrutiny};
use crate::design::Design;
use std::sync::atomic::AtomicBool;

/// Rounds of improving a network by small changes of its paths.
const POLISHING_ROUNDS: usize = 15;
/// A round goes on from a change that leaves at most this part of the misfit.
const WORTHWHILE: f64 = 0.99;

/// Improves a network by small changes of its paths, as long as the poses really reached get better. Every trial starts from
/// the activations of the best so far.
pub(super) fn polish(
    design: &Design,
    best: Candidate,
    reached: Vec<Reached>,
    poses: &[Baseline],
    cancel: &AtomicBool,
) -> (Candidate, Vec<Reached>) {
    let neighbours = neighbours(design);
    let (mut best, mut reached) = (best, reached);
    for _ in 0..POLISHING_ROUNDS {
        let changes = changes(&best, &neighbours);
        let now: Vec<Baseline> =
            poses.iter().zip(&reached).map(|(p, before)| Baseline { targets: p.targets, before }).collect();
        let tried = try_all(design, &changes, &now, Scrutiny::Settle, cancel);
        let cost = |network: &Candidate, reached: &[Reached]| {
            criteria::cost(&Judged { design, network: Some(network), poses, reached })
        };
        let before = cost(&best, &reached);
        let winner = changes
            .into_iter()
            .zip(tried)
            .map(|(c, r)| (cost(&c, &r), c, r))
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .filter(|(value, ..)| *value < WORTHWHILE * before);
        let Some((_, candidate, found)) = winner else { break };
        (best, reached) = (candidate, found);
    }
    (best, reached)
}

/// The network with one small change: a tip moved, added or dropped; a via point moved aside; the winch moved to a neighbour.
fn changes(network: &Candidate, neighbours: &[Vec<usize>]) -> Vec<Candidate> {
    let mut out = Vec::new();
    let used = |n: usize| network.tendons.iter().any(|t| t.contains(&n));
    let mut push = |tendons: Vec<Vec<usize>>| {
        let valid = tendons.iter().all(|t| t.len() >= 2 && t.windows(2).all(|s| s[0] != s[1]));
        if valid {
            out.push(Candidate { tendons, ..network.clone() });
        }
    };
    for (k, path) in network.tendons.iter().enumerate() {
        let mut replace = |variant: Vec<usize>| {
            let mut tendons = network.tendons.clone();
            tendons[k] = variant;
            push(tendons);
        };
        let Some(&tip) = path.last() else { continue };
        let shorter = &path[..path.len() - 1];
        replace(shorter.to_vec());
        for &next in neighbours[tip].iter().filter(|n| !used(**n)) {
            replace(path.iter().copied().chain([next]).collect());
            replace(shorter.iter().copied().chain([next]).collect());
        }
        for via in 1..path.len().saturating_sub(1) {
            let mut without = path.clone();
            let old = without.remove(via);
            if neighbours[path[via - 1]].contains(&path[via + 1]) {
                replace(without);
            }
            for &aside in neighbours[old].iter().filter(|n| !used(**n)) {
                if neighbours[path[via - 1]].contains(&aside) && neighbours[path[via + 1]].contains(&aside) {
                    let mut moved = path.clone();
                    moved[via] = aside;
                    replace(moved);
                }
            }
        }
    }
    if let Some(&winch) = network.tendons.first().and_then(|t| t.first()) {
        for &next in &neighbours[winch] {
            let moved = network.tendons.iter().map(|t| {
                if t[1] == next { t[1..].to_vec() } else { std::iter::once(next).chain(t.iter().copied()).collect() }
            });
            push(moved.collect());
        }
    }
    out
}

fn neighbours(design: &Design) -> Vec<Vec<usize>> {
    let mut out = vec![Vec::new(); design.mesh.nodes.len()];
    for [a, b] in design.mesh.edges() {
        out[a].push(b);
        out[b].push(a);
    }
    out
}
