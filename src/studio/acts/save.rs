//! Saving the document.

use super::keep;
use crate::design::{FileError, file};
use crate::files::{self, Hold};
use crate::studio::language::tf;
use crate::studio::session::{Dialog, Session, Why};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// How long saving waits for another process that writes the same file.
const PATIENCE: Duration = Duration::from_millis(500);

/// Saves the document. What is not the document's own file, or is not what was read any more, is asked about, unless the answer was
/// to `replace` it. Whether it was saved.
pub fn save(session: &mut Session, path: PathBuf, replace: bool) -> bool {
    let full = if path.extension().is_none() { path.with_extension("plush") } else { path.clone() };
    let is_special = |path: &PathBuf| std::fs::metadata(path).is_ok_and(|found| !found.is_file() && !found.is_dir());
    if let Some(path) = [&path, &full].into_iter().find(|&path| is_special(path)) {
        // A pipe or a device keeps nothing: it would count as saved.
        session.files.after_save = None;
        session
            .messages
            .error(tf!("{path} is not a regular file; nothing would be kept there", path = files::shown(path)));
        return false;
    }
    let path = full;
    let own = session.document.path.as_deref().is_some_and(|own| own == path || files::same(own, &path));
    if files::is_taken(&path) && !own && !replace {
        let why = if file::is_design(&path) { Why::Exists } else { Why::Foreign };
        session.files.dialog = Some(Dialog::Replace(path, why));
        return false;
    }
    let seen = session.safety.seen.filter(|_| own && !replace);
    let saved = hold(&path).map_err(|source| FileError::Write { path: path.clone(), source });
    let origin = session.origin();
    let saved = saved.and_then(|_held| file::save(session.design(), origin, &path, seen.as_ref()));
    match saved {
        Ok(seen) => {
            session.document.mark_saved();
            session.messages.info(tf!("Saved {path}", path = files::shown(&path)));
            keep::opened(session, &path);
            session.safety.seen = Some(seen);
            session.document.path = Some(path);
            session.files.dialog = None;
            return true;
        }
        Err(FileError::Changed { path }) => session.files.dialog = Some(Dialog::Replace(path, Why::Changed)),
        Err(error) => {
            // What was to follow a success does not follow another one.
            session.files.after_save = None;
            session.messages.error(error.to_string());
        }
    }
    false
}

/// Keeps other processes off a file that is about to be saved.
fn hold(path: &Path) -> std::io::Result<Option<Hold>> {
    if !path.is_file() {
        return Ok(None);
    }
    Hold::of(path, |waited| waited < PATIENCE).map(Some)
}
