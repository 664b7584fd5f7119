//! What the platform keeps for the program, and its logs.

use super::open_at_once;
use etcetera::BaseStrategy;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Largest log that is gone on with, bytes; a larger one begins anew, and the old one is kept as `.old`.
const MOST_LOG: u64 = 1 << 20;
/// What stands in the first line of a log, by which one is told from a file of others.
const LOG_MARK: &str = " s INFO  plushwright ";
/// How much of a file is looked at for it, bytes.
const HEAD: u64 = 100;

/// Where this platform keeps what the program remembers (settings, work that was not saved, logs, reports): `~/.local/state/plushwright` on
/// Linux, the application data on others. None where there is no home. It need not be there yet.
pub fn state_folder() -> Option<PathBuf> {
    let strategy = etcetera::choose_base_strategy().ok()?;
    Some(strategy.state_dir().unwrap_or_else(|| strategy.data_dir()).join("plushwright"))
}

/// Makes a folder with those above it, for this user alone, where it is missing.
///
/// # Errors
/// What the system says.
pub fn make_private(folder: &Path) -> io::Result<()> {
    let mut builder = fs::DirBuilder::new();
    builder.recursive(true);
    #[cfg(unix)]
    std::os::unix::fs::DirBuilderExt::mode(&mut builder, 0o700);
    builder.create(folder)
}

/// Begins a log, in the place of an earlier one.
///
/// # Errors
/// Something else stands there; what the system says.
pub fn begin_log(path: &Path) -> io::Result<File> {
    if super::is_taken(path) {
        let mut head = Vec::new();
        open_at_once(path)?.take(HEAD).read_to_end(&mut head)?;
        if !head.is_empty() && !String::from_utf8_lossy(&head).contains(LOG_MARK) {
            return Err(io::Error::new(io::ErrorKind::AlreadyExists, "a file is there that is no log"));
        }
    }
    File::create(path)
}

/// A log that is gone on with from start to start.
///
/// # Errors
/// What the system says.
pub fn continue_log(path: &Path) -> io::Result<File> {
    make_private(super::parent(path))?;
    if fs::metadata(path).is_ok_and(|found| found.len() > MOST_LOG) {
        fs::rename(path, path.with_extension("log.old"))?;
    }
    File::options().create(true).append(true).open(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_takes_the_place_of_a_log_alone() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        fs::write(&path, format!("    0.000{LOG_MARK}0.1.0")).unwrap();
        assert!(begin_log(&path).is_ok() && begin_log(&path).is_ok());
        fs::write(&path, "(version: 2)").unwrap();
        assert_eq!(begin_log(&path).unwrap_err().kind(), io::ErrorKind::AlreadyExists);
        assert_eq!(fs::read(&path).unwrap(), b"(version: 2)");
    }

    #[test]
    fn a_long_log_begins_anew() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("logs/a.log");
        continue_log(&path).unwrap().set_len(MOST_LOG + 1).unwrap();
        assert_eq!(continue_log(&path).unwrap().metadata().unwrap().len(), 0);
        assert!(path.with_extension("log.old").is_file());
    }
}
