//! The errors of an export.

use crate::design::DesignError;
use crate::files::folder::FolderError;
use crate::files::shown;
use crate::motion::MotionError;
use std::io;
use std::path::PathBuf;
use thiserror::Error;

/// A design without a blueprint, or a blueprint without a folder.
#[derive(Debug, Error)]
pub enum ExportError {
    #[error("the design has no winch-tendon networks yet")]
    NoNetworks,
    #[error(transparent)]
    Invalid(#[from] DesignError),
    #[error(transparent)]
    Motion(#[from] MotionError),
    #[error("{} exists and is not an earlier export ({found:?} is in it): choose another folder", shown(path))]
    NotOurs { path: PathBuf, found: String },
    #[error("{} exists and {name:?} in it was changed by hand: choose another folder", shown(path))]
    Changed { path: PathBuf, name: String },
    #[error("cannot write {}: {source}", shown(path))]
    Write { path: PathBuf, source: io::Error },
}

impl ExportError {
    /// Whether the design or the folder asked for is at fault, not the machine.
    pub fn is_input(&self) -> bool {
        !matches!(self, Self::Write { .. })
    }
}

impl From<FolderError> for ExportError {
    fn from(error: FolderError) -> Self {
        match error {
            FolderError::NotOurs { path, found } => Self::NotOurs { path, found },
            FolderError::Changed { path, name } => Self::Changed { path, name },
            FolderError::Write { path, source } => Self::Write { path, source },
        }
    }
}
