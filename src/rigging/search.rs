//! Winches and tendons for all poses of a design, without a hand.

use super::candidate::unused_name;
use super::checked::Checked;
use super::greedy;
use super::joint::Joint;
use super::layout::{Layout, rigs_of};
use super::linear_score::Linear;
use super::minimax::{self, worst_first, worst_helped};
use super::moves::{Sampler, Topology};
use super::options::{Found, Method, Progress, RigError, RigOptions, TendonChoice, Wound};
use super::prune::{SERVED, pruned};
use super::refine::{Fit, SEEN, Start, Task};
use super::robust::{self, Sewn};
use super::schedule::{Schedule, Turn};
use super::sewable::Sewable;
use crate::design::{Design, Network, Pose, Target, remesh};
use crate::engine::compile::{View, compile};
use crate::engine::{Shape, target_error};
use crate::mesh::{BodyPoint, Mesh, MeshSpec};
use crate::outline::Outline;
use crate::threads::in_order;
use std::cmp::Ordering;
use std::sync::atomic::{self, AtomicBool};

/// Bodies of more fibres are searched on a mesh of about so many, and what is found is improved on their own.
const COARSE: usize = 430;
const FINE: usize = 700;
/// It gets there over meshes that are so many times finer, each than the one before: on one that is ten times finer a limb bends so much more
/// easily that activations lead to other states.
const FINER: usize = 3;
/// Layouts that are finished and compared by what a check says of them.
const FINALISTS: usize = 5;
/// And others that differ from them in kind, where it counts what a hand makes of them: a valley may be narrow.
const OTHERS: usize = 6;
/// Steps by which the worst pose is improved in the end.
const SHARPENING: usize = 40;
/// The best of those are improved for what a hand makes of them, too.
const STEADIED: usize = 8;
/// And so many go over to a finer mesh, where improving one takes most of the time.
const CARRIED: usize = 8;
/// Most holes of a tendon where no rule is asked for.
pub(super) const FREE_HOLES: usize = 20;

/// The design with winches for its poses, in addition to those that it has.
///
/// [`Method::Joint`]: all new winches are searched for together (`joint`), on a coarse mesh where the body's own is fine, what is
/// found is improved on its own mesh, points and tendons that cost little are left out, and what counts in the end is what a check
/// says. [`Method::Algorithm2`]: winch by winch with the networks of Algorithm 2 as they are.
///
/// Told to stop, and to keep what it has, it ends at once with the best layout, which nothing was checked of yet.
///
/// # Errors
/// [`RigError::NoTargets`] where no pose has targets, [`RigError::NoModel`] where the body has none, [`RigError::NothingFound`] where no network helps, or cancelled.
pub fn rig(
    design: &Design,
    options: &RigOptions,
    progress: &mut dyn FnMut(Progress),
    cancel: &AtomicBool,
) -> Result<Found, RigError> {
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
) -> Result<Found, RigError> {
    if compile(design, View::Realizable).is_err() {
        return Err(RigError::NoModel);
    }
    let topology = topology(design, options);
    let coarse = coarser(design);
    let searched = coarse.as_ref().unwrap_or(design);
    let mut found = layouts(searched, options, &topology, progress, cancel)?;
    let (found, coarse) = match coarse {
        Some(_) => {
            found.truncate(CARRIED);
            carried(design, found, options, cancel)
        }
        None => (found, false),
    };
    let verified = judged(design, &found, options, cancel);
    if cancel.load(atomic::Ordering::Relaxed) {
        let best = found.iter().min_by(|a, b| a.compare(b));
        return if options.keep { unchecked(design, best, coarse) } else { Err(RigError::Cancelled) };
    }
    let best = chosen(verified, options.rules).filter(|(_, poses)| helps(poses.iter().map(|p| p.error / p.rest)));
    let Some((rigged, poses)) = best else {
        return Err(RigError::NothingFound);
    };
    // A motor more must be worth it.
    if options.rules && !design.networks.is_empty() {
        let posed: Vec<&Pose> = posed(design).collect();
        let before =
            in_order(&posed, |pose| Checked::of(design, &pose.targets, design.tendons.friction, cancel).real_error());
        let gains = |(before, pose): (&f64, &Verified)| before - pose.real > SEEN;
        if !before.iter().zip(&poses).any(gains) {
            return Err(RigError::NothingToAdd);
        }
    }
    let tendons = rigged.networks[design.networks.len()..].iter().map(|n| n.tendons.len()).sum();
    let sewn = poses.iter().filter_map(|pose| pose.sewn).collect();
    let errors = poses.iter().map(|pose| (pose.name.clone(), pose.error)).collect();
    progress(Progress::Found { winches: rigged.networks.len() - design.networks.len(), tendons, errors, sewn });
    let wound = poses.into_iter().map(|pose| Wound { sewn: pose.sewn, ..Wound::checked(pose.name, pose.shape) });
    let wound = wound.collect();
    Ok(Found { design: rigged, wound, coarse: false })
}

