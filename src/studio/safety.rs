//! That nothing is lost: work that is kept until it is saved, files that others change, what a window remembers.

use super::canvas::Plushie;
use super::files::Dialog;
use super::keeper::{Abandoned, Facts, Keeper, Kept, Work};
use super::session::Session;
use super::store::{Settings, Store};
use crate::files::{Hold, Stamp, shown};
use crate::outline::Drawing;
use crate::picture::palette::Theme;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// Raised when the system asks the program to end: at the end of a session, by a signal.
pub static ENDING: AtomicBool = AtomicBool::new(false);
/// How long saving waits for another process that writes the same file.
const PATIENCE: Duration = Duration::from_millis(500);

/// Without a [`Store`] (in tests) nothing is kept beyond the window's life.
#[derive(Default)]
pub struct Safety {
    store: Option<Store>,
    keeper: Option<Keeper>,
    /// Says to other windows that the file is open here.
    claim: Option<File>,
    /// What the document's file held when it was read or written last.
    pub(super) seen: Option<Stamp>,
    /// What is still to be offered, the newest last.
    pub(super) abandoned: Vec<Abandoned>,
    settings: Settings,
    /// The next look at the work that is kept is due after this long.
    pub(super) due: Option<Duration>,
}

impl Safety {
    /// Of a document whose file held that when it was read.
    pub(super) fn seen(seen: Option<Stamp>) -> Self {
        Self { seen, ..Self::default() }
    }

    /// Where the window keeps its work.
    pub(super) fn folder(&self) -> Option<&Path> {
        self.keeper.as_ref().map(Keeper::folder)
    }
}

impl Session {
    /// From now on work is kept in a state folder; what was left there is offered.
    pub fn keep_in(&mut self, store: Store) {
        let (abandoned, unreadable) = Abandoned::find(&store);
        for path in unreadable {
            self.messages.warning(format!("Work that was not saved cannot be read; it stays in {}", shown(&path)));
        }
        self.safety.keeper = Keeper::new(&store)
            .inspect_err(|error| self.messages.warning(format!("Work that is not saved cannot be kept: {error}")))
            .ok();
        self.safety.settings = store.settings();
        self.safety.store = Some(store);
        self.safety.abandoned = abandoned;
        self.take_settings();
        if let Some(path) = self.path.clone() {
            self.opened(&path);
        }
        if !self.safety.abandoned.is_empty() {
            self.files.dialog = Some(Dialog::Recover);
        }
    }

    /// Files that were opened or saved lately, the newest first.
    pub fn recent(&self) -> &[PathBuf] {
        &self.safety.settings.recent
    }

    /// The work that is offered now.
    pub fn offered(&self) -> Option<&Abandoned> {
        self.safety.abandoned.last()
    }

    /// The document has that file now.
    pub(super) fn opened(&mut self, path: &Path) {
        self.safety.claim = None;
        let Some(store) = &self.safety.store else { return };
        match store.claim(path) {
            Ok(Some(claim)) => self.safety.claim = Some(claim),
            Ok(None) => self.messages.warning(format!(
                "{} is open in another window too. Whoever saves second is asked before the other’s work is replaced.",
                shown(path)
            )),
            // It is a help; without it the file is watched all the same.
            Err(_) => {}
        }
        self.safety.settings.opened(path);
        self.remember();
    }

    /// The document has no file.
    pub(super) fn unclaimed(&mut self) {
        self.safety.claim = None;
        self.safety.seen = None;
    }

    /// Once a frame: keeps what is not saved. `drawing`: with what is only being drawn.
    pub fn keep(&mut self, drawing: Option<Drawing>) {
        let work = self.work(drawing);
        let Some(keeper) = &mut self.safety.keeper else { return };
        let wake = self.jobs.wake();
        self.safety.due = None;
        match keeper.follow(work, move || wake()) {
            Kept::All => {}
            Kept::Due(after) => self.safety.due = Some(after),
            Kept::Failed(why) => {
                self.messages.warning(format!("Work that is not saved cannot be kept: {why}. Save it soon."))
            }
        }
    }

