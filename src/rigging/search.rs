//! Winches and tendons for all poses of a design, without a hand.

use super::candidate::unused_name;
use super::checked::Checked;
use super::greedy;
use super::joint::Joint;
use super::layout::rigs_of;
use super::moves::{Sampler, Topology};
use super::options::{Method, Progress, RigError, RigOptions, TendonChoice};
use super::prune::{SERVED, pruned};
use super::refine::{Fit, Task};
use super::robust::{Sewn, sewn};
use super::sewable::Sewable;
use crate::design::{Design, Network, Pose, Target, remesh};
use crate::engine::compile::{View, compile};
use crate::engine::target_error;
use crate::mesh::{Mesh, MeshSpec};
use crate::outline::Outline;
use crate::threads::in_order;
use std::cmp::Ordering;
use std::sync::atomic::{self, AtomicBool};

/// Bodies of more fibres are searched on a mesh of about so many, and what is found is improved on their own.
const COARSE: usize = 430;
const FINE: usize = 700;
/// Layouts that are finished and compared by what a check says of them.
const FINALISTS: usize = 5;
/// Steps by which the worst pose is improved in the end.
const SHARPENING: usize = 40;
/// Rounds after which a search is over, if none has left less than this part of the worst pose's error: more than an era of the islands.
const PATIENCE: usize = 30;
const GAIN: f64 = 0.99;
/// Most holes of a tendon where no rule is asked for.
pub(super) const FREE_HOLES: usize = 20;

/// The design with winches for its poses, in addition to those that it has.
///
/// [`Method::Joint`]: all new winches are searched for together (`joint`), on a coarse mesh where the body's own is fine, what is
/// found is improved on its own mesh, points and tendons that cost little are left out, and what counts in the end is what a check
/// says. [`Method::Algorithm2`]: winch by winch with the networks of Algorithm 2 as they are.
///
/// # Errors
/// [`RigError::NoTargets`] where no pose has targets, [`RigError::NoModel`] where the body has none, [`RigError::NothingFound`] where no network helps, or cancelled.
pub fn rig(
    design: &Design,
    options: &RigOptions,
    progress: &mut dyn FnMut(Progress),
    cancel: &AtomicBool,
) -> Result<Design, RigError> {
    if design.poses.iter().all(|pose| pose.targets.is_empty()) {
        return Err(RigError::NoTargets);
    }
    match options.method {
        Method::Joint => together(design, options, progress, cancel),
        Method::Algorithm2 => greedy::rig(design, options, progress, cancel),
    }
}

/// The rim of a mesh at rest.
pub(super) fn rim(mesh: &Mesh) -> Outline {
    let mut rings = mesh.boundary().into_iter().map(|ring| ring.into_iter().map(|n| mesh.nodes[n]).collect());
    Outline { outer: rings.next().unwrap_or_default(), holes: rings.collect() }
}

fn together(
    design: &Design,
    options: &RigOptions,
    progress: &mut dyn FnMut(Progress),
    cancel: &AtomicBool,
) -> Result<Design, RigError> {
    if compile(design, View::Realizable).is_err() {
        return Err(RigError::NoModel);
    }
    let topology = topology(design, options);
    let coarse = coarser(design);
    let searched = coarse.as_ref().unwrap_or(design);
    let found = layouts(searched, options, &topology, progress, cancel)?;
    let found: Vec<Fit> = match coarse {
        None => found,
        Some(_) => {
            let (outline, stop) = (rim(&design.mesh), || cancel.load(atomic::Ordering::Relaxed));
            let sewable = sewable(design, &outline, options.rules);
            let task = Task::new(design, sewable.as_ref(), &design.networks);
            in_order(&found, |fit| task.transferred(fit, &stop)).into_iter().flatten().collect()
        }
    };
    let verified = in_order(&found, |fit| verified(design, fit, cancel));
    if cancel.load(atomic::Ordering::Relaxed) {
        return Err(RigError::Cancelled);
    }
    let worst =
        |poses: &[Verified], error: fn(&Verified) -> f64| poses.iter().map(|p| error(p) / p.rest).fold(0.0, f64::max);
    // As a hand sews it, with friction where the design has it; a rig that has no figure there is the last choice.
    let order = |poses: &[Verified]| (worst(poses, |p| p.sewn.median.max(p.real)), worst(poses, |p| p.error));
    let best = verified.into_iter().min_by(|a, b| order(&a.1).partial_cmp(&order(&b.1)).unwrap_or(Ordering::Equal));
    let Some((rigged, poses)) = best.filter(|(_, poses)| helps(poses)) else {
        return Err(RigError::NothingFound);
    };
    let tendons = rigged.networks[design.networks.len()..].iter().map(|n| n.tendons.len()).sum();
    let sewn = poses.iter().map(|pose| pose.sewn).collect();
    let errors = poses.into_iter().map(|pose| (pose.name, pose.error)).collect();
    progress(Progress::Found { winches: rigged.networks.len() - design.networks.len(), tendons, errors, sewn });
    Ok(rigged)
}