/// A layout as the search has it, in a moment.
fn unchecked(design: &Design, best: Option<&Fit>, coarse: bool) -> Result<Found, RigError> {
    let fit = best.ok_or(RigError::Cancelled)?;
    if !helps(fit.misses.iter().map(|miss| miss.sqrt())) {
        return Err(RigError::NothingFound);
    }
    // On another mesh its points may lie a little outside of the body.
    let nearest = |spot| Some(design.mesh.locate_nearest(fit.layout.point(spot), &design.mesh.nodes)?.0);
    let points: Option<Vec<BodyPoint>> = fit.layout.spots().into_iter().map(nearest).collect();
    let with = with(design, &fit.layout, &points.ok_or(RigError::NothingFound)?);
    // A pose that rests winds nothing.
    let at_rest = vec![0.0; with.networks.len()];
    let served = |k: usize| fit.served.iter().position(|&served| served == k).and_then(|at| fit.poses.get(at));
    let posed = design.poses.iter().enumerate().filter(|(_, pose)| !pose.targets.is_empty());
    let wound = posed.map(|(k, pose)| {
        let activations_mm = served(k).map_or_else(|| at_rest.clone(), |posture| posture.beta.clone());
        Wound { pose: pose.name.clone(), activations_mm, checked: None, sewn: None }
    });
    Ok(Found { wound: wound.collect(), design: with, coarse })
}

/// The layout whose worst pose is best as a part of its error at rest: as a maker may expect it where it is to be sewn ([`Sewn::expected`]), with
/// friction where the design has it; a rig that has no figure there is the last choice. Where it is to be sewn, it is, of those that nobody can tell from it, one with the fewest
/// winches, and of these the one that pulls least: on the felt, on a hand, on a motor.
fn chosen(mut verified: Vec<Candidate>, sewn: bool) -> Option<Candidate> {
    let order = |(_, poses): &Candidate| {
        let [expected, exact] = [Verified::expected, |p: &Verified| p.error]
            .map(|error: fn(&Verified) -> f64| worst_first(poses.iter().map(|p| error(p) / p.rest)));
        [expected, exact].concat()
    };
    verified.sort_by(|a, b| minimax::compare(&order(a), &order(b)));
    if !sewn {
        return verified.into_iter().next();
    }
    let best: Vec<[f64; 2]> = verified.first()?.1.iter().map(|p| [p.expected(), p.real]).collect();
    let worse = |(p, best): (&Verified, &[f64; 2])| p.expected() > best[0] + SEEN || p.real > best[1] + SEEN;
    verified.retain(|(_, poses)| !poses.iter().zip(&best).any(worse));
    let price =
        |(design, poses): &Candidate| (design.networks.len(), poses.iter().map(|p| p.pull_n).fold(0.0, f64::max));
    verified.into_iter().min_by(|a, b| price(a).partial_cmp(&price(b)).unwrap_or(Ordering::Equal))
}

/// What a check says of the layouts that were found, on the design's own mesh.
fn judged(design: &Design, found: &[Fit], options: &RigOptions, cancel: &AtomicBool) -> Vec<Candidate> {
    if cancel.load(atomic::Ordering::Relaxed) {
        return Vec::new();
    }
    let verified = in_order(found, |fit| verified(design, fit, cancel));
    if options.rules { as_sewn(verified, design.tendons.friction, cancel) } else { verified }
}

