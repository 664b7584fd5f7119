//! The joint search on a bar that bends: slopes, what is reached, rules kept, the same bits.

use super::annealing::{Annealing, Cooling};
use super::joint::Joint;
use super::layout::{Layout, Placed};
use super::linear_score::Linear;
use super::moves::{Sampler, Topology};
use super::refine::{Fit, Task};
use super::sewable::Sewable;
use super::{Found, RigOptions, TendonChoice, kinds, rig};
use crate::design::{Design, Pin, Pose, Target};
use crate::engine::{Setpoint, solve_once, target_error};
use crate::mesh::{self, BodyPoint};
use crate::outline::{Outline, Point};
use crate::random::Random;
use crate::sewing::Rules;
use std::sync::atomic::{AtomicBool, Ordering};

const GO: &(dyn Fn() -> bool + Sync) = &|| false;

/// A bar of 240 x 60 mm, held at the left, to be bent up at the right, and down.
pub(super) fn bar(fibers: usize) -> Design {
    let corners = vec![[0.0, 0.0], [240.0, 0.0], [240.0, 60.0], [0.0, 60.0]];
    let outline = Outline { outer: corners, holes: vec![] };
    let mesh = mesh::generate(&outline, fibers).unwrap();
    let mut design = Design::new("bar", outline, mesh);
    let at = |p: Point| -> BodyPoint { design.mesh.locate_nearest(p, &design.mesh.nodes).unwrap().0 };
    let pin = |p: Point| Pin::at_rest(at(p), 20.0);
    let target = |p: Point, to: Point| Target { at: at(p), to, weight: 1.0 };
    let pins = vec![pin([0.0, 5.0]), pin([0.0, 55.0])];
    let pose = |name: &str, up: f64| Pose {
        name: name.into(),
        targets: vec![
            target([238.0, 30.0], [215.0, 30.0 + 70.0 * up]),
            target([120.0, 30.0], [115.0, 30.0 + 15.0 * up]),
        ],
    };
    let poses = vec![pose("up", 1.0), pose("down", -1.0)];
    (design.pins, design.poses) = (pins, poses);
    design
}

fn layout() -> Layout {
    let winch = |y: f64, end: f64| Placed { at: [40.0, 30.0], cables: vec![vec![[120.0, y], [210.0, end]].into()] };
    Layout { winches: vec![winch(48.0, 44.0), winch(12.0, 18.0)] }
}

#[test]
fn improving_brings_the_cost_down_and_ends_where_no_point_wants_to_move() {
    let design = bar(200);
    let task = Task::new(&design, None, &[]);
    let begun = task.begin(layout(), GO).unwrap();
    let posed = task.improve(begun.clone(), 40, true, GO);
    assert_eq!(posed.layout, begun.layout);
    assert!(posed.cost < begun.cost);
    let moved = task.improve(posed.clone(), 60, false, GO);
    assert!(moved.worst() < 0.5 * posed.worst(), "{} after {}", moved.worst(), posed.worst());
    // Differences: no small move of a point, activations improved again, gains more than a little.
    for spot in moved.layout.spots() {
        for axis in 0..2 {
            for by in [-1.0, 1.0] {
                let mut layout = moved.layout.clone();
                layout.point_mut(spot)[axis] += by;
                let Some(there) = task.resume(layout, &moved, GO) else { continue };
                let there = task.improve(there, 20, true, GO);
                assert!(there.cost > 0.5 * moved.cost, "{spot:?} {axis}: {} before {}", there.cost, moved.cost);
            }
        }
    }
}

#[test]
fn a_fit_is_wound_from_rest_and_travels_to_a_finer_mesh() {
    let (coarse, fine) = (bar(150), bar(900));
    let task = Task::new(&coarse, None, &[]);
    let fit = task.improve(task.begin(layout(), GO).unwrap(), 40, false, GO);
    let wound = task.wound(fit.clone(), 0, GO).unwrap();
    assert!(wound.worst() < fit.worst() + 0.01, "{} {}", wound.worst(), fit.worst());
    let there = Task::new(&fine, None, &[]);
    let moved = there.transferred(&fit, GO).unwrap();
    assert!(moved.worst() < fit.worst() + 0.05, "{} {}", moved.worst(), fit.worst());
}