/// How many winches and tendons there may be.
fn topology(design: &Design, options: &RigOptions) -> Topology {
    let count = |winch: usize| match &options.tendons {
        TendonChoice::PerWinch(list) => list.get(winch).or(list.last()).map_or([1, 1], |&n| [n.max(1); 2]),
        TendonChoice::Between(low, high) => [(*low).max(1), (*high).max(*low).max(1)],
    };
    let most_holes = if options.rules { design.sewing.most_holes } else { FREE_HOLES };
    Topology { tendons: (0..options.max_winches).map(count).collect(), most_holes }
}

/// The design on a coarse mesh, where its own is fine and the outline takes another one.
pub(super) fn coarser(design: &Design) -> Option<Design> {
    if design.mesh.edges().len() <= FINE {
        return None;
    }
    let (mesh, set) = remesh::body(&design.outline, &MeshSpec::fibers(COARSE), 1).ok()?;
    let mut coarse = design.clone();
    remesh::carry(&mut coarse, mesh, set);
    Some(coarse)
}

/// The rules for new networks beside those that are there; `None` where no rule is asked for.
pub(super) fn sewable<'a>(design: &'a Design, rim: &'a Outline, rules: bool) -> Option<Sewable<'a>> {
    let gap_mm = design.fabrication.turning_gap_mm;
    rules.then(|| Sewable::new(design.sewing, &design.outline, rim, gap_mm, rigs_of(&design.networks, &design.mesh)))
}

/// The best few layouts that a search finds on the design's own mesh; those that keep the rules, where any do.
fn layouts(
    design: &Design,
    options: &RigOptions,
    topology: &Topology,
    progress: &mut dyn FnMut(Progress),
    cancel: &AtomicBool,
) -> Result<Vec<Fit>, RigError> {
    let (outline, stop) = (rim(&design.mesh), || cancel.load(atomic::Ordering::Relaxed));
    let sewable = sewable(design, &outline, options.rules);
    let task = Task::new(design, sewable.as_ref(), &design.networks);
    // Nothing to build, or every pose is at rest already.
    if topology.tendons.is_empty() || task.poses.is_empty() {
        return Ok(Vec::new());
    }
    let sampler = Sampler::new(&design.mesh, sewable.as_ref());
    let mut joint = Joint::new(&task, &sampler, topology.clone(), options.seed, &stop);
    let (mut best, mut since) = (f64::INFINITY, 0);
    for round in 0..options.rounds {
        let Some(fit) = joint.best() else { break };
        let (worst, holes) = (fit.worst(), fit.layout.holes());
        progress(Progress::Round { round, rounds: options.rounds, worst, holes });
        since = if worst < GAIN * best { 0 } else { since + 1 };
        best = best.min(worst);
        if worst <= SERVED || since > PATIENCE {
            break;
        }
        joint.advance(&stop);
        if stop() {
            return Err(RigError::Cancelled);
        }
    }
    let mut finished = in_order(&joint.finalists(FINALISTS), |fit| {
        task.sharpened(pruned(&task, topology, joint.finished(fit, &stop), &stop), SHARPENING, &stop)
    });
    if stop() {
        return Err(RigError::Cancelled);
    }
    if let Some(sewable) = &sewable
        && finished.iter().any(|fit| sewable.is_kept(&fit.layout))
    {
        finished.retain(|fit| sewable.is_kept(&fit.layout));
    }
    Ok(finished)
}

/// A pose as a check has it, errors in body lengths.
struct Verified {
    name: String,
    error: f64,
    /// With the design's friction at the holes; infinite where there is no such figure.
    real: f64,
    sewn: Sewn,
    rest: f64,
}

/// Whether a rig brings the poses closer to their targets, all taken together: one winch may serve one pose of several.
fn helps(poses: &[Verified]) -> bool {
    poses.iter().map(|pose| (pose.error / pose.rest).powi(2)).sum::<f64>() < poses.len() as f64
}

/// The design with a layout's networks, and what a check says of every pose.
fn verified(design: &Design, fit: &Fit, cancel: &AtomicBool) -> (Design, Vec<Verified>) {
    let mut with = design.clone();
    if let Some(points) = fit.layout.located(&design.mesh) {
        for network in fit.layout.networks(&design.mesh, &points) {
            let name = unused_name(&with);
            with.networks.push(Network { name, ..network });
        }
    }
    let count = with.networks.len();
    with.keyframes.iter_mut().for_each(|keyframe| keyframe.activations_mm.resize(count, 0.0));
    let posed: Vec<&Pose> = design.poses.iter().filter(|pose| !pose.targets.is_empty()).collect();
    let targets: Vec<&[Target]> = posed.iter().map(|pose| pose.targets.as_slice()).collect();
    let friction = design.tendons.friction;
    let mut sewn = sewn(&with, &targets, friction, cancel).into_iter();
    let poses = posed.into_iter().map(|pose| {
        let checked = Checked::of(&with, &pose.targets, friction, cancel);
        let error = checked.real_error();
        let rest = target_error(design, &pose.targets, &design.mesh.nodes).max(f64::MIN_POSITIVE);
        let sewn = sewn.next().unwrap_or(Sewn { median: error, worst: error });
        Verified { name: pose.name.clone(), error: checked.error(), real: error, sewn, rest }
    });
    let poses = poses.collect();
    (with, poses)
}
