//! That nothing is lost: work that is kept until it is saved, files that others change, what a window remembers.

use super::replace;
use crate::files::shown;
use crate::outline::Drawing;
use crate::picture::layers::look;
use crate::picture::palette::Theme;
use crate::studio::canvas::Plushie;
use crate::studio::keeper::{Abandoned, Keeper, Kept, Revision, Sources, Work};
use crate::studio::language::{self, Language, tf};
use crate::studio::session::{Dialog, Session, Views};
use crate::studio::store::{Scribe, Settings, Store};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Raised when the system asks the program to end: at the end of a session, by a signal.
pub static ENDING: AtomicBool = AtomicBool::new(false);

/// From now on work is kept in a state folder; what was left there is offered.
pub fn keep_in(session: &mut Session, store: Store) {
    session.safety.settings = store.settings();
    take_settings(session);
    language::speak(session.look.language.language());
    let (abandoned, unreadable) = Abandoned::find(&store);
    for path in unreadable {
        session
            .messages
            .warning(tf!("Work that was not saved cannot be read; it stays in {path}", path = shown(&path)));
    }
    session.safety.keeper = Keeper::new(&store)
        .inspect_err(|error| session.messages.warning(tf!("Work that is not saved cannot be kept: {error}", error)))
        .ok();
    session.safety.scribe = Some(Scribe::new(store.clone(), session.safety.settings.clone()));
    session.safety.store = Some(store);
    session.safety.abandoned = abandoned;
    if let Some(path) = session.document.path.clone() {
        opened(session, &path);
    }
    if !session.safety.abandoned.is_empty() {
        session.files.dialog = Some(Dialog::Recover);
    }
}

/// The document has that file now.
pub fn opened(session: &mut Session, path: &Path) {
    session.safety.claim = None;
    let Some(store) = &session.safety.store else { return };
    match store.claim(path) {
        Ok(Some(claim)) => session.safety.claim = Some(claim),
        Ok(None) => session.messages.warning(tf!(
            "{path} is open in another window too. Whoever saves second is asked before the other’s work is replaced.",
            path = shown(path)
        )),
        // It is a help; without it the file is watched all the same.
        Err(_) => {}
    }
    session.safety.settings.opened(path);
    remember(session);
}

/// Once a frame: keeps what is not saved. `drawing`: with what is only being drawn.
pub fn keep(session: &mut Session, drawing: Option<Drawing>) {
    if session.safety.keeper.is_none() {
        return;
    }
    let work = work(session, drawing);
    let Some(keeper) = &mut session.safety.keeper else { return };
    let wake = session.jobs.wake();
    session.safety.due = None;
    match keeper.follow(work, move || wake()) {
        Kept::All => {}
        Kept::Due(after) => session.safety.due = Some(after),
        Kept::Failed(why) => {
            session.messages.warning(tf!("Work that is not saved cannot be kept: {why}. Save it soon.", why))
        }
    }
}

/// The system ends the program: what is not saved is kept for the next start.
pub fn end(session: &mut Session, drawing: Option<Drawing>) {
    if let (Some(work), Some(mut keeper)) = (work(session, drawing), session.safety.keeper.take()) {
        // There is nobody left to be told.
        let _ = keeper.keep_now(&work);
    }
    session.files.quit = true;
}

/// The window closes, and nothing is left to be kept.
pub fn quit(session: &mut Session) {
    remember(session);
    if let Some(keeper) = session.safety.keeper.take() {
        keeper.end();
    }
    session.files.quit = true;
}

/// What is to be kept now, put together where something of it has changed.
fn work(session: &mut Session, drawing: Option<Drawing>) -> Option<Arc<Work>> {
    let document = &session.document;
    let sources = Sources {
        design: document.design(),
        drawing: drawing.as_ref(),
        path: document.path.as_deref(),
        origin: document.origin.as_deref(),
        seen: session.safety.seen,
        is_modified: document.is_modified(),
    };
    if !session.safety.revision.as_ref().is_some_and(|known| known.is_of(&sources)) {
        session.safety.revision = Some(Revision::of(&sources));
    }
    session.safety.revision.as_ref().and_then(Revision::work)
}

