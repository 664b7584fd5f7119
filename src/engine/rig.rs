//! The design loop without a hand: over all poses, solve, discover, try out, accept (section 3).

use super::propose::{Candidate, Known, candidates, misfit, rank, try_all, with_network};
use super::trial::{Care, Reached, Trial};
use crate::design::{Design, Target};
use crate::discovery::Parameters;
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicBool, Ordering};

/// A pose served better than this part of its rest error needs no further winch of its own.
const SERVED: f64 = 0.02;
/// Candidates of one pose that are simulated; the most promising come first.
const PER_POSE: usize = 150;
/// Rounds of improving a network by small changes of its paths.
const POLISHING_ROUNDS: usize = 15;
/// A round goes on from a change that leaves at most this part of the misfit.
const WORTHWHILE: f64 = 0.99;

/// What the loop may build and try.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RigOptions {
    pub max_winches: usize,
    pub tendons: TendonChoice,
    /// Parameters of Algorithm 2 held at these values; `None` lets the loop vary them.
    pub seed_num: Option<usize>,
    pub join_depth: Option<usize>,
    pub join_len: Option<usize>,
    pub phi: Option<f64>,
}

impl Default for RigOptions {
    fn default() -> Self {
        Self {
            max_winches: 3,
            tendons: TendonChoice::default(),
            seed_num: None,
            join_depth: None,
            join_len: None,
            phi: None,
        }
    }
}

/// How many tendons each winch gets.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum TendonChoice {
    /// Winch by winch; the last number holds for all further ones.
    PerWinch(Vec<usize>),
    /// Whatever serves best between the two, both included.
    Between(usize, usize),
}

impl Default for TendonChoice {
    fn default() -> Self {
        Self::Between(1, 4)
    }
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
}

/// Adds networks to `design` until its poses are served or `options` are used up. `progress` gets one line a step.
///
/// One winch at a time: each pose that is not yet served is solved for fibres with the winches so far held, discovery turns
/// the fibres' activations into candidates, every candidate is simulated on *all* poses, and the one that leaves the least
/// misfit is polished by small changes of its paths and accepted. With [`TendonChoice::PerWinch`] every number asked for is
/// built as long as it helps at all.
pub fn rig(
    design: &Design,
    options: &RigOptions,
    progress: &mut dyn FnMut(&str),
    cancel: &AtomicBool,
) -> Result<Design, RigError> {
    let poses: Vec<(String, Vec<Target>)> =
        design.poses.iter().filter(|p| !p.targets.is_empty()).map(|p| (p.name.clone(), p.targets.clone())).collect();
    if poses.is_empty() {
        return Err(RigError::NoTargets);
    }
    let mut current = design.clone();
    let mut reached = reach(&current, &poses, &[], cancel);
    for winch in 0..options.max_winches {
        let known: Vec<Known> =
            poses.iter().zip(&reached).map(|((_, targets), before)| Known { targets, before }).collect();
        let served = |k: usize| reached[k].error <= SERVED * rest_error(design, &poses[k].1);
        let exact = matches!(options.tendons, TendonChoice::PerWinch(_));
        if !exact && (0..poses.len()).all(served) {
            break;
        }
        let found = gather(&current, &poses, &known, &served, options, winch, cancel);
        progress(&format!("winch {}: {} candidate networks", winch + 1, found.len()));
        let ranked = rank(&current, found, &known, cancel);
        if cancel.load(Ordering::Relaxed) {
            return Err(RigError::Cancelled);
        }
        let Some((best, now)) = ranked.into_iter().next() else { break };
        let (best, now) = polish(&current, best, now, &known, cancel);
        if cancel.load(Ordering::Relaxed) {
            return Err(RigError::Cancelled);
        }
        drop(known);
        current = with_network(&current, &best.tendons);
        reached = reach(&current, &poses, &now, cancel);
        let errors: Vec<String> =
            poses.iter().zip(&reached).map(|((name, _), r)| format!("{name} {:.1} %", 100.0 * r.error)).collect();
        progress(&format!("winch {}: {} tendons; {}", winch + 1, best.tendons.len(), errors.join(", ")));
    }
    if current.networks.len() == design.networks.len() {
        return Err(RigError::NothingFound);
    }
    widen_keyframes(&mut current);
    Ok(current)
}

