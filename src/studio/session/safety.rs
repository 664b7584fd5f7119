//! What the window keeps beyond its life: work, settings, claims on files.

use crate::files::Stamp;
use crate::studio::keeper::{Abandoned, Keeper, Revision};
use crate::studio::store::{Scribe, Settings, Store};
use std::fs::File;
use std::path::Path;
use std::time::Duration;

/// Without a [`Store`] (in tests) nothing is kept beyond the window's life.
#[derive(Default)]
pub struct Safety {
    pub(crate) store: Option<Store>,
    pub(crate) keeper: Option<Keeper>,
    /// The work that is to be kept.
    pub(crate) revision: Option<Revision>,
    /// Says to other windows that the file is open here.
    pub(crate) claim: Option<File>,
    /// The content of the document's file when it was read or written last.
    pub(crate) seen: Option<Stamp>,
    /// Work that is still to be offered, the newest last.
    pub(crate) abandoned: Vec<Abandoned>,
    pub(crate) settings: Settings,
    pub(crate) scribe: Option<Scribe>,
    /// The next look at the work that is kept is due after this long.
    pub(crate) due: Option<Duration>,
}

impl Safety {
    /// Of a document whose file held that when it was read.
    pub(crate) fn seen(seen: Option<Stamp>) -> Self {
        Self { seen, ..Self::default() }
    }

    /// Where the window keeps its work.
    pub(crate) fn folder(&self) -> Option<&Path> {
        self.keeper.as_ref().map(Keeper::folder)
    }

    /// The document has no file.
    pub(crate) fn unclaim(&mut self) {
        self.claim = None;
        self.seen = None;
    }
}
