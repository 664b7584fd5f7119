//! A new plushie from an outline: what is asked for, the work on its thread, and what comes of it.

use super::action::FileAction;
use super::files::{Dialog, PathDialog, Purpose};
use super::jobs::{New, Outcome, Refused};
use super::keeping::Kept;
use super::session::Session;
use super::words;
use crate::files;
use crate::operations::Context;
use crate::operations::new_design::{self, Made, Note, Options};
use crate::outline;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// How an outline is read and meshed, as the dialog has it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ImportChoice {
    pub options: Options,
    /// Names of layers between commas as they are typed; none for all.
    pub layers: String,
}

impl ImportChoice {
    /// For the outline in a file, after which the design is called.
    fn options(&self, path: &Path) -> Options {
        let mut options = Options { name: new_design::name_of(path), ..self.options.clone() };
        let names = self.layers.split(',').map(str::trim).filter(|name| !name.is_empty());
        options.import.layers = names.map(str::to_owned).collect();
        options
    }
}

impl Session {
    pub(super) fn import(&mut self, path: PathBuf, choice: ImportChoice) {
        self.files.dialog = None;
        self.files.working = Some("Meshing the outline");
        let within = self.safety.folder().map(Path::to_path_buf);
        self.files.running = Some(self.jobs.start("Import", move |cancel| {
            let made = made(&path, &choice.options(&path), within.as_deref(), cancel);
            Outcome::Imported(made.map(Box::new).map_err(|why| Box::new(Refused { path, choice, why })))
        }));
    }

    pub(super) fn take_import(&mut self, result: Result<Box<New>, Box<Refused>>) {
        self.files.working = None;
        match result {
            Ok(imported) => {
                self.files.imported = Some(imported);
                self.file(FileAction::OpenImported);
            }
            Err(refused) => self.ask_again(*refused),
        }
    }

    pub(super) fn open_imported(&mut self) {
        let Some(imported) = self.files.imported.take() else { return };
        let New { design, changes, notes, texture } = *imported;
        self.files.dialog = None;
        self.open(design, None);
        self.origin = texture.as_ref().map(Kept::origin);
        self.kept = texture;
        for line in words::changes(&changes) {
            self.messages.info(line);
        }
        for Note::MoreFibers { asked, count } in notes {
            self.messages.info(words::more_fibers(asked, count));
        }
        // It is nowhere but here.
        self.history.mark_unsaved();
    }

    /// The dialog with what was chosen, so that another choice is at hand.
    fn ask_again(&mut self, refused: Refused) {
        let Refused { path, choice, why } = refused;
        if self.files.dialog.is_some() {
            self.messages.error(format!("{}: {why}", files::shown(&path)));
            return;
        }
        self.files.dialog = Some(Dialog::Path(PathDialog {
            purpose: Purpose::Import,
            path: path.to_string_lossy().into_owned(),
            import: choice,
            trouble: Some(why),
        }));
    }
}

fn made(path: &Path, options: &Options, within: Option<&Path>, cancel: &AtomicBool) -> Result<New, String> {
    // A pipe would keep the thread waiting for ever.
    let bytes = files::read(path, outline::MAX_FILE_BYTES as u64).map_err(|e| format!("it cannot be opened: {e}"))?;
    let made = new_design::run(&bytes, options, &Context::new(cancel)).map_err(|error| words::unmade(&error))?;
    let Made { mut design, changes, texture, notes } = made;
    let texture = texture.map(|png| Kept::new(&mut design, &png, within)).transpose();
    let texture = texture.map_err(|e| format!("the texture cannot be kept: {e}"))?;
    Ok(New { design, changes, notes, texture })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_dialog_begins_with_the_options_of_the_operation() {
        let choice = ImportChoice { layers: " body, ears,, ".into(), ..ImportChoice::default() };
        let options = choice.options(Path::new("toys/pig.svg"));
        assert_eq!(options.import.layers, ["body", "ears"]);
        let usual = Options { name: "pig".into(), ..Options::default() };
        assert_eq!(ImportChoice::default().options(Path::new("toys/pig.svg")), usual);
    }
}
