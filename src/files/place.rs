//! What stands where a file is to be written, and whether it may be replaced.

use super::paths::{absolute, parent};
use std::fs::{self, Metadata};
use std::io;
use std::path::{Path, PathBuf};

/// Links that are followed: as many as Linux follows.
const MOST_LINKS: usize = 40;

/// Where a file goes.
pub(super) enum Place {
    /// Nothing is there; where the path leads.
    Free(PathBuf),
    /// A file that may be replaced.
    Taken(PathBuf, Metadata),
    /// A terminal, a pipe, the null device: written to, not replaced.
    Stream,
}

/// Looks at the place that `path` leads to.
///
/// # Errors
/// It is a folder, read-only, or something else that is no place for a file.
pub(super) fn find(path: &Path) -> io::Result<Place> {
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => Err(refused(io::ErrorKind::IsADirectory, "a folder has that name")),
        Ok(found) if found.is_file() => {
            if found.permissions().readonly() || !is_writable(path) {
                return Err(refused(io::ErrorKind::PermissionDenied, "the file is read-only"));
            }
            Ok(Place::Taken(fs::canonicalize(path)?, found))
        }
        Ok(found) if is_stream(&found) => Ok(Place::Stream),
        Ok(_) => Err(refused(io::ErrorKind::InvalidInput, "what has that name is not a regular file")),
        Err(error) if error.kind() == io::ErrorKind::NotFound => free(path),
        Err(error) => Err(error),
    }
}

/// Whether a file of some length is there, which would be lost if it were replaced.
pub fn is_taken(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|found| found.is_file() && found.len() > 0)
}

/// Whether both paths lead to one file, by whatever names.
pub fn same(a: &Path, b: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let identity = |path: &Path| fs::metadata(path).ok().map(|found| (found.dev(), found.ino()));
        identity(a).is_some_and(|a| Some(a) == identity(b))
    }
    #[cfg(not(unix))]
    matches!((fs::canonicalize(a), fs::canonicalize(b)), (Ok(a), Ok(b)) if a == b)
}

/// Where a path leads at which nothing is: through links that dangle.
fn free(path: &Path) -> io::Result<Place> {
    end_of_links(path).map(Place::Free)
}

/// The absolute path that a name stands for when the links in its last place are followed, though nothing is there.
///
/// # Errors
/// It has no last part, or leads in a circle.
pub(super) fn end_of_links(path: &Path) -> io::Result<PathBuf> {
    let mut path = absolute(path)?;
    for _ in 0..MOST_LINKS {
        match fs::read_link(&path) {
            Ok(target) => path = parent(&path).join(target),
            Err(_) if path.file_name().is_none() => break,
            Err(_) => return Ok(path),
        }
    }
    Err(refused(io::ErrorKind::InvalidInput, "that is no name for a file"))
}

fn refused(kind: io::ErrorKind, why: &'static str) -> io::Error {
    io::Error::new(kind, why)
}

/// Whether the user may write to a file. Replacing it needs only its folder's permission, which is not what they were given.
fn is_writable(path: &Path) -> bool {
    #[cfg(unix)]
    return rustix::fs::access(path, rustix::fs::Access::WRITE_OK).is_ok();
    #[cfg(not(unix))]
    {
        let _ = path;
        true
    }
}

fn is_stream(found: &Metadata) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        found.file_type().is_char_device() || found.file_type().is_fifo()
    }
    #[cfg(not(unix))]
    {
        let _ = found;
        false
    }
}