#[test]
fn the_search_keeps_every_rule_and_gives_the_same_bits() {
    let design = bar(80);
    let outline = design.outline.clone();
    let sewable = Sewable::new(Rules::default(), &outline, &outline, 60.0, Vec::new());
    let task = Task::new(&design, Some(&sewable), &[]);
    let sampler = Sampler::new(&design.mesh, Some(&sewable));
    let topology = Topology { tendons: vec![[1, 1]; 2], most_holes: 4 };
    let search = || {
        let goals = Linear::at_goals(&task, &AtomicBool::new(false));
        let mut joint = Joint::new(&task, &sampler, topology.clone(), (2, 7), goals, GO);
        (0..2).for_each(|_| joint.advance(GO));
        // Others that it ends with differ in kind from the best and from each other.
        let ends = joint.finalists(1, 3);
        let apart_mm = kinds::APART * design.body_length_mm();
        for (k, one) in ends.iter().enumerate() {
            assert!(ends[..k].iter().all(|other| kinds::distance(&one.layout, &other.layout) > apart_mm));
        }
        assert!((2..=4).contains(&ends.len()), "{}", ends.len());
        joint.finalists(1, 0).remove(0)
    };
    let (once, again) = (search(), search());
    assert_eq!((once.cost.to_bits(), &once.layout), (again.cost.to_bits(), &again.layout));
    assert!(once.worst() < 0.3 && sewable.is_kept(&once.layout), "{} {:?}", once.worst(), once.layout);
}

#[test]
fn a_rig_names_its_winches_and_what_a_check_would_say() {
    let design = bar(80);
    let go = AtomicBool::new(false);
    let options =
        RigOptions { max_winches: 2, tendons: TendonChoice::Between(1, 2), rounds: 1, ..RigOptions::default() };
    let mut told = None;
    let mut progress = |step| {
        if let super::Progress::Found { errors, .. } = step {
            told = Some(errors);
        }
    };
    let found = rig(&design, &options, &mut progress, &go).unwrap();
    assert!(!found.is_interrupted() && !found.coarse);
    let Found { design: rigged, wound, .. } = found;
    rigged.validate().unwrap();
    assert_eq!(wound.len(), rigged.poses.len());
    for ((pose, (name, error)), wound) in rigged.poses.iter().zip(told.unwrap()).zip(wound) {
        let setpoint = Setpoint::Targets(pose.targets.clone());
        let shape = solve_once(&rigged, setpoint, [false, true], &go).realizable.unwrap();
        assert_eq!((&pose.name, shape.target_error.to_bits()), (&name, error.to_bits()));
        assert_eq!((&pose.name, &shape.activations_mm), (&wound.pose, &wound.activations_mm));
        assert_eq!(wound.checked.unwrap().activations_mm, wound.activations_mm);
    }
    let stopped = rig(&design, &options, &mut |_| (), &AtomicBool::new(true));
    assert_eq!(stopped, Err(super::RigError::Cancelled));
}

#[test]
fn a_pose_out_of_reach_costs_the_others_nothing() {
    let mut design = bar(80);
    let pinned = design.pins[0].at;
    design.pins.iter_mut().for_each(|pin| pin.stiffness = 1e5);
    let go = AtomicBool::new(false);
    let options =
        RigOptions { max_winches: 2, tendons: TendonChoice::Between(1, 2), rounds: 1, ..RigOptions::default() };
    let parts = |design: &Design| -> Vec<f64> {
        let found = rig(design, &options, &mut |_| (), &go).unwrap();
        let rest = |targets: &[Target]| target_error(design, targets, &design.mesh.nodes);
        let shapes = found.wound.iter().zip(&design.poses);
        shapes.map(|(wound, pose)| wound.checked.as_ref().unwrap().target_error / rest(&pose.targets)).collect()
    };
    let alone = parts(&design);
    let stuck = Pose { name: "stuck".into(), targets: vec![Target { at: pinned, to: [30.0, 40.0], weight: 1.0 }] };
    design.poses.push(stuck);
    let beside = parts(&design);
    assert!(beside[2] > 0.9 && beside[..2].iter().zip(&alone).all(|(b, a)| *b < a + 0.1), "{beside:?} {alone:?}");
}

#[test]
fn options_that_leave_nothing_to_build_find_nothing() {
    let go = AtomicBool::new(false);
    let of = |design: &Design, options: &RigOptions| rig(design, options, &mut |_| (), &go);
    let none = RigOptions { max_winches: 0, ..RigOptions::default() };
    assert_eq!(of(&bar(80), &none), Err(super::RigError::NothingFound));
    let mut resting = bar(80);
    for pose in &mut resting.poses {
        pose.targets.iter_mut().for_each(|t| t.to = resting.mesh.position(&t.at, &resting.mesh.nodes));
    }
    assert_eq!(of(&resting, &RigOptions::default()), Err(super::RigError::NothingFound));
    // The wrong way around, and no tendon at all: one is the least that a winch has.
    let odd = RigOptions { max_winches: 1, rounds: 0, tendons: TendonChoice::Between(2, 0), ..RigOptions::default() };
    assert_eq!(of(&bar(80), &odd).map(|found| found.design.networks[0].tendons.len()), Ok(2));
}

