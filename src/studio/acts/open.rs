//! Opening a file or an example.

use super::{keep, paths, replace};
use crate::design::{bundled, file};
use crate::outline;
use crate::studio::session::{Dialog, Purpose, Session};
use std::path::PathBuf;

/// Opens a plushie; of an outline it is asked how.
pub fn open_path(session: &mut Session, path: PathBuf) {
    if outline::extensions().iter().any(|known| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(known))) {
        paths::show_path_dialog(session, Purpose::Import);
        if let Some(Dialog::Path(dialog)) = &mut session.files.dialog {
            dialog.path = path.to_string_lossy().into_owned();
        }
        return;
    }
    match file::read_stamped(&path) {
        Ok((design, seen)) => {
            session.files.dialog = None;
            replace::open(session, design, Some(path.clone()));
            session.safety.seen = Some(seen);
            keep::opened(session, &path);
        }
        Err(error) => session.messages.error(error.to_string()),
    }
}

/// Opens an example of the program.
pub fn open_example(session: &mut Session, index: usize) {
    let Some(example) = bundled::ALL.get(index) else { return };
    match example.design() {
        Ok(design) => replace::open(session, design, None),
        Err(error) => session.messages.error(format!("{}: {error}", example.name)),
    }
}
