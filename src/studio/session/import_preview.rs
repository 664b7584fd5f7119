//! What would be read of an outline, while its dialog is open: one slot, the newest request wins.

use super::ImportChoice;
use crate::operations::preview::Previewed;
use crate::outline::Import;
use crate::studio::jobs::Running;
use std::path::{Path, PathBuf};

/// The preview of the dialog that is open.
#[derive(Default)]
pub struct ImportPreview {
    /// What was asked for last.
    asked: Option<(PathBuf, Import)>,
    running: Option<Running>,
    shown: Option<(PathBuf, Import, Result<Box<Previewed>, String>)>,
    /// Counts what was shown.
    serial: u64,
}

impl ImportPreview {
    /// What was found in the file with a path, and whether that is with the settings as they are.
    pub fn of(&self, path: &str, choice: &ImportChoice) -> Option<(Result<&Previewed, &str>, bool)> {
        let (shown, import, result) = self.shown.as_ref()?;
        let path = Path::new(path.trim());
        let fresh = *import == choice.options(path).import;
        (shown == path).then(|| (result.as_deref().map_err(String::as_str), fresh))
    }

    /// Tells one picture from the next.
    pub fn serial(&self) -> u64 {
        self.serial
    }

    /// What has to be read, where nothing is at work and it is not shown already.
    pub(crate) fn wanted(&mut self, path: &str, choice: &ImportChoice) -> Option<(PathBuf, Import)> {
        let path = PathBuf::from(path.trim());
        let import = choice.options(&path).import;
        let asked = Some((path, import));
        if self.running.is_some() || self.asked == asked {
            return None;
        }
        self.asked.clone_from(&asked);
        asked.filter(|(path, _)| path.is_file())
    }

    pub(crate) fn begin(&mut self, running: Running) {
        self.running = Some(running);
    }

    /// A job is over, or broke.
    pub(crate) fn take(&mut self, serial: u64, path: PathBuf, import: Import, result: Result<Box<Previewed>, String>) {
        if Running::is(self.running.as_ref(), serial) {
            self.running = None;
            self.serial += 1;
            self.shown = Some((path, import, result));
        }
    }

    pub(crate) fn break_off(&mut self, serial: u64) {
        if Running::is(self.running.as_ref(), serial) {
            self.running = None;
        }
    }

    /// The dialog is closed.
    pub(crate) fn forget(&mut self) {
        self.asked = None;
        self.shown = None;
    }
}
