//! Opening, importing, saving and exporting, and what is asked about before.
//!
//! Paths are asked for with the desktop's own dialogs, on a thread. Where there are none (a bare X server, a test) a field in the window
//! takes their place.

use super::{film, follow, import, keep, open, paths, replace, save, sheet};
use crate::defaults;
use crate::design::file::is_design;
use crate::files;
use crate::operations::{Context, Progress, export};
use crate::studio::action::Sketch;
use crate::studio::jobs::{self, New, Outcome, Refused};
use crate::studio::language::{mark, t, tf};
use crate::studio::session::{Dialog, Done, FREEHAND, FileAction, PathDialog, Picking, Purpose, Resolution, Session};
use crate::studio::words;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Does what is asked for, or asks about changes that would be lost.
pub fn ask(session: &mut Session, action: FileAction) {
    let replaces = matches!(
        action,
        FileAction::Open
            | FileAction::Import
            | FileAction::NewDrawing
            | FileAction::OpenPath(_)
            | FileAction::OpenExample(_)
            | FileAction::ImportPath { .. }
            | FileAction::OpenImported
            | FileAction::Recover
            | FileAction::Quit
    );
    // An answer is about the document as it was then. Whatever dialog is open, the end of all work is asked about.
    let granted = action != FileAction::Quit
        && session.files.granted.as_ref().is_some_and(|granted| Arc::ptr_eq(granted, session.design()));
    if replaces && !granted && (session.document.is_modified() || session.sketching.waits) {
        session.files.after_save = None;
        session.files.dialog = Some(Dialog::Unsaved(Box::new(action)));
        return;
    }
    go_on(session, action);
}

/// Does what is asked for.
fn go_on(session: &mut Session, action: FileAction) {
    match action {
        FileAction::Open => paths::ask_path(session, Purpose::Open),
        FileAction::Import => paths::show_path_dialog(session, Purpose::Import),
        FileAction::NewDrawing => {
            replace::open(session, sheet::blank(), None);
            session.sketching.fresh = true;
            session.meshing.wanted = Some(Resolution { fibers: defaults::FIBERS, finer: 1 });
            sheet::sketch(session, Sketch::Open(true));
            session.tools[1] = FREEHAND;
        }
        FileAction::SaveAs => paths::ask_path(session, Purpose::SaveAs),
        FileAction::Export if session.design().networks.is_empty() => {
            session.messages.warning(t("There is nothing to export yet: propose and accept a network first."));
        }
        FileAction::Film => paths::show_path_dialog(session, Purpose::Film),
        FileAction::FilmPath { path, options } => film::start(session, path, options),
        FileAction::Export => paths::show_path_dialog(session, Purpose::Export),
        FileAction::Save => match session.document.path.clone() {
            Some(path) => save_and_go_on(session, path, false),
            None => paths::ask_path(session, Purpose::SaveAs),
        },
        FileAction::OpenPath(path) => open::open_path(session, path),
        FileAction::OpenExample(index) => open::open_example(session, index),
        FileAction::ImportPath { path, choice } => import::import(session, path, *choice),
        FileAction::Dropped(path) if session.files.dialog.is_some() => {
            let path = files::shown(&path);
            session.messages.warning(tf!("{path} was not opened: answer the dialog first.", path));
        }
        FileAction::Dropped(path) => ask(session, FileAction::OpenPath(path)),
        FileAction::OpenImported => import::open_imported(session),
        FileAction::SavePath(path) => save_and_go_on(session, path, false),
        FileAction::ReplacePath(path) => save_and_go_on(session, path, true),
        FileAction::Recover => keep::recover(session),
        FileAction::DiscardWork => keep::discard_work(session),
        FileAction::RecoverLater => keep::recover_later(session),
        FileAction::ExportPath { folder, options } => export(session, folder, options),
        FileAction::CloseDialog if session.files.dialog == Some(Dialog::Recover) => keep::recover_later(session),
        FileAction::CloseDialog => {
            session.files.dialog = None;
            session.files.take_back();
            session.files.imported = None;
        }
        FileAction::EditDialog(dialog) => session.files.dialog = Some(Dialog::Path(dialog)),
        FileAction::SaveAndGoOn => {
            if let Some(Dialog::Unsaved(next)) = session.files.dialog.take() {
                session.files.after_save = Some(*next);
                go_on(session, FileAction::Save);
            }
        }
        FileAction::DiscardAndGoOn => {
            if let Some(Dialog::Unsaved(next)) = session.files.dialog.take() {
                session.files.granted = Some(session.design().clone());
                go_on(session, *next);
            }
        }
        FileAction::Browse => {
            if let Some(Dialog::Path(dialog)) = &session.files.dialog {
                paths::pick(session, dialog.purpose);
            }
        }
        FileAction::Quit => keep::quit(session),
    }
}

