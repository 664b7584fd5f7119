//! Networks for all poses at once, looked for on a thread.

use crate::operations::rig::{self, Error, Rigged};
use crate::operations::{Context, Progress};
use crate::studio::jobs::{Outcome, Running};
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
        Err(error) => return session.messages.warning(format!("Tendons of each winch: {error}")),
    };
    let design = session.design().clone();
    let (step, wake) = (Arc::new(Mutex::new(String::new())), session.jobs.wake());
    session.rigging.step = step.clone();
    session.rigging.running = Some(session.jobs.start("Rigging", move |cancel| {
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

/// The search is over.
pub fn take_rig(session: &mut Session, serial: u64, rigged: Result<Box<Rigged>, Error>) {
    if !Running::is(session.rigging.running.as_ref(), serial) {
        return;
    }
    session.rigging.running = None;
    let rigged = match rigged {
        Ok(rigged) => rigged,
        Err(error) => return session.messages.warning(words::unrigged(&error)),
    };
    if rigged.is_stale(session.design()) {
        let text = "The body or its networks were changed meanwhile, so what was found does not fit any more.";
        return session.messages.warning(text);
    }
    for note in &rigged.notes {
        session.messages.warning(format!("Rig: {note}"));
    }
    let found = rigged.networks.len();
    match session.document.history.edit("Rig", |design| rigged.apply(design)) {
        Ok(()) => session.messages.info(format!("{found} winch{} found.", if found == 1 { "" } else { "es" })),
        Err(error) => session.messages.error(words::unrigged(&error.into())),
    }
}
