//! A film of the animation, made on a thread.

use crate::files::shown;
use crate::operations::film::{self, Kind, Options};
use crate::operations::render::Error;
use crate::operations::{Context, Progress};
use crate::studio::jobs::{Outcome, Running};
use crate::studio::language::{mark, t, tf};
use crate::studio::session::{Dialog, Done, Session};
use std::path::{Path, PathBuf};

/// Begins to draw the animation.
pub fn start(session: &mut Session, path: PathBuf, options: Options) {
    let ending = match options.kind {
        Kind::Gif => "gif",
        Kind::Page => "html",
        Kind::Pictures => "",
    };
    let named = path.extension().is_some_and(|is| is.eq_ignore_ascii_case(ending));
    let path = if named || ending.is_empty() { path } else { path.with_extension(ending) };
    if let Err(why) = film::check(&path, options.kind) {
        return match &mut session.files.dialog {
            Some(Dialog::Path(dialog)) => dialog.trouble = Some(why),
            _ => session.messages.error(why),
        };
    }
    session.files.dialog = None;
    if session.filming.running.is_some() {
        return session.messages.info(t("A film is being made already: wait for it, or cancel it first."));
    }
    let design = session.acting().clone();
    let from = session.document.origin.clone().unwrap_or_default();
    let (done, wake) = (Done::default(), session.jobs.wake());
    session.filming.done = done.clone();
    session.filming.running = Some(session.jobs.start(mark("The film"), move |cancel| {
        let mut progress = |step: &Progress| {
            if let Progress::Picture { done: now, of } = step {
                done.say(*now, *of);
            }
            wake();
        };
        let filmed = film::run(&design, &from, &options, &mut Context::telling(cancel, &mut progress));
        let result = match filmed {
            Ok(filmed) => filmed.film.write(&path).map(|()| filmed.pictures),
            Err(Error::Cancelled(_)) => Err(t("it was cancelled").to_owned()),
            Err(error) => Err(error.to_string()),
        };
        Outcome::Filmed { path, result }
    }));
}

/// The film is written, or why not.
pub fn take(session: &mut Session, serial: u64, path: &Path, result: Result<usize, String>) {
    if !Running::is(session.filming.running.as_ref(), serial) {
        return;
    }
    session.filming.running = None;
    match result {
        Ok(pictures) => session.messages.info(tf!("{pictures} pictures are in {path}", pictures, path = shown(path))),
        Err(why) => session.messages.error(tf!("No film was written: {why}", why)),
    }
}
