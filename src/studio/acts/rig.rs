//! Networks for all poses at once, looked for on a thread.

use crate::operations::explore::{self, Point};
use crate::operations::rig::{self, Error, Options, Rigged};
use crate::operations::{Context, Progress};
use crate::rigging::RigError;
use crate::studio::jobs::{Outcome, Running};
use crate::studio::language::{mark, t, tf, tn};
use crate::studio::session::Session;
use crate::studio::words;
use std::sync::{Arc, Mutex};

/// Begins to look.
pub fn start_rig(session: &mut Session) {
    if session.rigging.running.is_some() {
        return;
    }
    let options = match session.rigging.choice.options(&session.discovery.options.parameters) {
        Ok(options) => options,
        Err(error) => return session.messages.warning(tf!("Tendons of each winch: {error}", error)),
    };
    let design = session.design().clone();
    let (step, wake) = (Arc::new(Mutex::new(String::new())), session.jobs.wake());
    session.rigging.step = step.clone();
    session.rigging.ending = false;
    session.rigging.running = Some(session.jobs.start(mark("Rigging"), move |cancel| {
        let mut progress = |done: &Progress| {
            if let Ok(mut step) = step.lock() {
                *step = words::progress(done);
            }
            wake();
        };
        let mut context = Context::telling(cancel, &mut progress);
        Outcome::Rigged(rig::prepare(&design, &options, &mut context).map(Box::new))
    }));
}

/// Begins to look for rigs with more and more winches and tendons.
pub fn start_curve(session: &mut Session) {
    if session.cannot_rig().is_some() {
        return;
    }
    let options = match session.rigging.choice.options(&session.discovery.options.parameters) {
        // Rigs that are not finished cannot be compared.
        Ok(options) => Options { keep: false, ..options },
        Err(error) => return session.messages.warning(tf!("Tendons of each winch: {error}", error)),
    };
    let design = session.design().clone();
    session.rigging.curve.begin(&design);
    let (coming, wake) = (session.rigging.curve.coming.clone(), session.jobs.wake());
    session.rigging.curve.running = Some(session.jobs.start(mark("The curve of winches"), move |cancel| {
        let mut found = |list: &[Arc<Point>]| {
            if let Ok(mut coming) = coming.lock() {
                *coming = Some(list.to_vec());
            }
            wake();
        };
        Outcome::Explored(explore::run(&design, &options, &mut found, &mut Context::new(cancel)))
    }));
}

/// The curve is there.
pub fn take_curve(session: &mut Session, serial: u64, points: Result<Vec<Arc<Point>>, Error>) {
    if !Running::is(session.rigging.curve.running.as_ref(), serial) {
        return;
    }
    session.rigging.curve.running = None;
    match points {
        Ok(points) => session.rigging.curve.points = points,
        Err(error) => session.messages.warning(words::unrigged(&error)),
    }
}

/// Puts a rig of the curve into the design that it was found for.
pub fn take_point(session: &mut Session, index: usize) {
    let curve = &session.rigging.curve;
    let Some(point) = curve.points.get(index).filter(|_| !curve.stale).cloned() else { return };
    put(session, point.rigged.clone());
}

/// The search is over.
pub fn take_rig(session: &mut Session, serial: u64, rigged: Result<Box<Rigged>, Error>) {
    if !Running::is(session.rigging.running.as_ref(), serial) {
        return;
    }
    session.rigging.running = None;
    let rigged = match rigged {
        Ok(rigged) => *rigged,
        Err(Error::Cancelled(_) | Error::Rig(RigError::NothingFound)) if session.rigging.ending => {
            return session.messages.warning(t("Nothing was found yet that helps: let it look for longer."));
        }
        Err(error) => return session.messages.warning(words::unrigged(&error)),
    };
    put(session, rigged);
}

/// Puts a rig into the design, where that is still the one that it was found for.
fn put(session: &mut Session, rigged: Rigged) {
    if rigged.is_stale(session.design()) {
        let text = t("The body or its networks were changed meanwhile, so what was found does not fit any more.");
        return session.messages.warning(text);
    }
    for note in &rigged.notes {
        session.messages.warning(tf!("Rig: {note}", note));
    }
    let (found, interrupted) = (rigged.networks.len(), rigged.interrupted);
    match session.document.history.edit(mark("Rig"), |design| rigged.apply(design)) {
        Ok(()) if interrupted => session.messages.info(t("The best winches and tendons so far were built in.")),
        Ok(()) => session.messages.info(tn!(found, "{found} winch found.", "{found} winches found.")),
        Err(error) => session.messages.error(words::unrigged(&error.into())),
    }
}
