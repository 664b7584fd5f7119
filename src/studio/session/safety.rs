//! What the window keeps beyond its life: work, settings, claims on files.

use crate::files::Stamp;
use crate::studio::keeper::{Abandoned, Keeper};
use crate::studio::store::{Settings, Store};
use std::fs::File;
use std::path::Path;
use std::time::Duration;

/// Without a [`Store`] (in tests) nothing is kept beyond the window's life.
#[derive(Default)]
pub struct Safety {
    pub(in crate::studio) store: Option<Store>,
    pub(in crate::studio) keeper: Option<Keeper>,
    /// Says to other windows that the file is open here.
    pub(in crate::studio) claim: Option<File>,
    /// What the document's file held when it was read or written last.
    pub(in crate::studio) seen: Option<Stamp>,
    /// What is still to be offered, the newest last.
    pub(in crate::studio) abandoned: Vec<Abandoned>,
    pub(in crate::studio) settings: Settings,
    /// The next look at the work that is kept is due after this long.
    pub(in crate::studio) due: Option<Duration>,
}

impl Safety {
    /// Of a document whose file held that when it was read.
    pub(in crate::studio) fn seen(seen: Option<Stamp>) -> Self {
        Self { seen, ..Self::default() }
    }

    /// Where the window keeps its work.
    pub(in crate::studio) fn folder(&self) -> Option<&Path> {
        self.keeper.as_ref().map(Keeper::folder)
    }

    /// The document has no file.
    pub(in crate::studio) fn unclaim(&mut self) {
        self.claim = None;
        self.seen = None;
    }
}
