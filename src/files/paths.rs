//! Folders, absolute paths, temporary names.

use super::sweep;
use etcetera::BaseStrategy;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The folder of a file.
pub fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// Where this platform keeps what the program remembers (settings, work that was not saved, logs, reports): `~/.local/state/plushwright` on
/// Linux, the application data on others. None where there is no home. It need not be there yet.
pub fn state_folder() -> Option<PathBuf> {
    let strategy = etcetera::choose_base_strategy().ok()?;
    Some(strategy.state_dir().unwrap_or_else(|| strategy.data_dir()).join("plushwright"))
}

/// The name itself is on the disk once its folder is. Not every system can flush a folder; the content is safe anyway.
pub(super) fn sync_folder(folder: &Path) {
    #[cfg(unix)]
    if let Ok(folder) = fs::File::open(folder) {
        let _ = folder.sync_all();
    }
    #[cfg(not(unix))]
    let _ = folder;
}

/// A file or folder that is still to be named, beside its place: `.plushwright-`, six letters, `.tmp`.
pub(super) fn temporary() -> tempfile::Builder<'static, 'static> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(sweep::PREFIX).suffix(sweep::SUFFIX);
    builder
}

/// An absolute path, so that a change of the working folder between two steps does no harm.
pub(super) fn absolute(path: &Path) -> io::Result<PathBuf> {
    std::path::absolute(path)
}
