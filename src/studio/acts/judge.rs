//! Judges the design on a thread while it changes: how near its poses come, which rules of sewing it breaks.

use crate::design::Design;
use crate::engine::{Quality, Request, Setpoint, Solver, solve_once};
use crate::fabrication::judge_design;
use crate::studio::jobs::Outcome;
use crate::studio::session::{Judgement, Session};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, PoisonError};

/// Frames that a quick look at a pose takes at most: from the pose of the design before, one or two do.
const FRAMES: usize = 4;

/// Once a frame: starts what is to be judged next, one job at a time. While a hand drags there are quick figures, later those that are kept.
pub fn follow(session: &mut Session, hands_off: bool) {
    let design = session.acting().clone();
    session.judging.follow(&design);
    if session.judging.is_running() {
        return;
    }
    if let Some(design) = session.judging.take_due() {
        let trackers = session.judging.trackers.clone();
        let running = session.jobs.start("Judging the design", move |cancel| {
            let errors = {
                let mut trackers = trackers.lock().unwrap_or_else(PoisonError::into_inner);
                trackers.retain(|name, _| design.poses.iter().any(|pose| pose.name == *name));
                quick(&design, &mut trackers, cancel)
            };
            Outcome::Judged(Box::new(Judgement::Quick { breaches: judge_design(&design), errors, design }))
        });
        return session.judging.begin(running, None);
    }
    // What the views show comes first.
    if !hands_off || session.playback.playing || !session.is_settled() {
        return;
    }
    if let Some((design, pose)) = session.judging.next_pose(session.pose()) {
        let of = (design.clone(), pose);
        let running = session.jobs.start("Judging a pose", move |cancel| {
            let setpoint = Setpoint::Targets(design.poses[pose].targets.clone());
            let found = solve_once(&design, setpoint, [false, true], cancel).realizable;
            let error = found.filter(|_| !cancel.load(Ordering::SeqCst)).map(|shape| shape.target_error);
            Outcome::Judged(Box::new(Judgement::Thorough { design, pose, error }))
        });
        session.judging.begin(running, Some(of));
    }
}

/// How near the poses come at once from where they were in the design before.
fn quick(design: &Arc<Design>, trackers: &mut BTreeMap<String, Solver>, cancel: &AtomicBool) -> Vec<(usize, f64)> {
    if design.networks.is_empty() {
        return Vec::new();
    }
    let mut errors = Vec::new();
    for (number, pose) in design.poses.iter().enumerate().filter(|(_, pose)| !pose.targets.is_empty()) {
        let request = Request {
            id: 0,
            design: design.clone(),
            setpoint: Setpoint::Targets(pose.targets.clone()),
            quality: Quality::Balanced,
            show_idealized: false,
            show_realizable: true,
        };
        let solver = trackers.entry(pose.name.clone()).or_default();
        let mut error = None;
        for _ in 0..FRAMES {
            if cancel.load(Ordering::SeqCst) {
                return errors;
            }
            let Some(shape) = solver.solve(&request, cancel).realizable else { break };
            error = Some(shape.target_error);
            if shape.converged {
                break;
            }
        }
        errors.extend(error.map(|error| (number, error)));
    }
    errors
}
