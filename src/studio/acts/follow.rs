//! Keyframes of poses are worked out again where winches, body or targets have changed, as part of the step that changed them.

use crate::operations::key::{self, Error, Keyed, Note};
use crate::operations::{Context, Progress};
use crate::studio::jobs::{Outcome, Running};
use crate::studio::language::{mark, t, tf, tn};
use crate::studio::session::{Done, Session};
use crate::studio::words;

/// Once a frame.
pub fn follow(session: &mut Session, hands_off: bool) {
    let design = session.document.design().clone();
    if session.following.is_new() {
        return session.following.settle(&design);
    }
    if !hands_off
        || session.document.history.in_gesture()
        || session.following.is_at(&design)
        || session.following.is_stopped_at(&design)
    {
        return;
    }
    let Some(before) = session.following.before(&design) else { return };
    let poses = key::outdated(before, &design);
    if poses.is_empty() {
        return session.following.settle(&design);
    }
    session.following.cancel();
    let of = design.clone();
    let (done, wake) = (Done::default(), session.jobs.wake());
    session.following.done = done.clone();
    let running = session.jobs.start(mark("Keyframes of poses"), move |cancel| {
        let mut progress = |step: &Progress| {
            if let Progress::Keyed { done: now, of } = step {
                done.say(*now, *of);
            }
            wake();
        };
        Outcome::Followed(key::again(&design, &poses, &mut Context::telling(cancel, &mut progress)))
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
            "{count} keyframe was worked out again for its pose",
            "{count} keyframes were worked out again for their poses"
        )),
        Err(error) => session.messages.warning(tf!("Keyframes do not follow their poses: {error}", error)),
    }
    let design = session.document.design().clone();
    session.following.settle(&design);
}

/// Leaves the keyframes as they were.
pub fn stop(session: &mut Session) {
    session.following.stop();
    session.messages.warning(t(
        "Keyframes wind what they did before. They follow their poses with the next change, or with “Work out keyframes” among all commands",
    ));
}

/// The document went back or forth: its keyframes went with it.
pub fn travelled(session: &mut Session) {
    let design = session.document.design().clone();
    session.following.settle(&design);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{edit, testing};
    use crate::studio::canvas::Hit;
    use crate::studio::commands::{animation::FOLLOW, files::STOP};
    use crate::studio::services;
    use std::sync::Arc;

    #[test]
    fn keyframes_that_are_worked_out_can_be_stopped_and_go_on_later() {
        let mut session = Session::new(testing::sample(), None, Arc::new(|| ()), services());
        follow(&mut session, true);
        assert!(STOP.refused(&session, Hit::Nothing).is_some() && FOLLOW.refused(&session, Hit::Nothing).is_some());
        session.document.history.edit("Move target", |design| edit::move_target(design, 0, 0, [1.0, 3.0])).unwrap();
        follow(&mut session, true);
        assert!(session.working().is_some() && STOP.refused(&session, Hit::Nothing).is_none());
        (STOP.run)(&mut session, Hit::Nothing);
        // Nothing is worked out for this design any more, and the window says so.
        follow(&mut session, true);
        assert!(session.working().is_none() && session.messages.list().len() == 1);
        (FOLLOW.run)(&mut session, Hit::Nothing);
        follow(&mut session, true);
        assert!(session.following.is_running());
        // The next change begins anew by itself.
        (STOP.run)(&mut session, Hit::Nothing);
        session.document.history.edit("Move target", |design| edit::move_target(design, 0, 0, [2.0, 3.0])).unwrap();
        follow(&mut session, true);
        assert!(session.following.is_running());
    }
}
