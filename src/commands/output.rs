//! Outputs: files and folders that appear whole or not at all, and lines on the given writer.

use super::error::{CommandError, check_cancel};
use crate::design::file::parent;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// Replaces `path` by `bytes` in one step; nothing is written once `cancel` is raised.
pub fn write_file(path: &Path, bytes: &[u8], cancel: &AtomicBool) -> Result<(), CommandError> {
    check_cancel(cancel)?;
    let fail = |e| CommandError::write(path, e);
    if path.is_dir() {
        return Err(fail(std::io::ErrorKind::IsADirectory.into()));
    }
    let mut file = new_file(parent(path)).map_err(fail)?;
    file.write_all(bytes).and_then(|()| file.as_file().sync_all()).map_err(fail)?;
    file.persist(path).map_err(|e| fail(e.error))?;
    Ok(())
}

/// Replaces `path` by `bytes`, then does what needs the file; if that fails, the old file, or none, is there again.
pub fn write_file_and(
    path: &Path,
    bytes: &[u8],
    cancel: &AtomicBool,
    then: impl FnOnce() -> Result<(), CommandError>,
) -> Result<(), CommandError> {
    let fail = |e| CommandError::write(path, e);
    let aside = tempfile::Builder::new().prefix(".plushwright-").tempdir_in(parent(path)).map_err(fail)?;
    let old = aside.path().join("old");
    let there = path.is_file();
    if there {
        // A second name for the same file: it is never missing, whatever happens in between.
        std::fs::hard_link(path, &old).or_else(|_| std::fs::copy(path, &old).map(drop)).map_err(fail)?;
    }
    write_file(path, bytes, cancel)?;
    let done = then();
    if done.is_err() {
        let undone = if there { std::fs::rename(&old, path) } else { std::fs::remove_file(path) };
        undone.map_err(fail)?;
    }
    done
}

/// A fresh folder beside `path`, to be filled and then moved there with [`Staged::commit`]. Dropped, it vanishes.
pub struct Staged {
    folder: tempfile::TempDir,
    path: PathBuf,
}

impl Staged {
    pub fn beside(path: &Path) -> Result<Self, CommandError> {
        let folder = tempfile::Builder::new()
            .prefix(".plushwright-")
            .tempdir_in(parent(path))
            .map_err(|e| CommandError::write(path, e))?;
        Ok(Self { folder, path: path.to_owned() })
    }

    pub fn folder(&self) -> &Path {
        self.folder.path()
    }

    /// Moves the folder to its place. A folder that stands there already is set aside first and removed last.
    pub fn commit(self, cancel: &AtomicBool) -> Result<(), CommandError> {
        check_cancel(cancel)?;
        let fail = |e| CommandError::write(&self.path, e);
        #[cfg(unix)]
        {
            // A temporary folder is private; a result is as readable as its neighbours.
            use std::os::unix::fs::PermissionsExt;
            std::fs::set_permissions(self.folder.path(), std::fs::Permissions::from_mode(0o755)).map_err(fail)?;
        }
        let aside = if self.path.exists() {
            let aside =
                tempfile::Builder::new().prefix(".plushwright-").tempdir_in(parent(&self.path)).map_err(fail)?;
            std::fs::rename(&self.path, aside.path().join("old")).map_err(fail)?;
            Some(aside)
        } else {
            None
        };
        if let Err(error) = std::fs::rename(self.folder.path(), &self.path) {
            if let Some(aside) = &aside {
                std::fs::rename(aside.path().join("old"), &self.path).map_err(fail)?;
            }
            return Err(fail(error));
        }
        // The folder has moved away; forget the temporary name.
        let _ = self.folder.keep();
        Ok(())
    }
}

/// Prints one line.
pub fn say(out: &mut dyn Write, text: &str) -> Result<(), CommandError> {
    writeln!(out, "{text}").map_err(CommandError::Print)
}

/// Prints a value as indented JSON.
pub fn say_json(out: &mut dyn Write, value: &impl serde::Serialize) -> Result<(), CommandError> {
    say(out, &json(value)?)
}

/// A value as indented JSON text.
pub fn json(value: &impl serde::Serialize) -> Result<String, CommandError> {
    serde_json::to_string_pretty(value).map_err(|e| CommandError::Failed(format!("cannot form JSON: {e}")))
}

/// Reads an input file as text.
pub fn read_text(path: &Path) -> Result<String, CommandError> {
    std::fs::read_to_string(path).map_err(|e| CommandError::input(path, e))
}

/// A temporary file that, once kept, is as readable as any other new file (the default is private).
fn new_file(folder: &Path) -> std::io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".plushwright-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(std::fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(folder)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cancelled_write_leaves_the_old_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        write_file(&path, b"old", &AtomicBool::new(false)).unwrap();
        assert!(write_file(&path, b"new", &AtomicBool::new(true)).is_err());
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_file_is_as_before_where_what_follows_fails() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        let go = AtomicBool::new(false);
        let fails = || write_file_and(&path, b"new", &go, || Err(CommandError::Cancelled));
        assert!(fails().is_err() && std::fs::read_dir(folder.path()).unwrap().count() == 0);
        write_file_and(&path, b"old", &go, || Ok(())).unwrap();
        assert!(fails().is_err());
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
        write_file_and(&path, b"new", &go, || Ok(())).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"new");
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn a_staged_folder_replaces_the_old_one_or_vanishes() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("demo");
        for text in ["one", "two"] {
            let staged = Staged::beside(&path).unwrap();
            std::fs::write(staged.folder().join(text), text).unwrap();
            staged.commit(&AtomicBool::new(false)).unwrap();
            assert_eq!(std::fs::read(path.join(text)).unwrap(), text.as_bytes());
            assert_eq!(std::fs::read_dir(&path).unwrap().count(), 1);
        }
        drop(Staged::beside(&path).unwrap());
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
