//! The errors of an export.

use crate::design::DesignError;
use crate::files::folder::FolderError;
use crate::motion::MotionError;
use thiserror::Error;

/// A design without a blueprint, or a blueprint without a folder.
#[derive(Debug, Error)]
pub enum ExportError {
    #[error("the design has no winch-tendon networks yet")]
    NoNetworks,
    #[error("all winches of the design are switched off")]
    AllOff,
    /// Their spools would overlap.
    #[error(
        "winches {one:?} and {other:?} are {distance_mm:.1} mm apart, and their spools need {least_mm:.1} mm: they would be in one hole"
    )]
    WinchesCollide { one: String, other: String, distance_mm: f64, least_mm: f64 },
    /// Whoever waited for it did not want it any more; nothing is written.
    #[error("stopped")]
    Stopped,
    #[error(transparent)]
    Invalid(#[from] DesignError),
    #[error(transparent)]
    Motion(#[from] MotionError),
    #[error(transparent)]
    Folder(#[from] FolderError),
}

impl ExportError {
    /// Whether the design or the folder asked for is at fault, not the machine.
    pub fn is_input(&self) -> bool {
        !matches!(self, Self::Folder(FolderError::Write { .. }))
    }
}
