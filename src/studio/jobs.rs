//! Work that takes too long for a frame, each on a thread that reports back once.

use super::keeping::Kept;
use super::language;
use super::session::{ImportChoice, Judgement};
use crate::design::Design;
use crate::operations::explore::Point;
use crate::operations::key::{self, Keyed};
use crate::operations::new_design::Note;
use crate::operations::preview::Previewed;
use crate::operations::remesh::{self, Remeshed};
use crate::operations::reshape::{self, Reshaped};
use crate::operations::rig::{self, Rigged};
use crate::outline::{Changes, Import};
use crate::picture::Texture;
use crate::rigging::Proposal;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::time::Instant;

/// A job that is over.
pub struct Finished {
    /// Which one: that of its [`Running`].
    pub serial: u64,
    pub outcome: Outcome,
}

/// The result of a job of a panel; the panel alone knows what it is.
pub type Told = Arc<dyn Any + Send + Sync>;

/// The result of a job.
pub enum Outcome {
    Proposed(Vec<Arc<Proposal>>),
    Remeshed(Result<Box<Remeshed>, remesh::Error>),
    Reshaped(Result<Box<Reshaped>, reshape::Error>),
    Rigged(Result<Box<Rigged>, rig::Error>),
    Explored(Result<Vec<Arc<Point>>, rig::Error>),
    Keyed(Result<Keyed, key::Error>),
    Followed(Result<Vec<Keyed>, key::Error>),
    /// The first keyframes of an animation.
    Begun(Result<Vec<Keyed>, key::Error>),
    Judged(Box<Judgement>),
    Imported(Result<Box<New>, Box<Refused>>),
    /// What would be read of an outline.
    Previewed {
        path: PathBuf,
        import: Box<Import>,
        result: Result<Box<Previewed>, String>,
    },
    Exported {
        folder: PathBuf,
        /// Its remarks.
        result: Result<Vec<String>, String>,
    },
    Filmed {
        path: PathBuf,
        /// How many pictures.
        result: Result<usize, String>,
    },
    Textured {
        path: PathBuf,
        texture: Result<Arc<Texture>, String>,
    },
    /// The desktop's dialog was answered; `at_once` if faster than any human.
    Picked {
        path: Option<PathBuf>,
        at_once: bool,
    },
    /// A job of a panel.
    Told {
        owner: &'static str,
        told: Told,
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
    pub notes: Vec<Note>,
    /// Its picture, where that is its texture.
    pub texture: Option<Kept>,
}

/// An outline that makes no design, as it was asked for.
pub struct Refused {
    pub path: PathBuf,
    pub choice: ImportChoice,
    pub why: String,
}

/// A job that somebody waits for. What another one reports in its place is not wanted.
pub struct Running {
    pub serial: u64,
    pub started: Instant,
    cancel: Arc<AtomicBool>,
}

impl Running {
    /// Tells the job to stop; whatever it still reports is not wanted.
    pub fn cancel(&self) {
        self.stop();
    }

    /// Tells the job to end with what it has.
    pub fn stop(&self) {
        self.cancel.store(true, Ordering::SeqCst);
    }

    /// Whether a report is that of this job.
    pub fn is(running: Option<&Self>, serial: u64) -> bool {
        running.is_some_and(|running| running.serial == serial)
    }
}

/// Stops a job, and waits for it no more.
pub fn cancel(running: &mut Option<Running>) {
    if let Some(running) = running.take() {
        running.cancel();
    }
}

pub type Wake = Arc<dyn Fn() + Send + Sync>;

pub struct Jobs {
    send: Sender<Finished>,
    receive: Receiver<Finished>,
    wake: Wake,
    /// Of the newest job.
    serial: u64,
}

impl Jobs {
    pub fn new(wake: Wake) -> Self {
        let (send, receive) = channel();
        Self { send, receive, wake, serial: 0 }
    }

    /// Runs `work` on a thread of its own; it is given what tells it to stop. `job` names it should it break.
    pub fn start(&mut self, job: &'static str, work: impl FnOnce(&AtomicBool) -> Outcome + Send + 'static) -> Running {
        self.serial += 1;
        let (send, wake, serial) = (self.send.clone(), self.wake.clone(), self.serial);
        let cancel = Arc::new(AtomicBool::new(false));
        let running = Running { serial, started: Instant::now(), cancel: cancel.clone() };
        let language = language::spoken();
        std::thread::spawn(move || {
            language::speak(language);
            let outcome = catch_unwind(AssertUnwindSafe(|| work(&cancel))).unwrap_or_else(|panic| {
                let text = panic.downcast_ref::<&str>().map(|s| (*s).to_owned());
                let why = text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default();
                Outcome::Broken { job, why }
            });
            // Nobody listens any more when the window is closed.
            let _ = send.send(Finished { serial, outcome });
            wake();
        });
        running
    }

    /// The function that wakes the window up.
    pub fn wake(&self) -> Wake {
        self.wake.clone()
    }

    pub fn next(&self) -> Option<Finished> {
        self.receive.try_recv().ok()
    }
}