    /// The system ends the program: what is not saved is kept for the next start.
    pub fn end(&mut self, drawing: Option<Drawing>) {
        if let (Some(work), Some(keeper)) = (self.work(drawing), &mut self.safety.keeper) {
            // There is nobody left to be told.
            let _ = keeper.keep_now(&work);
            self.safety.keeper = None;
        }
        self.files.quit = true;
    }

    /// The window closes, and nothing is left to be kept.
    pub(super) fn quit(&mut self) {
        self.remember();
        if let Some(keeper) = self.safety.keeper.take() {
            keeper.end();
        }
        self.files.quit = true;
    }

    fn work(&self, drawing: Option<Drawing>) -> Option<Work> {
        if !self.history.is_modified() && drawing.is_none() {
            return None;
        }
        let facts = Facts {
            path: self.path.clone().and_then(|path| std::path::absolute(path).ok()),
            origin: self.origin.clone().and_then(|path| std::path::absolute(path).ok()),
            texture: self.design().texture.clone(),
            seen: self.safety.seen,
        };
        Some(Work { design: self.design().clone(), drawing, facts })
    }

    /// Opens the work that is offered; it counts as not saved.
    pub(super) fn recover(&mut self) {
        self.files.dialog = None;
        let (Some(abandoned), Some(keeper)) = (self.safety.abandoned.pop(), self.safety.keeper.take()) else { return };
        let folder = abandoned.folder().to_owned();
        let (keeper, design, facts) = keeper.adopt(abandoned);
        let (design, origin) = Abandoned::homed(design, &facts, &folder);
        self.open(design, None);
        self.safety.keeper = Some(keeper);
        self.origin = Some(origin);
        self.path = facts.path;
        self.safety.seen = facts.seen;
        if let Some(path) = self.path.clone() {
            self.opened(&path);
        }
        self.history.mark_unsaved();
        if !self.safety.abandoned.is_empty() {
            let others = self.safety.abandoned.len();
            self.messages.info(format!("{others} more that were not saved are offered at the next start."));
        }
        // Nobody holds them any more, so that the next window finds them.
        self.safety.abandoned.clear();
    }

    /// Drops the work that is offered, and offers the next.
    pub(super) fn discard_work(&mut self) {
        if let Some(abandoned) = self.safety.abandoned.pop() {
            abandoned.discard();
        }
        if self.safety.abandoned.is_empty() {
            self.files.dialog = None;
        }
    }

    /// Leaves the work where it is.
    pub(super) fn recover_later(&mut self) {
        self.safety.abandoned.clear();
        self.files.dialog = None;
    }

    /// Keeps other processes off a file that is about to be saved.
    pub(super) fn hold(path: &Path) -> std::io::Result<Option<Hold>> {
        if !path.is_file() {
            return Ok(None);
        }
        Hold::of(path, |waited| waited < PATIENCE).map(Some)
    }

    /// The size of the window, for the next one.
    pub fn sized(&mut self, size: [f32; 2]) {
        self.safety.settings.window = Some(size);
    }

    /// Writes down how the window is set, where that has changed.
    pub(super) fn remember(&mut self) {
        let Some(store) = &self.safety.store else { return };
        let look = &self.look;
        let settings = Settings {
            dark: Some(look.theme == Theme::Dark),
            quality: Some(format!("{:?}", self.quality)),
            idealized: Some(look.views.shows(Plushie::Idealized)),
            realizable: Some(look.views.shows(Plushie::Realizable)),
            layers: look.shown.clone(),
            ..self.safety.settings.clone()
        };
        if settings != store.settings() && store.remember(&settings).is_ok() {
            self.safety.settings = settings;
        }
    }

    fn take_settings(&mut self) {
        let settings = &self.safety.settings;
        self.look.theme = settings.theme().unwrap_or(self.look.theme);
        self.look.shown = settings.layers.clone();
        self.look.views = settings.views();
        self.quality = settings.quality().unwrap_or(self.quality);
    }
}

/// Whether the system has asked the program to end.
pub fn is_ending() -> bool {
    ENDING.load(Ordering::SeqCst)
}