/// What the present networks reach in every pose when they are wound from rest; `known`: what was reached so far.
fn reach(design: &Design, poses: &[(String, Vec<Target>)], known: &[Reached], cancel: &AtomicBool) -> Vec<Reached> {
    let mut out = Vec::new();
    if let Some(mut trial) = Trial::new(design) {
        for (k, (_, targets)) in poses.iter().enumerate() {
            let known = known.get(k).map(|reached| &reached.posture);
            out.push(trial.pose(design, targets, known, Care::Whole, cancel));
        }
    }
    out
}

fn rest_error(design: &Design, targets: &[Target]) -> f64 {
    super::solver::target_error(design, targets, &design.mesh.nodes)
}

/// Candidates of all poses that are not yet served (of all, where all are).
fn gather(
    design: &Design,
    poses: &[(String, Vec<Target>)],
    known: &[Known],
    served: &dyn Fn(usize) -> bool,
    options: &RigOptions,
    winch: usize,
    cancel: &AtomicBool,
) -> Vec<Candidate> {
    let numbers: Vec<usize> = match &options.tendons {
        TendonChoice::PerWinch(list) => list.get(winch).or(list.last()).copied().into_iter().collect(),
        TendonChoice::Between(low, high) => (*low..=*high).collect(),
    };
    let defaults = Parameters::default();
    let base = Parameters {
        seed_num: options.seed_num.unwrap_or(defaults.seed_num),
        join_depth: options.join_depth.unwrap_or(defaults.join_depth),
        join_len: options.join_len.unwrap_or(defaults.join_len),
        tendon_num: numbers.first().copied().unwrap_or(defaults.tendon_num),
        phi: options.phi.unwrap_or(defaults.phi),
        ..defaults
    };
    let asked = |p: &Parameters| {
        options.seed_num.is_none_or(|v| v == p.seed_num)
            && options.join_depth.is_none_or(|v| v == p.join_depth)
            && options.join_len.is_none_or(|v| v == p.join_len)
            && options.phi.is_none_or(|v| v == p.phi)
    };
    let all_served = (0..poses.len()).all(served);
    let mut out: Vec<Candidate> = Vec::new();
    for (k, (_, targets)) in poses.iter().enumerate() {
        if served(k) && !all_served {
            continue;
        }
        for candidate in candidates(design, targets, known, &base, &numbers, cancel).into_iter().take(PER_POSE) {
            if asked(&candidate.parameters) && !out.iter().any(|c| c.tendons == candidate.tendons) {
                out.push(candidate);
            }
        }
    }
    out
}

/// Improves a network by small changes of its paths, as long as the poses really reached get better. Every trial starts from
/// the activations of the best so far.
fn polish(
    design: &Design,
    best: Candidate,
    reached: Vec<Reached>,
    poses: &[Known],
    cancel: &AtomicBool,
) -> (Candidate, Vec<Reached>) {
    let neighbours = neighbours(design);
    let (mut best, mut reached) = (best, reached);
    for _ in 0..POLISHING_ROUNDS {
        let changes = changes(&best, &neighbours);
        let now: Vec<Known> =
            poses.iter().zip(&reached).map(|(p, before)| Known { targets: p.targets, before }).collect();
        let tried = try_all(design, &changes, &now, Care::Settle, cancel);
        let before = misfit(design, poses, &reached);
        let winner = changes
            .into_iter()
            .zip(tried)
            .map(|(c, r)| (misfit(design, poses, &r), c, r))
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

/// Existing keyframes leave the new winches at rest.
fn widen_keyframes(design: &mut Design) {
    let count = design.networks.len();
    for keyframe in &mut design.keyframes {
        keyframe.activations_mm.resize(count, 0.0);
    }
}
