//! What all studies share, and why one has no result.

use crate::mesh::MeshError;
use crate::physics::{Cause, ModelError};
use std::sync::atomic::AtomicBool;

/// Seed, stop flags and progress, shared by all studies.
pub struct Session<'a> {
    /// All random numbers follow from it.
    pub seed: u64,
    /// Asked between steps of work; `true` ends the study.
    pub stop: &'a dyn Fn() -> bool,
    /// `stop` for work that asks a flag.
    pub cancel: &'a AtomicBool,
    /// Told what is being worked on, in a few words.
    pub progress: &'a dyn Fn(&str),
    /// Told what was found on the way by a study of many minutes, in a line.
    pub found: &'a dyn Fn(&str),
}

/// Why a study has no result.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    #[error(
        "no shape is called `{name}`; there are {}, and {} with a number, such as hand-1",
        known.join(", "),
        made.join(", ")
    )]
    NoSuchShape { name: String, known: Vec<String>, made: Vec<String> },
    #[error("{shape}: {source}")]
    Mesh { shape: String, source: MeshError },
    #[error("{shape}: {source}")]
    Model { shape: String, source: ModelError },
    #[error("{shape} at {fibers} fibres: {source}")]
    Statics { shape: String, fibers: usize, source: Cause },
    #[error("{0}")]
    Nothing(String),
    #[error("the plot cannot be drawn: {0}")]
    Plot(String),
    #[error("cancelled")]
    Cancelled,
}

impl Session<'_> {
    /// Says what comes next, or ends the study.
    ///
    /// # Errors
    /// [`BenchError::Cancelled`].
    pub fn next(&self, what: &str) -> Result<(), BenchError> {
        self.check()?;
        (self.progress)(what);
        Ok(())
    }

    /// Ends the study if that was asked for.
    ///
    /// # Errors
    /// [`BenchError::Cancelled`].
    pub fn check(&self) -> Result<(), BenchError> {
        if (self.stop)() { Err(BenchError::Cancelled) } else { Ok(()) }
    }
}
