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

/// Writes the design atomically, or not at all once `cancel` is raised.
pub fn save(path: &Path, design: &Design, cancel: &AtomicBool) -> Result<(), CommandError> {
    check_cancel(cancel)?;
    file::write(path, design).map_err(|e| match e {
        FileError::Read { path, source } | FileError::Write { path, source } => CommandError::write(&path, source),
        // Our own work does not validate: that is no fault of the input.
        FileError::Content { path, error } => CommandError::Failed(format!("{}: {error}", path.display())),
    })
}
