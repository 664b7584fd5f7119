//! Proposals for a bar that bends: what is told of them, rules kept, the same bits, and the end when it is asked for.

use super::*;
use crate::engine::{Setpoint, solve_once};
use crate::rigging::layout::{Layout, Placed};
use crate::rigging::sewable::Sewable;
use crate::rigging::tests::bar;
use std::cell::Cell;

fn found(design: &Design, options: &ProposeOptions) -> (Vec<Vec<Arc<Proposal>>>, Vec<Arc<Proposal>>) {
    let mut lists = Vec::new();
    let mut hear = |list: &[Arc<Proposal>]| lists.push(list.to_vec());
    let last = propose(design, &design.poses[0].targets, options, &mut hear, &AtomicBool::new(false));
    (lists, last)
}

/// All figures to the last bit, as text.
fn bits(list: &[Arc<Proposal>]) -> Vec<String> {
    list.iter().map(|p| format!("{:?} {:?} {:?} {}", p.network, p.poses, p.sewn, p.force_n)).collect()
}

#[test]
fn proposals_come_one_by_one_differ_in_kind_and_tell_what_a_check_says() {
    let mut design = bar(80);
    design.tendons.friction = 0.1;
    let options = ProposeOptions::default();
    let (lists, last) = found(&design, &options);
    assert!(lists.len() >= 2 && lists[0].len() == 1, "{} lists", lists.len());
    assert_eq!(bits(lists.last().unwrap()), bits(&last));
    assert!(last.windows(2).all(|pair| pair[0].rank() <= pair[1].rank()));
    let go = AtomicBool::new(false);
    for proposal in &last {
        let mut with = design.clone();
        with.networks.push(proposal.network.clone());
        with.validate().unwrap();
        assert_eq!((proposal.current, proposal.poses.len()), (0, 2));
        for (pose, told) in design.poses.iter().zip(&proposal.poses) {
            let shape = |design| {
                let setpoint = Setpoint::Targets(pose.targets.clone());
                solve_once(design, setpoint, [false, true], &go).realizable.unwrap()
            };
            let (before, after) = (shape(&design), shape(&with));
            assert_eq!((told.before, told.after), (before.target_error, after.target_error));
            assert!(told.with_friction.is_some() && after.tendon_tensions.iter().all(|t| *t <= proposal.force_n));
        }
        assert!(proposal.error_after() < proposal.error_before() && proposal.sewn.is_some());
        assert_eq!(with.breaches(), []);
        assert_eq!(proposal.holes, proposal.network.tendons.iter().map(|t| t.routing.len() - 2).sum::<usize>());
    }
    assert!(last[0].rank() < 0.3 * last[0].error_before(), "{}", last[0].rank());
    assert_eq!(bits(&found(&design, &options).1), bits(&last));
}

#[test]
fn what_is_there_stays_and_tendons_are_as_many_as_asked_for() {
    let design = bar(60);
    let options = ProposeOptions { fewer: false, ..ProposeOptions::default() };
    let cables = vec![vec![[120.0, 48.0], [210.0, 44.0]].into()];
    let up = Layout { winches: vec![Placed { at: [40.0, 30.0], cables }] };
    let points = up.located(&design.mesh).unwrap();
    let mut with = design.clone();
    with.networks = up.networks(&design.mesh, &points);
    // The pose down is not served by a winch that bends up.
    let hear = &mut |_: &[Arc<Proposal>]| ();
    let second = propose(&with, &with.poses[1].targets, &options, hear, &AtomicBool::new(false));
    for proposal in &second {
        assert_eq!(proposal.network.tendons.len(), 2);
    }
    assert!(second.iter().all(|p| p.network.name == "winch 2" && p.current == 1 && p.breaches.is_empty()));
    assert!(second[0].serves().any(|name| name == "down"), "{:?}", second[0].poses);
}

#[test]
fn targets_of_no_pose_are_told_last_and_those_at_rest_need_no_network() {
    let design = bar(80);
    let mut targets = design.poses[0].targets.clone();
    targets[0].to[1] -= 20.0;
    let hear = &mut |_: &[Arc<Proposal>]| ();
    let go = AtomicBool::new(false);
    let last = propose(&design, &targets, &ProposeOptions::default(), hear, &go);
    let names: Vec<Option<&str>> = last[0].poses.iter().map(|pose| pose.name.as_deref()).collect();
    assert_eq!((names, last[0].current), (vec![Some("up"), Some("down"), None], 2));
    for target in &mut targets {
        target.to = design.mesh.position(&target.at, &design.mesh.nodes);
    }
    assert!(propose(&design, &targets, &ProposeOptions::default(), hear, &go).is_empty());
}

#[test]
fn a_search_that_is_stopped_keeps_what_it_has_told() {
    let design = bar(80);
    let stop = AtomicBool::new(false);
    let told = Cell::new(0);
    let mut hear = |list: &[Arc<Proposal>]| {
        told.set(list.len());
        stop.store(true, Ordering::Relaxed);
    };
    let list = propose(&design, &design.poses[0].targets, &ProposeOptions::default(), &mut hear, &stop);
    assert_eq!((list.len(), told.get()), (1, 1));
    assert!(propose(&design, &design.poses[0].targets, &ProposeOptions::default(), &mut hear, &stop).is_empty());
}

#[test]
fn networks_of_algorithm_2_come_with_their_stages_and_are_moved_until_they_can_be_sewn_or_left_out() {
    let design = bar(200);
    let posed = Design { poses: design.poses[..1].to_vec(), ..design.clone() };
    let options = ProposeOptions::default();
    let go = AtomicBool::new(false);
    let layouts = paper::layouts(&posed, false, &options, 8, &go);
    assert!(!layouts.is_empty());
    for (layout, paper) in &layouts {
        let (parameters, stages) = paper.as_ref().unwrap();
        assert_eq!(layout.winches[0].cables.len(), stages.tendons.len());
        assert!(parameters.tendon_num <= 2 && layout.winches[0].cables.iter().all(|cable| cable.len() <= 9));
    }
    let edge = rim(&posed.mesh);
    let rules = sewable(&posed, &edge);
    let moved = |sewable: Option<&Sewable>| {
        let task = Task::new(&posed, sewable, &[]);
        let sampler = Sampler::new(&posed.mesh, sewable);
        let topology = Topology { tendons: vec![[1, 2]], most_holes: 8 };
        let mut pool = Pool::new(&task, &sampler, topology, 1, &go);
        layouts.iter().for_each(|layout| pool.take(layout.clone(), &|| false));
        pool.best(ALIVE)
    };
    let free = moved(None);
    assert!(!free.is_empty() && free.iter().all(|(_, paper)| paper.is_some()));
    assert!(moved(Some(&rules)).iter().all(|(fit, _)| rules.is_kept(&fit.layout)));
}
