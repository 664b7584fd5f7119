//! Work that takes too long for a frame, each on a thread that reports back once.

use super::files::ImportChoice;
use super::keeping::Kept;
use crate::design::reshape::Body;
use crate::design::{Design, FiberSet};
use crate::mesh::Mesh;
use crate::outline::Changes;
use crate::picture::Texture;
use crate::rigging::Proposal;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

/// What a job came to.
pub enum Report {
    Proposed {
        serial: u64,
        proposals: Vec<Proposal>,
    },
    /// The desktop's dialog was answered; `at_once` if faster than any human.
    Picked {
        path: Option<PathBuf>,
        at_once: bool,
    },
    Meshed {
        serial: u64,
        made: Result<Box<Made>, String>,
    },
    Textured {
        path: PathBuf,
        texture: Result<Arc<Texture>, String>,
    },
    /// With what was changed to get a clean outline.
    Imported(Result<Box<New>, Box<Refused>>),
    Exported {
        folder: PathBuf,
        result: Result<(), String>,
    },
    /// The job itself broke.
    Broken {
        job: &'static str,
        why: String,
    },
}

/// A design made of an outline.
pub struct New {
    pub design: Design,
    pub changes: Changes,
    /// Its picture, where that is its texture.
    pub texture: Option<Kept>,
}

/// An outline that makes no design, as it was asked for.
pub struct Refused {
    pub path: PathBuf,
    pub choice: ImportChoice,
    pub why: String,
}

/// What was meshed.
pub enum Made {
    /// Another resolution.
    Mesh(Mesh, FiberSet),
    /// Another silhouette, and what was changed to get it.
    Body(Body, Changes),
}

pub type Wake = Arc<dyn Fn() + Send + Sync>;

pub struct Jobs {
    send: Sender<Report>,
    receive: Receiver<Report>,
    wake: Wake,
}

impl Jobs {
    pub fn new(wake: Wake) -> Self {
        let (send, receive) = channel();
        Self { send, receive, wake }
    }

    /// Runs `work` on a thread of its own. `job` names it should it break.
    pub fn start(&self, job: &'static str, work: impl FnOnce() -> Report + Send + 'static) {
        let (send, wake) = (self.send.clone(), self.wake.clone());
        std::thread::spawn(move || {
            let report = catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| {
                let text = panic.downcast_ref::<&str>().map(|s| (*s).to_owned());
                let why = text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default();
                Report::Broken { job, why }
            });
            // Nobody listens any more when the window is closed.
            let _ = send.send(report);
            wake();
        });
    }

    /// What wakes the window up.
    pub fn wake(&self) -> Wake {
        self.wake.clone()
    }

    pub fn next(&self) -> Option<Report> {
        self.receive.try_recv().ok()
    }
}