#[test]
fn a_search_that_is_told_to_stop_ends_with_the_best_so_far_where_that_is_asked_for() {
    let design = bar(80);
    let searched = |keep: bool| {
        let stop = AtomicBool::new(false);
        let options =
            RigOptions { max_winches: 1, tendons: TendonChoice::PerWinch(vec![1]), keep, ..RigOptions::default() };
        // After the first layouts, in the first round.
        rig(&design, &options, &mut |_| stop.store(true, Ordering::SeqCst), &stop)
    };
    assert_eq!(searched(false), Err(super::RigError::Cancelled));
    let kept = searched(true).unwrap();
    kept.design.validate().unwrap();
    assert_eq!(kept.design.networks.len(), 1);
    // What it winds brings every pose nearer.
    let (go, names) = (AtomicBool::new(false), kept.wound.iter().map(|wound| &wound.pose));
    assert!(names.eq(design.poses.iter().map(|pose| &pose.name)));
    assert!(kept.is_interrupted());
    for (pose, wound) in kept.design.poses.iter().zip(&kept.wound) {
        let wound_mm = &wound.activations_mm;
        let wound = solve_once(&kept.design, Setpoint::Activations(wound_mm.clone()), [false, true], &go);
        let miss = |nodes: &[Point]| target_error(&design, &pose.targets, nodes);
        assert!(miss(&wound.realizable.unwrap().nodes) < miss(&design.mesh.nodes), "{} {wound_mm:?}", pose.name);
    }
}

#[test]
fn targets_that_move_by_less_than_anybody_sees_change_no_bit_of_a_rig() {
    let design = bar(80);
    let go = AtomicBool::new(false);
    let options =
        RigOptions { max_winches: 1, tendons: TendonChoice::PerWinch(vec![1]), rounds: 1, ..RigOptions::default() };
    let mut moved = design.clone();
    for target in moved.poses.iter_mut().flat_map(|pose| &mut pose.targets) {
        target.to = target.to.map(|v| v + 240.0 * 1e-9);
    }
    let [a, b] = [&design, &moved].map(|design| rig(design, &options, &mut |_| (), &go).unwrap().design);
    assert_eq!(a.networks, b.networks);
}

/// What the linear model says of the fit that it is around, and of a small change, is what a simulation finds.
#[test]
fn the_body_around_a_fit_tells_what_small_changes_do() {
    let design = bar(150);
    let task = Task::new(&design, None, &[]);
    let fit = task.improve(task.begin(layout(), GO).unwrap(), 12, false, GO);
    let fit = task.improve(fit, 30, true, GO);
    let around = Linear::at(&task, &fit).unwrap();
    let squares = |fit: &Fit| fit.misses.iter().map(|f| f * f).sum::<f64>();
    // The windings of the fit are among those that the model may choose.
    assert!(around.missed(&fit.layout) < 1.05 * squares(&fit) + 1e-6);
    let (mut told, mut found) = (Vec::new(), Vec::new());
    for spot in fit.layout.spots() {
        for by in [-3.0, 3.0] {
            let mut layout = fit.layout.clone();
            layout.point_mut(spot)[1] += by;
            let Some(there) = task.resume(layout.clone(), &fit, GO) else { continue };
            let there = task.improve(there, 30, true, GO);
            told.push(around.missed(&layout) - around.missed(&fit.layout));
            found.push(squares(&there) - squares(&fit));
        }
    }
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let cosine = dot(&told, &found) / (dot(&told, &told) * dot(&found, &found)).sqrt();
    assert!(cosine > 0.9, "{cosine}: {told:?} {found:?}");
}

/// Layouts that are annealed around the goals get there better than as they come, already where they are tried for the first time.
#[test]
fn what_is_annealed_around_the_goals_comes_nearer_to_them() {
    let design = bar(150);
    let task = Task::new(&design, None, &[]);
    let sampler = Sampler::new(&design.mesh, None);
    let topology = Topology { tendons: vec![[1, 1]; 2], most_holes: 4 };
    let linear = Linear::at_goals(&task, &AtomicBool::new(false)).unwrap();
    let annealing = Annealing { task: &task, sampler: &sampler, topology: &topology, linear: &linear, stop: GO };
    let (mut plain, mut better) = (Vec::new(), Vec::new());
    for number in 0..6 {
        let random = &mut Random::of(3, "layout", number);
        let layout = sampler.layout(&topology, random);
        let cooling = Cooling { steps: 300, hot: 0.1, cold: 0.02 };
        let annealed = annealing.run(layout.clone(), cooling, random);
        let whole = annealing.cost(&annealed, f64::INFINITY);
        assert!(whole <= annealing.cost(&layout, f64::INFINITY));
        // A part of a cost is more than the limit that it was asked up to, and never more than the whole.
        let part = annealing.cost(&annealed, 0.5 * whole);
        assert!(part > 0.5 * whole && part <= whole);
        plain.extend(task.begin(layout, GO).map(|fit| fit.worst()));
        let starts = linear.starts(&annealed).unwrap();
        better.extend(task.taken(annealed, &starts, GO).map(|fit| fit.worst()));
    }
    let least = |all: &[f64]| all.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(least(&better) < 0.3 && least(&better) < 0.6 * least(&plain), "{better:?} {plain:?}");
}