/// Rigs with what a hand leaves of them, those left out that cannot be [`chosen`] any more: sewing makes no rig better than it is drawn, and winding
/// five plushies of each is most of the work.
fn as_sewn(mut verified: Vec<Candidate>, friction: f64, cancel: &AtomicBool) -> Vec<Candidate> {
    let worst = |(_, poses): &Candidate| poses.iter().map(|p| p.expected() / p.rest).fold(0.0, f64::max);
    // Part of the error at rest that nobody sees.
    let unseen = |(_, poses): &Candidate| poses.iter().map(|p| SEEN / p.rest).fold(0.0, f64::max);
    verified.sort_by(|a, b| worst(a).total_cmp(&worst(b)));
    let mut best = f64::INFINITY;
    let mut sewn = Vec::new();
    for mut candidate in verified {
        if worst(&candidate) > best + unseen(&candidate) && !sewn.is_empty() {
            break;
        }
        let (design, poses) = &mut candidate;
        let targets: Vec<&[Target]> = posed(design).map(|pose| pose.targets.as_slice()).collect();
        let told = robust::sewn(design, &targets, friction, cancel);
        poses.iter_mut().zip(told).for_each(|(pose, told)| pose.sewn = Some(told));
        best = best.min(worst(&candidate));
        sewn.push(candidate);
    }
    sewn
}

/// What was found on a coarse mesh, improved on those between that and the body's own, and there; as it was where that is not possible, and from
/// where it is interrupted. And whether it did not get to the body's own mesh.
fn carried(design: &Design, found: Vec<Fit>, options: &RigOptions, cancel: &AtomicBool) -> (Vec<Fit>, bool) {
    let stop = || cancel.load(atomic::Ordering::Relaxed);
    let improved = |found: Vec<Fit>, design: &Design| {
        let outline = rim(&design.mesh);
        let sewable = sewable(design, &outline);
        let task = Task::new(design, options.rules.then_some(&sewable), &design.networks).trimming(options.trims);
        let moved: Vec<Fit> = in_order(&found, |fit| task.transferred(fit, &stop)).into_iter().flatten().collect();
        if stop() || moved.is_empty() { (found, true) } else { (moved, false) }
    };
    let meshes = between(design.mesh.edges().len()).into_iter();
    let meshes = meshes.map_while(|fibers| if stop() { None } else { on_mesh(design, fibers) });
    let found = meshes.fold(found, |found, between| improved(found, &between).0);
    improved(found, design)
}

/// Numbers of fibres of the meshes between [`COARSE`] and a body's own number.
fn between(own: usize) -> Vec<usize> {
    std::iter::successors(Some(FINER * COARSE), |fibers| Some(FINER * fibers))
        .take_while(|fibers| 2 * fibers < own)
        .collect()
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
    on_mesh(design, COARSE)
}

/// The design on a mesh of about so many fibres, where its outline takes one.
fn on_mesh(design: &Design, fibers: usize) -> Option<Design> {
    let (mesh, set) = remesh::body(&design.outline, &MeshSpec::fibers(fibers), 1).ok()?;
    let mut other = design.clone();
    remesh::carry(&mut other, mesh, set);
    Some(other)
}

/// The rules for new networks beside those that are there.
pub(super) fn sewable<'a>(design: &'a Design, rim: &'a Outline) -> Sewable<'a> {
    let gap_mm = design.turning_gap_mm();
    Sewable::new(design.sewing, &design.outline, rim, gap_mm, rigs_of(&design.networks, &design.mesh.nodes))
}

