//! The design loop of the paper without a hand: winch by winch, solve, discover, try out, accept (section 3).

use super::candidate::{Baseline, Candidate, with_network};
use super::checked::Checked;
use super::generators::candidates;
use super::options::{Found, Progress, RigError, RigOptions, TendonChoice, Wound};
use super::rank::rank;
use super::trial::{Reached, Scrutiny, Trial};
use crate::design::{Design, Target};
use crate::discovery::Parameters;
use crate::engine::target_error;
use crate::threads::in_order;
use std::sync::atomic::{AtomicBool, Ordering};

/// A pose served better than this part of its rest error needs no further winch of its own.
const SERVED: f64 = 0.02;
/// Candidates of one pose that are simulated; the most promising come first.
const PER_POSE: usize = 150;
/// Adds networks to `design` until its poses are served or `options` are used up. `progress` hears of every step.
///
/// One winch at a time: each pose that is not yet served is solved for fibres with the winches so far held, discovery turns
/// the fibres' activations into candidates, every candidate is simulated on *all* poses, and the one that leaves the least
/// cost is accepted. With [`TendonChoice::PerWinch`] every number asked for is
/// built as long as it helps at all. Existing keyframes leave the
/// new winches at rest.
///
/// # Errors
/// [`RigError::NoModel`] where the design has none, [`RigError::NothingFound`] where no network helps, or cancelled.
pub(super) fn rig(
    design: &Design,
    options: &RigOptions,
    progress: &mut dyn FnMut(Progress),
    cancel: &AtomicBool,
) -> Result<Found, RigError> {
    let poses: Vec<(String, Vec<Target>)> =
        design.poses.iter().filter(|p| !p.targets.is_empty()).map(|p| (p.name.clone(), p.targets.clone())).collect();
    let mut current = design.clone();
    let mut reached = reach(&current, &poses, &[], cancel);
    if reached.is_empty() {
        return Err(RigError::NoModel);
    }
    for winch in 0..options.max_winches {
        let known: Vec<Baseline> =
            poses.iter().zip(&reached).map(|((_, targets), before)| Baseline { targets, before }).collect();
        let served = |k: usize| reached[k].error <= SERVED * rest_error(design, &poses[k].1);
        let exact = matches!(options.tendons, TendonChoice::PerWinch(_));
        if !exact && (0..poses.len()).all(served) {
            break;
        }
        let found = gather(&current, &poses, &known, &served, options, winch, cancel);
        progress(Progress::Candidates { winch, count: found.len() });
        let ranked = rank(&current, found, &known, cancel);
        if cancel.load(Ordering::Relaxed) {
            // Winches that were accepted before are worth keeping.
            if options.keep && winch > 0 {
                break;
            }
            return Err(RigError::Cancelled);
        }
        let Some((best, now)) = ranked.into_iter().next() else { break };
        drop(known);
        current = with_network(&current, &best.tendons);
        reached = reach(&current, &poses, &now, cancel);
        let errors = poses.iter().zip(&reached).map(|((name, _), r)| (name.clone(), r.error)).collect();
        progress(Progress::Accepted { winch, tendons: best.tendons.len(), errors });
    }
    if current.networks.len() == design.networks.len() {
        return Err(RigError::NothingFound);
    }
    widen_keyframes(&mut current);
    let stopped = || cancel.load(Ordering::Relaxed);
    let check = |(_, targets): &(String, Vec<Target>)| Checked::of(&current, targets, 0.0, cancel).shape;
    let checked = if stopped() { Vec::new() } else { in_order(&poses, check) };
    let wound = if stopped() {
        let reached = poses.into_iter().zip(reached);
        reached
            .map(|((pose, _), reached)| Wound { pose, activations_mm: reached.posture.beta, checked: None, sewn: None })
            .collect()
    } else {
        let added = &current.networks[design.networks.len()..];
        let (winches, tendons) = (added.len(), added.iter().map(|network| network.tendons.len()).sum());
        let errors = poses.iter().zip(&checked).map(|((name, _), shape)| (name.clone(), shape.target_error)).collect();
        progress(Progress::Found { winches, tendons, errors, sewn: Vec::new() });
        poses.into_iter().zip(checked).map(|((pose, _), shape)| Wound::checked(pose, shape)).collect()
    };
    Ok(Found { design: current, wound, coarse: false })
}

/// What the present networks reach in every pose when they are wound from rest; `known`: what was reached so far.
fn reach(design: &Design, poses: &[(String, Vec<Target>)], known: &[Reached], cancel: &AtomicBool) -> Vec<Reached> {
    let mut out = Vec::new();
    if let Some(mut trial) = Trial::new(design) {
        for (k, (_, targets)) in poses.iter().enumerate() {
            let known = known.get(k).map(|reached| &reached.posture);
            out.push(trial.pose(design, targets, known, Scrutiny::Whole, cancel));
        }
    }
    out
}

fn rest_error(design: &Design, targets: &[Target]) -> f64 {
    target_error(design, targets, &design.mesh.nodes)
}

/// Candidates of all poses that are not yet served (of all, where all are).
fn gather(
    design: &Design,
    poses: &[(String, Vec<Target>)],
    known: &[Baseline],
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

/// Existing keyframes leave the new winches at rest.
fn widen_keyframes(design: &mut Design) {
    let count = design.networks.len();
    for keyframe in &mut design.keyframes {
        keyframe.activations_mm.resize(count, 0.0);
    }
}
