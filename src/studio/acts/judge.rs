//! Judges the design on a thread while it changes: how near its poses come, which rules of sewing it breaks.

use crate::design::Design;
use crate::engine::{Effort, Quality, Request, Setpoint, Solver};
use crate::studio::jobs::Outcome;
use crate::studio::language::mark;
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
        let running = session.jobs.start(mark("Judging the design"), move |cancel| {
            let errors = {
                let mut trackers = trackers.lock().unwrap_or_else(PoisonError::into_inner);
                trackers.retain(|name, _| design.poses.iter().any(|pose| pose.name == *name));
                quick(&design, &mut trackers, cancel)
            };
            Outcome::Judged(Box::new(Judgement::Quick { breaches: design.breaches(), errors, design }))
        });
        return session.judging.begin(running, None);
    }
    // What the views show comes first.
    if !hands_off || session.playback.playing || !session.is_settled() {
        return;
    }
    if let Some((design, pose)) = session.judging.next_pose(session.pose()) {
        let of = (design.clone(), pose);
        let trackers = session.judging.trackers.clone();
        let running = session.jobs.start(mark("Judging a pose"), move |cancel| {
            // From rest, as `check` does; what follows the hand later goes on from there.
            let mut solver = Solver::default();
            let request = request(&design, pose, Quality::Accurate);
            let found = solver.solve_with(&request, Effort::Thorough, cancel).realizable;
            let error = found.filter(|_| !cancel.load(Ordering::SeqCst)).map(|shape| shape.target_error);
            if error.is_some() {
                let mut trackers = trackers.lock().unwrap_or_else(PoisonError::into_inner);
                trackers.insert(design.poses[pose].name.clone(), solver);
            }
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
        let request = request(design, number, Quality::Balanced);
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

/// The realizable plushie in a pose.
fn request(design: &Arc<Design>, pose: usize, quality: Quality) -> Request {
    let setpoint = Setpoint::Targets(design.poses[pose].targets.clone());
    Request { id: 0, design: design.clone(), setpoint, quality, show_idealized: false, show_realizable: true }
}
