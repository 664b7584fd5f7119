//! Reading and writing the design file.

use super::error::{CommandError, check_cancel};
use super::output::parent;
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
    match design.texture.as_deref().and_then(|texture| moved(texture, from, to)) {
        None => save(to, design, cancel),
        texture => save(to, &Design { texture, ..design.clone() }, cancel),
    }
}

/// A path relative to the folder of `from` as seen from the folder of `to`; none where it stays as it is.
fn moved(path: &str, from: &Path, to: &Path) -> Option<String> {
    let [from, to] = [from, to].map(|file| parent(file).canonicalize().ok());
    let (from, to) = (from?, to?);
    if from == to || Path::new(path).is_absolute() {
        return None;
    }
    let common = from.components().zip(to.components()).take_while(|(a, b)| a == b).count();
    if common == 0 {
        // Another drive.
        return from.join(path).to_str().map(str::to_owned);
    }
    let up = to.components().skip(common).map(|_| Some(".."));
    let down = from.components().skip(common).map(|part| part.as_os_str().to_str());
    let parts: Option<Vec<&str>> = up.chain(down).chain([Some(path)]).collect();
    Some(parts?.join("/"))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_relative_path_leads_to_the_same_file_from_another_folder() {
        let folder = tempfile::tempdir().unwrap();
        let at = |path: &str| folder.path().join(path);
        for path in ["a/b", "c"] {
            std::fs::create_dir_all(at(path)).unwrap();
        }
        let seen = |from: &str, to: &str| moved("x.png", &at(from), &at(to));
        assert_eq!(seen("a/p.plush", "a/q.plush"), None);
        assert_eq!(seen("a/p.plush", "a/../a/b/../q.plush"), None);
        assert_eq!(seen("a/p.plush", "c/q.plush").as_deref(), Some("../a/x.png"));
        assert_eq!(seen("p.plush", "a/b/q.plush").as_deref(), Some("../../x.png"));
        assert_eq!(seen("a/b/p.plush", "q.plush").as_deref(), Some("a/b/x.png"));
        assert_eq!(moved("/x.png", &at("a/p.plush"), &at("c/q.plush")), None);
    }
}
