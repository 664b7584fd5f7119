//! A file that is written in full and flushed before it takes its place.

use super::paths::{parent, sync_folder, temporary};
use super::place::Place;
use super::sweep;
use std::fs::{self, File, Metadata};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::{NamedTempFile, TempPath};

/// The content of a file to be, on the disk; dropped, it is gone.
pub(super) struct Draft {
    paper: Paper,
    path: PathBuf,
    taken: bool,
}

enum Paper {
    /// Without a name, so that nothing can remain of it.
    #[cfg(target_os = "linux")]
    Unnamed(File),
    Named(NamedTempFile),
}

/// How to give a place back after [`Draft::commit_undoable`].
pub(super) enum Undo {
    /// Nothing was there.
    Remove(PathBuf),
    /// The old file under another name, held.
    Return(TempPath, PathBuf, Option<File>),
}

impl Draft {
    pub(super) fn new(place: Place, bytes: &[u8]) -> io::Result<Self> {
        let (path, old) = match place {
            Place::Free(path) => (path, None),
            Place::Taken(path, old) => (path, Some(old)),
            Place::Stream => return Err(io::ErrorKind::InvalidInput.into()),
        };
        let folder = parent(&path);
        sweep::sweep(folder);
        let mut paper = Paper::new(folder)?;
        if let Some(old) = &old {
            become_like(paper.file(), old, &path)?;
        }
        let file = paper.file();
        // Held, so that nobody takes it for one that was left behind.
        let _ = file.try_lock();
        file.write_all(bytes)?;
        file.sync_all()?;
        Ok(Self { paper, path, taken: old.is_some() })
    }

    /// Takes the place.
    pub(super) fn commit(self) -> io::Result<()> {
        let folder = parent(&self.path);
        match self.paper {
            #[cfg(target_os = "linux")]
            Paper::Unnamed(file) => name(&file, &self.path, self.taken)?,
            Paper::Named(file) => drop(file.persist(&self.path).map_err(|e| e.error)?),
        }
        sync_folder(folder);
        Ok(())
    }

    /// Takes the place in a way that can be taken back.
    pub(super) fn commit_undoable(self) -> io::Result<Undo> {
        let path = self.path.clone();
        let undo = if self.taken {
            // A second name for the old file: it is never missing, whatever happens in between.
            let second = temporary().make_in(parent(&path), |second| {
                fs::hard_link(&path, second).or_else(|_| fs::copy(&path, second).map(drop))
            })?;
            let second = second.into_temp_path();
            let held = File::open(&second).ok().filter(|file| file.try_lock().is_ok());
            Undo::Return(second, path, held)
        } else {
            Undo::Remove(path)
        };
        self.commit()?;
        Ok(undo)
    }
}

impl Undo {
    /// As well as it goes: whatever fails here, the failure that led here is the one to tell.
    pub(super) fn undo(self) {
        match self {
            Self::Remove(path) => drop(fs::remove_file(path)),
            Self::Return(old, path, _held) => drop(old.persist(path)),
        }
    }
}

impl Paper {
    fn new(folder: &Path) -> io::Result<Self> {
        #[cfg(target_os = "linux")]
        if let Some(file) = unnamed(folder) {
            return Ok(Self::Unnamed(file));
        }
        // Made here, as what `tempfile` makes is private and its errors state the temporary name.
        temporary()
            .make_in(folder, |path| File::options().read(true).write(true).create_new(true).open(path))
            .map(Self::Named)
    }

    fn file(&mut self) -> &mut File {
        match self {
            #[cfg(target_os = "linux")]
            Self::Unnamed(file) => file,
            Self::Named(file) => file.as_file_mut(),
        }
    }
}

/// A file without a name, where the file system has such and `/proc` can name it.
#[cfg(target_os = "linux")]
fn unnamed(folder: &Path) -> Option<File> {
    use rustix::fs::{Mode, OFlags};
    let flags = OFlags::TMPFILE | OFlags::RDWR | OFlags::CLOEXEC;
    let file = rustix::fs::open(folder, flags, Mode::from_raw_mode(0o666)).ok().map(File::from)?;
    // A file system may take the flag and still be unable to name the file.
    descriptor(&file).exists().then_some(file)
}

#[cfg(target_os = "linux")]
fn descriptor(file: &File) -> PathBuf {
    use std::os::fd::AsRawFd;
    PathBuf::from(format!("/proc/self/fd/{}", file.as_raw_fd()))
}

/// Gives an unnamed file its name: at once where that is free, else by another name for the moment between two system calls, as no
/// call replaces a file by one without a name.
#[cfg(target_os = "linux")]
fn name(file: &File, path: &Path, taken: bool) -> io::Result<()> {
    let link = |path: &Path| -> io::Result<()> {
        use rustix::fs::{AtFlags, CWD, linkat};
        Ok(linkat(CWD, descriptor(file), CWD, path, AtFlags::SYMLINK_FOLLOW)?)
    };
    if !taken {
        match link(path) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            done => return done,
        }
    }
    let named = temporary().make_in(parent(path), link)?;
    named.into_temp_path().persist(path).map_err(|e| e.error)
}

/// Gives a file the owner, group, mode and extended attributes of the one that it replaces.
fn become_like(file: &File, old: &Metadata, path: &Path) -> io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::{MetadataExt, PermissionsExt, fchown};
        let new = file.metadata()?;
        if (new.uid(), new.gid()) != (old.uid(), old.gid()) {
            fchown(file, Some(old.uid()), Some(old.gid())).map_err(|_| {
                let why = "it belongs to another user or group, which a new file would not keep";
                io::Error::new(io::ErrorKind::PermissionDenied, why)
            })?;
        }
        attributes(file, path);
        file.set_permissions(fs::Permissions::from_mode(old.mode() & 0o7777))
    }
    #[cfg(not(unix))]
    {
        let _ = path;
        file.set_permissions(old.permissions())
    }
}

/// Copies extended attributes (access lists are such), as far as the file system and the user may.
#[cfg(unix)]
fn attributes(file: &File, path: &Path) {
    #[cfg(target_os = "linux")]
    {
        use rustix::fs::{XattrFlags, fsetxattr, getxattr, listxattr};
        /// Largest list and value that Linux has.
        const MOST: usize = 1 << 16;
        let mut names = vec![0_u8; MOST];
        let Ok(length) = listxattr(path, &mut names) else { return };
        for name in names[..length].split(|&byte| byte == 0).filter(|name| !name.is_empty()) {
            // Labels of the system's are given by the system.
            if name.starts_with(b"security.") {
                continue;
            }
            let mut value = vec![0_u8; MOST];
            if let Ok(length) = getxattr(path, name, &mut value) {
                let _ = fsetxattr(file, name, &value[..length], XattrFlags::empty());
            }
        }
    }
    #[cfg(not(target_os = "linux"))]
    let _ = (file, path);
}