/// The desktop's dialog was answered.
pub fn take_path(session: &mut Session, serial: u64, path: Option<PathBuf>, at_once: bool) {
    let Some(Picking { purpose, wanted, .. }) = session.files.picking.take_if(|picking| picking.serial == serial)
    else {
        return;
    };
    let dialog = match &session.files.dialog {
        Some(Dialog::Path(dialog)) if dialog.purpose == purpose => Some(dialog.clone()),
        _ => None,
    };
    match (path, dialog) {
        (Some(path), Some(dialog)) => {
            let path = if purpose == Purpose::Export { path.join(session.document.folder_name()) } else { path };
            let path = path.to_string_lossy().into_owned();
            session.files.dialog = Some(Dialog::Path(PathDialog { path, trouble: None, ..dialog }));
        }
        (Some(path), None) if wanted => take_answer(session, purpose, path),
        // Nobody cancels that fast: there was no dialog.
        (None, dialog) if at_once => {
            session.files.native_dialogs = false;
            match (dialog, &session.files.dialog) {
                (Some(_), _) => session.messages.info(t("This desktop has no file dialogs; type the path instead.")),
                (None, None) if wanted => paths::show_path_dialog(session, purpose),
                _ => session.files.take_back(),
            }
        }
        // The dialog in the window is still there to be answered.
        (None, Some(_)) => {}
        (None, None) => session.files.take_back(),
        (Some(path), None) => {
            session.files.take_back();
            let path = files::shown(&path);
            session.messages.warning(tf!("Nothing was saved to {path}: another plushie is open by now.", path));
        }
    }
}

/// A path from the desktop, with no dialog of the window's that it was for.
fn take_answer(session: &mut Session, purpose: Purpose, path: PathBuf) {
    match purpose {
        Purpose::Open => ask(session, FileAction::Dropped(path)),
        Purpose::SaveAs => {
            // The desktop has asked about a plushie that would be replaced.
            let asked = path.extension().is_some() && is_design(&path);
            save_and_go_on(session, path, asked);
        }
        // Their dialog was closed in the meantime.
        Purpose::Import | Purpose::Export | Purpose::Film => {}
    }
}

pub fn take_import(session: &mut Session, result: Result<Box<New>, Box<Refused>>) {
    match result {
        Ok(imported) => {
            session.files.imported = Some(imported);
            ask(session, FileAction::OpenImported);
        }
        Err(refused) => import::ask_again(session, *refused),
    }
}

pub fn take_export(session: &mut Session, folder: &Path, result: Result<Vec<String>, String>) {
    match result {
        Ok(remarks) => {
            if let Some(text) = words::remarks(&remarks) {
                session.messages.warning(text);
            }
            let path = files::shown(folder);
            session.messages.done(if folder.join("pattern-a4.pdf").is_file() {
                tf!("The blueprint is in {path}. To print the pattern at home: pattern-a4.pdf or pattern-letter.pdf there, at 100 %", path)
            } else {
                tf!("The blueprint is in {path}", path)
            });
        }
        Err(why) => session.messages.error(tf!("No blueprint was written: {why}", why)),
    }
}

fn export(session: &mut Session, folder: PathBuf, options: export::Options) {
    session.files.dialog = None;
    session.files.working = Some(t("Exporting the blueprint"));
    let (design, export) = (session.design().clone(), session.services.export.clone());
    let (done, wake) = (Done::default(), session.jobs.wake());
    session.files.done = done.clone();
    session.files.running = Some(session.jobs.start(mark("job|Export"), move |cancel| {
        let mut progress = |step: &Progress| {
            if let Progress::Part { done: now, of } = step {
                done.say(*now, *of);
                wake();
            }
        };
        let result = export(&design, &folder, &options, &mut Context::telling(cancel, &mut progress));
        Outcome::Exported { folder, result }
    }));
}

/// Stops what [`Session::working`] tells of; nothing of it is kept. What reads or writes a file tells itself that it has stopped.
pub fn stop(session: &mut Session) {
    if let Some(running) = &session.files.running {
        running.cancel();
        session.files.working = Some(t("Stopping"));
    } else if session.rigging.running.is_some() || session.rigging.curve.running.is_some() {
        session.rigging.cancel();
    } else if session.keying.is_some() {
        jobs::cancel(&mut session.keying);
    } else if session.filming.running.is_some() {
        jobs::cancel(&mut session.filming.running);
    } else if session.following.is_running() {
        follow::stop(session);
    }
}