/// The best few layouts that a search finds on the design's own mesh, best first; those that keep the rules, where any do.
fn layouts(
    design: &Design,
    options: &RigOptions,
    topology: &Topology,
    progress: &mut dyn FnMut(Progress),
    cancel: &AtomicBool,
) -> Result<Vec<Fit>, RigError> {
    let (outline, stop) = (rim(&design.mesh), || cancel.load(atomic::Ordering::Relaxed));
    let sewable = sewable(design, &outline);
    let lawful = Task::new(design, Some(&sewable), &design.networks).trimming(options.trims);
    let free = Task::new(design, None, &design.networks).trimming(options.trims);
    // Nothing to build, or every pose is at rest already.
    if topology.tendons.is_empty() || lawful.poses.is_empty() {
        return Ok(Vec::new());
    }
    let samplers = [Some(&sewable), None].map(|sewable| Sampler::new(&design.mesh, sewable));
    let school = Topology { most_holes: design.sewing.most_holes, ..topology.clone() };
    let first = Linear::at_goals(&lawful, cancel).or_else(|| Linear::at_rest(&lawful));
    let mut joint = Joint::new(&lawful, &samplers[0], school.clone(), (options.rounds, options.seed), first, &stop);
    let mut schedule = Schedule::new(options);
    let mut has_algorithm2 = false;
    for round in 0..options.rounds {
        match schedule.turn(round) {
            Turn::Go => (),
            Turn::Anew => joint.leave(&lawful, &samplers[0], school.clone(), &stop),
            Turn::Heat => joint.heat(&stop),
            Turn::Gather => joint.gather(),
            Turn::Free => {
                joint.turn_to(&free, &samplers[1], topology.clone(), &stop);
                // Once: it is the same on all islands that follow.
                if !std::mem::replace(&mut has_algorithm2, true)
                    && let Some((layout, poses)) = of_algorithm2(&free, options, cancel)
                {
                    joint.take(layout, &poses, &stop);
                }
            }
        }
        let (Some(fit), Some(here)) = (joint.best(), joint.best_here()) else { break };
        let (worst, holes) = (fit.worst(), fit.layout.holes());
        progress(Progress::Round { round, rounds: options.rounds, worst, holes });
        if worst <= SERVED {
            break;
        }
        schedule.note(worst_helped(here.parts()));
        joint.advance(&stop);
        if stop() {
            break;
        }
    }
    if stop() {
        return so_far(joint.best(), options);
    }
    let task = if options.rules { &lawful } else { &free };
    let others = if options.rules { OTHERS } else { 0 };
    let mut finished = in_order(&joint.finalists(FINALISTS, others), |fit| {
        task.sharpened(pruned(task, topology, joint.finished(fit, &stop), &stop), SHARPENING, &stop)
    });
    if stop() {
        return so_far(joint.best(), options);
    }
    finished.sort_by(Fit::compare);
    if options.rules {
        let best = &finished[..STEADIED.min(finished.len())];
        let steadied = in_order(best, |fit| task.steadied(fit.clone(), &stop));
        finished = each_with_its_own(finished, steadied);
    }
    if stop() {
        return so_far(joint.best(), options);
    }
    if options.rules && finished.iter().any(|fit| sewable.is_kept(&fit.layout)) {
        finished.retain(|fit| sewable.is_kept(&fit.layout));
    }
    Ok(finished)
}

/// Fits, best first, each followed by what it was steadied to, so that the first of them are of both kinds.
fn each_with_its_own(fits: Vec<Fit>, steadied: Vec<Fit>) -> Vec<Fit> {
    let mut steadied = steadied.into_iter();
    fits.into_iter()
        .flat_map(|fit| {
            let own = steadied.next().filter(|own| own.layout != fit.layout);
            std::iter::once(fit).chain(own)
        })
        .collect()
}

/// What Algorithm 2 builds, its parameters varied, with activations and positions of every pose: a start where no rule forbids it. It is
/// remembered while its cost, all poses together, is among the best.
fn of_algorithm2(task: &Task, options: &RigOptions, cancel: &AtomicBool) -> Option<(Layout, Vec<Start>)> {
    let swept = RigOptions { method: Method::Algorithm2, keep: false, ..options.clone() };
    let rigged = greedy::rig(task.design, &swept, &mut |_| (), cancel).ok()?.design;
    let layout = Layout::of(&rigged.networks[task.fixed.len()..], &task.design.mesh);
    let posed = |(targets, _): &(Vec<Target>, f64)| {
        let shape = Checked::of(&rigged, targets, 0.0, cancel).shape;
        (shape.activations_mm, shape.nodes.into_iter().flatten().collect())
    };
    Some((layout, task.poses.iter().map(posed).collect()))
}

/// What a search that was told to stop ends with.
fn so_far(best: Option<&Fit>, options: &RigOptions) -> Result<Vec<Fit>, RigError> {
    if options.keep { Ok(best.cloned().into_iter().collect()) } else { Err(RigError::Cancelled) }
}

/// A pose as a check has it, errors in body lengths.
struct Verified {
    name: String,
    error: f64,
    /// With the design's friction at the holes; infinite where there is no such figure.
    real: f64,
    /// Where it should be sewn.
    sewn: Option<Sewn>,
    rest: f64,
    /// Largest pull of a winch, all its cables together, N.
    pull_n: f64,
    shape: Shape,
}

impl Verified {
    /// What a maker may expect.
    fn expected(&self) -> f64 {
        self.sewn.map_or(self.real, |sewn| sewn.expected(self.real))
    }
}

/// A rig and its poses that have targets.
type Candidate = (Design, Vec<Verified>);

