//! Once a frame: what the threads report, the playhead, what should be seen next.

use super::{animate, discover, edit, filing, film, follow, import, judge, mesh, motors, onion, rig, sheet, texture};
use crate::design::animation;
use crate::engine::Setpoint;
use crate::studio::canvas::Plushie;
use crate::studio::jobs::{Finished, Outcome, Running};
use crate::studio::language::{t, tf};
use crate::studio::session::{Done, Mode, ONION, Session};
use std::sync::Arc;

/// Takes what the threads have to report, moves the playhead, asks for what should be seen next.
/// `hands_off`: nobody holds a button or types, so gestures are over.
pub fn tick(session: &mut Session, now_s: f64, passed_s: f64, hands_off: bool) {
    session.messages.tick(now_s);
    while let Some(finished) = session.jobs.next() {
        take(session, finished);
    }
    motors::follow(session);
    if session.solver.revive() {
        session.messages.error(t(
            "The solver broke down and was started again. Your work is as it was; the last good shapes are shown",
        ));
    }
    session.solver.take(session.design().mesh.nodes.len());
    if hands_off {
        session.document.history.commit();
    }
    sheet::give_body(session, hands_off);
    if session.playback.playing {
        session.playback.advance(passed_s, animation::duration_s(session.document.design()));
    }
    edit::clamp(session);
    let design = session.document.design().clone();
    session.look.marked.take_if(|(of, _)| !Arc::ptr_eq(of, &design));
    session.playback.follow(animation::duration_s(&design));
    session.posing.follow(&design);
    session.timing.follow(&design);
    discover::follow(session);
    discover::live(session, hands_off);
    session.rigging.curve.follow(session.document.design());
    texture::follow_texture(session);
    follow::follow(session, hands_off);
    import::follow(session);
    // Nobody sees the plushies while the outline is drawn.
    if !session.sketching.open {
        ask(session);
        onion::follow(session);
        judge::follow(session, hands_off);
    }
}

/// Asks the solver for what the views show.
fn ask(session: &mut Session) {
    let document = session.design().clone();
    session.solo.follow(&document);
    let design = session.acting().clone();
    let setpoint = match session.picked.mode {
        Mode::Pose => Setpoint::Targets(session.targets().to_vec()),
        Mode::Animation => Setpoint::Activations(animation::activations_at(&document, session.playback.time_s)),
        Mode::Winding => Setpoint::Activations(session.winding.wound_mm().to_vec()),
    };
    let shows = [Plushie::Idealized, Plushie::Realizable].map(|plushie| session.look.views.shows(plushie));
    session.solver.ask(design, setpoint, shows);
}

/// A job is over.
fn take(session: &mut Session, Finished { serial, outcome }: Finished) {
    if Running::is(session.files.running.as_ref(), serial) {
        session.files.running = None;
        session.files.working = None;
        session.files.done = Done::default();
    }
    match outcome {
        Outcome::Proposed(proposals) => discover::take_proposals(session, serial, proposals),
        Outcome::Remeshed(made) => mesh::take_mesh(session, serial, made),
        Outcome::Reshaped(made) => sheet::take_body(session, serial, made),
        Outcome::Rigged(rigged) => rig::take_rig(session, serial, rigged),
        Outcome::Explored(points) => rig::take_curve(session, serial, points),
        Outcome::Keyed(keyed) => animate::take_key(session, serial, keyed),
        Outcome::Begun(keyed) => animate::take_first(session, serial, keyed),
        Outcome::Followed(keyed) => follow::take(session, serial, keyed),
        Outcome::Judged(judgement) => session.judging.take(serial, *judgement),
        Outcome::Imported(result) => filing::take_import(session, result),
        Outcome::Previewed { path, import, result } => session.files.preview.take(serial, path, *import, result),
        Outcome::Exported { folder, result } => filing::take_export(session, &folder, result),
        Outcome::Filmed { path, result } => film::take(session, serial, &path, result),
        Outcome::Textured { path, texture } => texture::take_texture(session, path, texture),
        Outcome::Picked { path, at_once } => filing::take_path(session, serial, path, at_once),
        Outcome::Told { owner: ONION, told } => session.look.onion.take(serial, &told),
        Outcome::Told { owner, told } => session.tasks.finish(owner, serial, told),
        Outcome::Broken { job, why } => {
            break_off(session, serial);
            session.messages.error(tf!("{job} failed: {why}", job = t(job), why));
        }
    }
}

/// Nobody waits for a job any more that broke.
fn break_off(session: &mut Session, serial: u64) {
    let jobs = [
        &mut session.discovery.running,
        &mut session.meshing.running,
        &mut session.rigging.running,
        &mut session.rigging.curve.running,
        &mut session.keying,
        &mut session.filming.running,
    ];
    for running in jobs {
        if Running::is(running.as_ref(), serial) {
            *running = None;
        }
    }
    if session.following.running.as_ref().is_some_and(|(running, _)| running.serial == serial) {
        let design = session.document.design().clone();
        session.following.settle(&design);
    }
    if Running::is(session.look.onion.running.as_ref(), serial) {
        session.look.onion.running = None;
    }
    session.judging.break_off(serial);
    session.files.preview.break_off(serial);
    // As if there were none: a path can be typed.
    filing::take_path(session, serial, None, true);
    session.tasks.break_off(serial);
}