/// Saves, and does what waited for that.
fn save_and_go_on(session: &mut Session, path: PathBuf, replace: bool) {
    if save::save(session, path, replace)
        && let Some(next) = session.files.after_save.take()
    {
        go_on(session, next);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Design, file};
    use crate::studio::acts::tick::tick;
    use crate::studio::blank;

    fn session() -> Session {
        let mut session = Session::new(blank::design(), None, Arc::new(|| ()), crate::studio::services());
        session.files.native_dialogs = true;
        session
    }

    /// The desktop's dialog is open.
    fn opened(session: &mut Session, purpose: Purpose, serial: u64) {
        session.files.picking = Some(Picking { purpose, serial, wanted: true });
    }

    fn answered(session: &mut Session) {
        session.files.granted = Some(session.design().clone());
        session.files.after_save = Some(FileAction::Quit);
    }

    fn is_taken_back(session: &Session) -> bool {
        session.files.granted.is_none() && session.files.after_save.is_none()
    }

    #[test]
    fn a_second_file_dialog_is_refused_and_the_first_stays_what_it_is() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("other.plush");
        file::write(&path, &Design { name: "other".into(), ..blank::design() }).unwrap();
        let before = std::fs::read(&path).unwrap();
        let mut session = session();
        opened(&mut session, Purpose::Open, 7);
        answered(&mut session);
        ask(&mut session, FileAction::SaveAs);
        assert!(session.messages.list().iter().any(|message| message.text.contains("open already")));
        assert!(is_taken_back(&session), "the next save would close the window");
        take_path(&mut session, 7, Some(path.clone()), false);
        assert_eq!(session.design().name, "other");
        assert!(std::fs::read(&path).unwrap() == before && session.files.picking.is_none());
    }

    #[test]
    fn an_answer_is_for_its_own_dialog_and_only_one_about_saving_saves() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("pig.plush");
        let mut session = session();
        for purpose in [Purpose::Import, Purpose::Export] {
            opened(&mut session, purpose, 1);
            take_path(&mut session, 1, Some(path.clone()), false);
        }
        // That of a dialog which nobody waits for.
        opened(&mut session, Purpose::SaveAs, 3);
        take_path(&mut session, 2, Some(path.clone()), false);
        assert!(!path.exists() && session.document.path.is_none() && session.files.picking.is_some());
        // One in the window that asks for something else is left as it is.
        opened(&mut session, Purpose::Open, 4);
        paths::show_path_dialog(&mut session, Purpose::Import);
        let dialog = session.files.dialog.clone();
        take_path(&mut session, 4, Some(path.clone()), false);
        assert_eq!(session.files.dialog, dialog);
        // One that asks for the same takes it.
        opened(&mut session, Purpose::Import, 5);
        take_path(&mut session, 5, Some(path.clone()), false);
        let taken = matches!(&session.files.dialog, Some(Dialog::Path(dialog)) if Path::new(&dialog.path) == path);
        assert!(taken && !path.exists());
        // The document that was to be saved gave way to another one.
        session.files.dialog = None;
        opened(&mut session, Purpose::SaveAs, 6);
        replace::open(&mut session, Design { name: "other".into(), ..blank::design() }, None);
        take_path(&mut session, 6, Some(path.clone()), false);
        assert!(!path.exists());
        opened(&mut session, Purpose::SaveAs, 7);
        take_path(&mut session, 7, Some(path.clone()), false);
        assert_eq!(file::read(&path).unwrap().name, "other");
    }

    #[test]
    fn what_was_answered_before_a_file_dialog_ends_with_it() {
        let mut session = session();
        opened(&mut session, Purpose::SaveAs, 1);
        answered(&mut session);
        take_path(&mut session, 1, None, false);
        assert!(is_taken_back(&session), "it was cancelled");
        // Behind it the dialog in the window goes on.
        paths::show_path_dialog(&mut session, Purpose::Open);
        opened(&mut session, Purpose::Open, 2);
        answered(&mut session);
        take_path(&mut session, 2, None, false);
        assert!(session.files.granted.is_some());
        // There are no dialogs: the window asks.
        session.files.dialog = None;
        opened(&mut session, Purpose::SaveAs, 3);
        take_path(&mut session, 3, None, true);
        assert!(session.files.after_save.is_some() && session.files.dialog.is_some());
        // They break: the window asks too.
        session.files.dialog = None;
        session.files.native_dialogs = true;
        let serial = session.jobs.start("The file dialog", |_| panic!("no portal")).serial;
        opened(&mut session, Purpose::SaveAs, serial);
        while session.files.picking.is_some() {
            tick(&mut session, 0.0, 0.0, true);
        }
        let asks = matches!(&session.files.dialog, Some(Dialog::Path(dialog)) if dialog.purpose == Purpose::SaveAs);
        assert!(asks && session.files.after_save.is_some() && !session.files.native_dialogs);
    }
}
