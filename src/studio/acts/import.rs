//! A new plushie from an outline: the work on its thread, and what comes of it.

use super::replace;
use crate::files;
use crate::operations::Context;
use crate::operations::new_design::{self, Made, Note, Options};
use crate::operations::preview;
use crate::outline;
use crate::studio::jobs::{New, Outcome, Refused};
use crate::studio::keeping::Kept;
use crate::studio::language::{mark, t, tf};
use crate::studio::session::{Dialog, ImportChoice, PathDialog, Purpose, Session};
use crate::studio::words;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// Begins to read and mesh an outline.
pub fn import(session: &mut Session, path: PathBuf, choice: ImportChoice) {
    session.files.dialog = None;
    session.files.working = Some(t("Meshing the outline"));
    let within = session.safety.folder().map(Path::to_path_buf);
    session.files.running = Some(session.jobs.start(mark("Import"), move |cancel| {
        let made = made(&path, &choice.options(&path), within.as_deref(), cancel);
        Outcome::Imported(made.map(Box::new).map_err(|why| Box::new(Refused { path, choice, why })))
    }));
}

/// Makes what was imported the document.
pub fn open_imported(session: &mut Session) {
    let Some(imported) = session.files.imported.take() else { return };
    let New { design, changes, notes, texture } = *imported;
    session.files.dialog = None;
    replace::open(session, design, None);
    session.document.origin = texture.as_ref().map(Kept::origin);
    session.document.kept = texture;
    for line in words::changes(&changes) {
        session.messages.info(line);
    }
    for Note::MoreFibers(more) in notes {
        session.messages.info(words::more_fibers(more));
    }
    // It is nowhere but here.
    session.document.mark_unsaved();
}

/// The dialog with what was chosen, so that another choice is at hand.
pub fn ask_again(session: &mut Session, refused: Refused) {
    let Refused { path, choice, why } = refused;
    if session.files.dialog.is_some() {
        session.messages.error(format!("{}: {why}", files::shown(&path)));
        return;
    }
    session.files.dialog = Some(Dialog::Path(PathDialog {
        purpose: Purpose::Import,
        path: path.to_string_lossy().into_owned(),
        import: Box::new(choice),
        export: Box::default(),
        film: Box::default(),
        trouble: Some(why),
    }));
}

/// Reads what the dialog names whenever that or its settings change.
pub fn follow(session: &mut Session) {
    let Some(Dialog::Path(dialog)) = &session.files.dialog else { return session.files.preview.forget() };
    if dialog.purpose != Purpose::Import {
        return session.files.preview.forget();
    }
    let Some((path, import)) = session.files.preview.wanted(&dialog.path, &dialog.import) else { return };
    let running = session.jobs.start(mark("Preview"), move |cancel| {
        let result = previewed(&path, &import, cancel);
        Outcome::Previewed { path, import: Box::new(import), result }
    });
    session.files.preview.begin(running);
}

fn previewed(path: &Path, import: &outline::Import, cancel: &AtomicBool) -> Result<Box<preview::Previewed>, String> {
    /// Sides of the picture, pixels: twice what is shown, for screens of many pixels.
    const SIZE: (u32, u32) = (440, 440);
    let bytes = files::read(path, outline::MAX_FILE_BYTES as u64).map_err(|e| tf!("it cannot be opened: {e}", e))?;
    let previewed =
        preview::run(&bytes, import, SIZE, &Context::new(cancel)).map_err(|error| words::unshown(&error))?;
    Ok(Box::new(previewed))
}

fn made(path: &Path, options: &Options, within: Option<&Path>, cancel: &AtomicBool) -> Result<New, String> {
    // A pipe would keep the thread waiting for ever.
    let bytes = files::read(path, outline::MAX_FILE_BYTES as u64).map_err(|e| tf!("it cannot be opened: {e}", e))?;
    let made = new_design::run(&bytes, options, &Context::new(cancel)).map_err(|error| words::unmade(&error))?;
    let Made { mut design, changes, texture, notes } = made;
    let texture = texture.map(|png| Kept::new(&mut design, &png, within)).transpose();
    let texture = texture.map_err(|e| tf!("the texture cannot be kept: {e}", e))?;
    Ok(New { design, changes, notes, texture })
}