fn posed(design: &Design) -> impl Iterator<Item = &Pose> {
    design.poses.iter().filter(|pose| !pose.targets.is_empty())
}

/// Whether a rig brings the poses closer to their targets, all taken together: one winch may serve one pose of several. `left`: errors as parts
/// of those at rest.
fn helps(left: impl Iterator<Item = f64>) -> bool {
    let (mut sum, mut count) = (0.0, 0.0);
    left.for_each(|part| (sum, count) = (sum + part * part, count + 1.0));
    sum < count
}

/// The design with a layout's networks, from the points of the body at all its spots.
fn with(design: &Design, layout: &Layout, points: &[BodyPoint]) -> Design {
    let mut with = design.clone();
    for network in layout.networks(&design.mesh, points) {
        let name = unused_name(&with);
        with.networks.push(Network { name, ..network });
    }
    let count = with.networks.len();
    with.keyframes.iter_mut().for_each(|keyframe| keyframe.activations_mm.resize(count, 0.0));
    with
}

/// The design with a layout's networks, and what a check says of every pose.
fn verified(design: &Design, fit: &Fit, cancel: &AtomicBool) -> Candidate {
    let points = fit.layout.located(&design.mesh);
    let with = points.map_or_else(|| design.clone(), |points| with(design, &fit.layout, &points));
    let friction = design.tendons.friction;
    let poses = posed(design).map(|pose| {
        let checked = Checked::of(&with, &pose.targets, friction, cancel);
        let rest = target_error(design, &pose.targets, &design.mesh.nodes).max(f64::MIN_POSITIVE);
        let mut tensions = checked.shape.tendon_tensions.iter();
        let pulls = with.networks.iter().map(|network| tensions.by_ref().take(network.tendons.len()).sum());
        let pull_n = pulls.fold(0.0, f64::max);
        Verified {
            name: pose.name.clone(),
            error: checked.error(),
            real: checked.real_error(),
            sewn: None,
            rest,
            pull_n,
            shape: checked.shape,
        }
    });
    let poses = poses.collect();
    (with, poses)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A design by its name, with poses of (error, pull), the error at rest being 0.2.
    fn candidate(name: &str, poses: &[(f64, f64)]) -> (Design, Vec<Verified>) {
        let mut design = crate::design::testing::sample();
        name.clone_into(&mut design.name);
        let pose = |&(error, pull_n): &(f64, f64)| {
            let sewn = Some(Sewn { median: error, worst: error });
            Verified { name: "pose".into(), error, real: error, sewn, rest: 0.2, pull_n, shape: Shape::default() }
        };
        (design, poses.iter().map(pose).collect())
    }

    #[test]
    fn what_is_found_goes_over_to_fine_meshes_by_steps() {
        assert!(between(701).is_empty() && between(2500).is_empty());
        assert_eq!((between(5000), between(10_000)), (vec![1290], vec![1290, 3870]));
    }

    #[test]
    fn rigs_that_sewing_cannot_save_are_not_sewn() {
        let mut all = vec![candidate("hopeless", &[(f64::INFINITY, 1.0)]), candidate("good", &[(0.02, 1.0)])];
        all.iter_mut().flat_map(|(_, poses)| poses).for_each(|pose| pose.sewn = None);
        let sewn = as_sewn(all, 0.0, &AtomicBool::new(false));
        assert!(sewn.len() == 1 && sewn[0].0.name == "good" && sewn[0].1[0].sewn.is_some());
    }

    #[test]
    fn of_rigs_that_nobody_can_tell_apart_the_one_that_pulls_least_is_chosen() {
        let all = || {
            vec![
                candidate("worse", &[(0.0200, 1.0), (0.0180, 1.0)]),
                candidate("best", &[(0.0100, 50.0), (0.0080, 9.0)]),
                candidate("alike", &[(0.0115, 20.0), (0.0095, 30.0)]),
                candidate("worse in one pose", &[(0.0105, 2.0), (0.0104, 2.0)]),
            ]
        };
        assert_eq!(chosen(all(), true).unwrap().0.name, "alike");
        assert_eq!(chosen(all(), false).unwrap().0.name, "best");
        assert!(chosen(Vec::new(), true).is_none());
        // One that has no figure is the last choice.
        let none = vec![candidate("none", &[(f64::INFINITY, 0.0)]), candidate("some", &[(0.1, 5.0)])];
        assert_eq!(chosen(none, true).unwrap().0.name, "some");
    }
}
