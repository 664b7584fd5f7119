//! Keeps others off a file between reading and writing it.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::Path;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// How often a file that another process holds is asked for again: soon after it is free for a person, seldom for the machine.
const AGAIN: Duration = Duration::from_millis(20);

/// An exclusive lock on a file or a folder, for processes that ask for one. It ends when it is dropped or its process ends.
pub struct Hold(#[allow(dead_code, reason = "held, not used")] Option<File>);

impl Hold {
    /// Waits for the file or folder as long as `wait` says so, given how long it has been.
    ///
    /// Where a system or a file system has no such locks the file is not held: a [`super::Stamp`] still tells of changes.
    ///
    /// # Errors
    /// [`io::ErrorKind::WouldBlock`] when the waiting was given up; what the system says of a file that cannot be opened.
    pub fn of(path: &Path, mut wait: impl FnMut(Duration) -> bool) -> io::Result<Self> {
        // Elsewhere a lock keeps others from reading too.
        let found = fs::metadata(path)?;
        // Another thing may hang when it is opened.
        if !cfg!(unix) || !(found.is_file() || found.is_dir()) {
            return Ok(Self(None));
        }
        let since = Instant::now();
        loop {
            let file = File::open(path)?;
            match file.try_lock() {
                // Who held it may have put another file in its place.
                Ok(()) if is_at(&file, path) => return Ok(Self(Some(file))),
                Ok(()) => continue,
                Err(TryLockError::WouldBlock) => {}
                Err(TryLockError::Error(_)) => return Ok(Self(None)),
            }
            if !wait(since.elapsed()) {
                return Err(io::Error::new(io::ErrorKind::WouldBlock, "another process is writing it"));
            }
            sleep(AGAIN);
        }
    }
}

fn is_at(file: &File, path: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        let identity = |found: io::Result<fs::Metadata>| found.ok().map(|found| (found.dev(), found.ino()));
        identity(file.metadata()).is_some_and(|held| Some(held) == identity(fs::metadata(path)))
    }
    #[cfg(not(unix))]
    {
        let _ = (file, path);
        true
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_held_file_is_waited_for_and_a_new_one_in_its_place_is_found() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        fs::write(&path, "0").unwrap();
        let held = Hold::of(&path, |_| false).unwrap();
        assert!(Hold::of(&path, |_| false).is_err());
        // Every thread adds one to what it finds; none is lost.
        std::thread::scope(|threads| {
            for _ in 0..8 {
                threads.spawn(|| {
                    let _held = Hold::of(&path, |_| true).unwrap();
                    let number: u32 = fs::read_to_string(&path).unwrap().parse().unwrap();
                    super::super::write(&path, (number + 1).to_string().as_bytes()).unwrap();
                });
            }
            drop(held);
        });
        assert_eq!(fs::read_to_string(&path).unwrap(), "8");
    }
}
