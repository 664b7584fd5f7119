//! Folders, absolute paths, temporary names.

use super::sweep;
use std::io;
use std::path::{Path, PathBuf};

/// The folder of a file.
pub fn parent(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    }
}

/// The name itself is on the disk once its folder is. Not every system can flush a folder; the content is safe anyway.
pub(super) fn sync_folder(folder: &Path) {
    #[cfg(unix)]
    if let Ok(folder) = std::fs::File::open(folder) {
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
