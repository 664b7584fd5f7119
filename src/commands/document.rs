//! Reading and writing the design file.

use super::error::{CommandError, check_cancel};
use crate::design::Design;
use crate::design::file::{self, FileError};
use std::path::Path;
use std::sync::atomic::AtomicBool;

pub fn load(path: &Path) -> Result<Design, CommandError> {
    file::read(path).map_err(|e| match e {
        FileError::Read { path, source } => CommandError::input(&path, source),
        FileError::Write { path, source } => CommandError::write(&path, source),
        FileError::Content { path, error } => CommandError::input(&path, error),
    })
}

/// [`save`] of a design that was read from `from`: what it finds relative to its own folder stays the same file.
pub fn save_as(from: &Path, to: &Path, design: &Design, cancel: &AtomicBool) -> Result<(), CommandError> {
    match file::seen_from(design, from, to) {
        Some(design) => save(to, &design, cancel),
        None => save(to, design, cancel),
    }
}

/// Writes the design atomically, or not at all once `cancel` is raised.
pub fn save(path: &Path, design: &Design, cancel: &AtomicBool) -> Result<(), CommandError> {
    check_cancel(cancel)?;
    file::write(path, design).map_err(|e| match e {
        FileError::Read { path, source } | FileError::Write { path, source } => CommandError::write(&path, source),
        // Our own work does not validate: that is no fault of the input.
        FileError::Content { path, error } => CommandError::Failed(format!("{}: {error}", path.display())),
    })
}