/// Opens the work that is offered; it counts as not saved.
pub fn recover(session: &mut Session) {
    session.files.dialog = None;
    let Some(abandoned) = session.safety.abandoned.pop() else { return };
    // There may be none: its folder could not be made.
    if let Some(own) = session.safety.keeper.take() {
        own.end();
    }
    let folder = abandoned.folder().to_owned();
    let (keeper, design, facts) = Keeper::adopt(abandoned);
    let (design, origin) = Abandoned::homed(design, &facts, &folder);
    replace::open(session, design, None);
    session.safety.keeper = Some(keeper);
    session.document.origin = Some(origin);
    session.document.path = facts.path;
    session.safety.seen = facts.seen;
    if let Some(path) = session.document.path.clone() {
        opened(session, &path);
    }
    session.document.mark_unsaved();
    if !session.safety.abandoned.is_empty() {
        let others = session.safety.abandoned.len();
        session.messages.info(tf!("{others} more that were not saved are offered at the next start.", others));
    }
    // Nobody holds them any more, so that the next window finds them.
    session.safety.abandoned.clear();
}

/// Drops the work that is offered, and offers the next.
pub fn discard_work(session: &mut Session) {
    if let Some(abandoned) = session.safety.abandoned.pop() {
        abandoned.discard();
    }
    if session.safety.abandoned.is_empty() {
        session.files.dialog = None;
    }
}

/// Leaves the work where it is.
pub fn recover_later(session: &mut Session) {
    session.safety.abandoned.clear();
    session.files.dialog = None;
}

/// The size of the window, for the next one.
pub fn sized(session: &mut Session, size: [f32; 2]) {
    session.safety.settings.window = Some(size);
}

/// Writes down how the window is set, where that has changed.
pub fn remember(session: &mut Session) {
    let Some(scribe) = &mut session.safety.scribe else { return };
    let now = &session.look;
    let settings = Settings {
        dark: Some(now.theme == Theme::Dark),
        language: now.language.chosen.map(|language| language.code.to_owned()),
        quality: Some(format!("{:?}", session.solver.quality)),
        idealized: Some(now.views.shows(Plushie::Idealized)),
        realizable: Some(now.views.shows(Plushie::Realizable)),
        layers: now.shown.clone(),
        look: Some(now.body.to_owned()),
        overlaid: Some(now.views == Views::Overlay),
        side_by_side: !now.stacks,
        cameras_apart: Some(!now.linked),
        rulers: Some(now.rulers),
        onion_skins: Some(now.onion.on),
        still: now.still,
        snaps: Some(session.posing.snaps),
        drives: session.timing.drives,
        looping: Some(session.playback.looping),
        guided: Some(session.guided),
        ..session.safety.settings.clone()
    };
    scribe.remember(settings);
}

fn take_settings(session: &mut Session) {
    let settings = &session.safety.settings;
    session.look.theme = settings.theme().unwrap_or(session.look.theme);
    session.look.language.chosen = settings.language.as_deref().and_then(Language::of);
    session.look.shown = settings.layers.clone();
    session.look.views = settings.views();
    session.look.body = settings.look.as_deref().and_then(look).map_or(session.look.body, |look| look.name);
    session.look.stacks = !settings.side_by_side;
    session.look.linked = settings.cameras_apart != Some(true);
    session.look.rulers = settings.rulers == Some(true);
    session.look.onion.on = settings.onion_skins == Some(true);
    session.look.still = settings.still;
    session.posing.snaps = settings.snaps.unwrap_or(session.posing.snaps);
    session.timing.drives = settings.drives;
    session.playback.looping = settings.looping.unwrap_or(session.playback.looping);
    session.guided = settings.guided.unwrap_or(session.guided);
    session.solver.quality = settings.quality().unwrap_or(session.solver.quality);
}

/// Whether the system has asked the program to end.
pub fn is_ending() -> bool {
    ENDING.load(Ordering::SeqCst)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::Design;
    use crate::studio::blank;

    #[test]
    fn work_is_recovered_where_the_window_has_no_folder_of_its_own() {
        let folder = tempfile::tempdir().unwrap();
        let store = Store::at(folder.path());
        let design = Arc::new(Design { name: "lost".into(), ..blank::design() });
        let sources =
            Sources { design: &design, drawing: None, path: None, origin: None, seen: None, is_modified: true };
        let work = Revision::of(&sources).work().unwrap();
        Keeper::new(&store).unwrap().keep_now(&work).unwrap();
        let mut session = Session::new(blank::design(), None, Arc::new(|| ()), crate::studio::services());
        session.safety.abandoned = Abandoned::find(&store).0;
        assert!(session.safety.keeper.is_none());
        recover(&mut session);
        assert_eq!(session.design().name, "lost");
        assert!(session.document.is_modified() && session.safety.keeper.is_some());
    }
}
