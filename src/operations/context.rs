//! What an operation runs under.

use crate::rigging;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Takes what an operation says on its way, and tells it when to stop.
pub struct Context<'a> {
    progress: Option<&'a mut dyn FnMut(&Progress)>,
    cancel: &'a AtomicBool,
}

/// A step of an operation that takes long.
#[derive(Clone, Debug)]
pub enum Progress {
    Rig(rigging::Progress),
    /// Networks that were found so far, the best first.
    Proposals(Vec<Arc<rigging::Proposal>>),
    /// So many pictures of a film are drawn.
    Picture {
        done: usize,
        of: usize,
    },
    /// So many poses of keyframes are worked out.
    Keyed {
        done: usize,
        of: usize,
    },
    /// So many parts of a blueprint are made.
    Part {
        done: usize,
        of: usize,
    },
}

/// The operation was told to stop; nothing has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;

impl<'a> Context<'a> {
    /// Nobody listens on the way.
    pub fn new(cancel: &'a AtomicBool) -> Self {
        Self { progress: None, cancel }
    }

    /// `progress` hears of every step.
    pub fn telling(cancel: &'a AtomicBool, progress: &'a mut dyn FnMut(&Progress)) -> Self {
        Self { progress: Some(progress), cancel }
    }

    /// The flag that the solvers ask at every step.
    pub fn cancel(&self) -> &'a AtomicBool {
        self.cancel
    }

    /// Says that a step is done.
    pub fn tell(&mut self, step: &Progress) {
        if let Some(progress) = &mut self.progress {
            progress(step);
        }
    }

    /// Goes on, unless it was told to stop.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.cancel.load(Ordering::SeqCst) { Err(Cancelled) } else { Ok(()) }
    }
}
