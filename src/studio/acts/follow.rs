//! Keyframes of poses are worked out again where winches, body or targets have changed, as part of the step that changed them.

use crate::operations::Context;
use crate::operations::key::{self, Error, Keyed, Note};
use crate::studio::jobs::{Outcome, Running};
use crate::studio::language::{mark, tf, tn};
use crate::studio::session::Session;
use crate::studio::words;

/// Once a frame.
pub fn follow(session: &mut Session, hands_off: bool) {
    let design = session.document.design().clone();
    if session.following.is_new() {
        return session.following.settle(&design);
    }
    if !hands_off || session.document.history.in_gesture() || session.following.is_at(&design) {
        return;
    }
    let Some(before) = session.following.before(&design) else { return };
    let poses = key::outdated(before, &design);
    if poses.is_empty() {
        return session.following.settle(&design);
    }
    session.following.cancel();
    let of = design.clone();
    let running = session.jobs.start(mark("Keyframes of poses"), move |cancel| {
        Outcome::Followed(key::again(&design, &poses, &Context::new(cancel)))
    });
    session.following.running = Some((running, of));
}

/// The keyframes are worked out.
pub fn take(session: &mut Session, serial: u64, keyed: Result<Vec<Keyed>, Error>) {
    let Some((_, of)) = session.following.running.take_if(|(running, _)| Running::is(Some(running), serial)) else {
        return;
    };
    // Another change came in between: the next frame begins anew.
    if !std::sync::Arc::ptr_eq(&of, session.document.design()) {
        return;
    }
    let keyed = match keyed {
        Ok(keyed) => keyed,
        Err(error) => {
            session.messages.warning(tf!("Keyframes do not follow their poses: {why}", why = words::unkeyed(&error)));
            return session.following.settle(&of);
        }
    };
    for Note::Unbalanced(unbalanced) in keyed.iter().flat_map(|keyed| &keyed.notes) {
        session.messages.warning(unbalanced.to_string());
    }
    let count = keyed.len();
    let followed =
        session.document.history.amend(|design| keyed.into_iter().try_for_each(|keyed| keyed.apply(design).map(drop)));
    match followed {
        Ok(()) => session.messages.info(tn!(
            count,
            "{count} keyframe follows its pose",
            "{count} keyframes follow their poses"
        )),
        Err(error) => session.messages.warning(tf!("Keyframes do not follow their poses: {error}", error)),
    }
    let design = session.document.design().clone();
    session.following.settle(&design);
}

/// The document went back or forth: its keyframes went with it.
pub fn travelled(session: &mut Session) {
    let design = session.document.design().clone();
    session.following.settle(&design);
}
