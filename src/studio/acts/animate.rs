//! The animation: playing, scrubbing, setting keyframes.

use super::edit;
use crate::defaults;
use crate::design::{Easing, Keyframe, animation, edit as edits};
use crate::operations::Context;
use crate::operations::key::{self, Error, Keyed, Note, Options};
use crate::studio::change::{Change, Made};
use crate::studio::jobs::{Outcome, Running};
use crate::studio::language::{mark, t, tf};
use crate::studio::session::{Mode, Session};
use crate::studio::words;

/// Plays from the playhead, or from the beginning where it is at the end.
pub fn play(session: &mut Session) {
    let end = animation::duration_s(session.design());
    if end <= 0.0 {
        session.messages.info(t("Put at least two keyframes on the timeline to play an animation."));
        return;
    }
    if session.playback.time_s >= end {
        session.playback.time_s = 0.0;
    }
    session.picked.mode = Mode::Animation;
    session.discovery.shown = None;
    session.playback.playing = true;
}

/// Moves the playhead.
pub fn scrub(session: &mut Session, time_s: f64) {
    session.playback.playing = false;
    session.playback.time_s = time_s.max(0.0);
    session.discovery.shown = None;
    session.picked.mode = if session.design().keyframes.is_empty() { Mode::Pose } else { Mode::Animation };
}

/// Makes a keyframe of what is seen: the animation at the playhead at once, a pose as soon as its activations are worked out.
pub fn add_keyframe(session: &mut Session) {
    if session.design().networks.is_empty() {
        return session.messages.warning(words::unkeyed(&Error::NoNetworks));
    }
    let time_s = key_time(session);
    match session.picked.mode {
        Mode::Pose => start_keying(session, time_s),
        Mode::Animation | Mode::Winding => {
            session.playback.playing = false;
            let activations_mm = match session.picked.mode {
                Mode::Winding => session.winding.wound_mm().to_vec(),
                _ => animation::activations_at(session.design(), session.playback.time_s),
            };
            let keyframe = Keyframe { time_s, activations_mm, pose: None, easing: Easing::default() };
            edit::change(session, Change::SetKeyframe(keyframe));
            session.playback.time_s = time_s;
        }
    }
}

/// Begins an animation: rest, a pose and rest again; beside a keyframe that is there already, what it moves to.
pub fn begin(session: &mut Session) {
    if session.keying.is_some() {
        return;
    }
    let steps = first_steps(session);
    let design = session.acting().clone();
    session.keying = Some(session.jobs.start(mark("The first keyframes"), move |cancel| {
        let context = Context::new(cancel);
        let keyed = |(pose, time_s): (Option<String>, f64)| {
            key::prepare(&design, &Options { pose, time_s, ..Options::default() }, &context)
        };
        Outcome::Begun(steps.into_iter().map(keyed).collect())
    }));
}

/// Poses and times, s.
fn first_steps(session: &Session) -> Vec<(Option<String>, f64)> {
    const STEP_S: f64 = defaults::KEYFRAME_SPACING_S;
    let design = session.design();
    let posed = |index: &usize| design.poses.get(*index).is_some_and(|pose| !pose.targets.is_empty());
    let pose = session.picked.pose.filter(posed).or((0..design.poses.len()).find(|index| posed(index)));
    let pose = pose.map(|index| design.poses[index].name.clone());
    match design.keyframes.first() {
        None => vec![(None, 0.0), (pose, STEP_S), (None, 2.0 * STEP_S)],
        Some(there) => vec![(if there.pose.is_some() { None } else { pose }, there.time_s + STEP_S)],
    }
}

/// What a job for keyframes has found, if it is the one that is waited for; what was wrong is told.
fn worked_out<T>(session: &mut Session, serial: u64, keyed: Result<T, Error>) -> Option<T> {
    if !Running::is(session.keying.as_ref(), serial) {
        return None;
    }
    session.keying = None;
    keyed.map_err(|error| session.messages.error(words::unkeyed(&error))).ok()
}

/// The first keyframes are worked out: one step.
pub fn take_first(session: &mut Session, serial: u64, keyed: Result<Vec<Keyed>, Error>) {
    let Some(keyed) = worked_out(session, serial, keyed) else { return };
    for Note::Unbalanced(unbalanced) in keyed.iter().flat_map(|keyed| &keyed.notes) {
        session.messages.warning(unbalanced.to_string());
    }
    let all = |design: &mut _| keyed.into_iter().try_for_each(|keyed| keyed.apply(design).map(drop));
    match session.document.history.edit(mark("First keyframes"), all) {
        Ok(()) => session.messages.info(t("Space plays it. Keyframes are dragged along the timeline, K adds more.")),
        Err(error) => session.messages.error(words::unkeyed(&error.into())),
    }
}

/// The playhead. A keyframe that it has already is replaced, but not by another pose: poses that are added without a look at the timeline
/// come one after the other.
fn key_time(session: &Session) -> f64 {
    let (design, time_s) = (session.design(), session.playback.time_s);
    let Some(there) = edits::keyframe_at(design, time_s) else { return time_s };
    let pose = session.picked.pose.and_then(|pose| design.poses.get(pose)).map(|pose| &pose.name);
    let other = session.picked.mode == Mode::Pose && design.keyframes[there].pose.as_ref() != pose;
    if other { animation::duration_s(design) + defaults::KEYFRAME_SPACING_S } else { time_s }
}

fn start_keying(session: &mut Session, time_s: f64) {
    if session.keying.is_some() {
        return;
    }
    let design = session.acting().clone();
    let pose = session.picked.pose.and_then(|pose| design.poses.get(pose)).map(|pose| pose.name.clone());
    let options = Options { pose, time_s, ..Options::default() };
    session.keying = Some(session.jobs.start(mark("The keyframe"), move |cancel| {
        Outcome::Keyed(key::prepare(&design, &options, &Context::new(cancel)))
    }));
}

/// The keyframe is worked out.
pub fn take_key(session: &mut Session, serial: u64, keyed: Result<Keyed, Error>) {
    let Some(keyed) = worked_out(session, serial, keyed) else { return };
    let time_s = keyed.keyframe.time_s;
    for Note::Unbalanced(unbalanced) in &keyed.notes {
        session.messages.warning(tf!("The keyframe at {time_s:.2} s: {unbalanced}", time_s, unbalanced));
    }
    match session.document.history.edit(mark("Set keyframe"), |design| keyed.apply(design)) {
        Ok(index) => {
            edit::pick_out(session, Made::Keyframe(index));
            session.playback.time_s = time_s;
        }
        Err(error) => session.messages.error(words::unkeyed(&error.into())),
    }
}
