//! Opening, importing, saving and exporting, and what is asked about before.
//!
//! Paths are asked for with the desktop's own dialogs, on a thread. Where there are none (a bare X server, a test) a field in the window
//! takes their place.

use super::{import, keep, open, paths, replace, save, sheet};
use crate::defaults;
use crate::design::file::is_design;
use crate::files;
use crate::studio::action::Sketch;
use crate::studio::jobs::{New, Outcome, Refused};
use crate::studio::session::{Dialog, FREEHAND, FileAction, PathDialog, Purpose, Resolution, Session};
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
            | FileAction::Quit
    );
    // An answer is about the document as it was then. Whatever dialog is open, the end of all work is asked about.
    let granted = action != FileAction::Quit
        && session.files.granted.as_ref().is_some_and(|granted| Arc::ptr_eq(granted, session.design()));
    if replaces && !granted && session.document.history.is_modified() {
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
            session.messages.warning("There is nothing to export yet: propose and accept a network first.");
        }
        FileAction::Export => paths::show_path_dialog(session, Purpose::Export),
        FileAction::Save => match session.document.path.clone() {
            Some(path) => save_and_go_on(session, path, false),
            None => paths::ask_path(session, Purpose::SaveAs),
        },
        FileAction::OpenPath(path) => open::open_path(session, path),
        FileAction::OpenExample(index) => open::open_example(session, index),
        FileAction::ImportPath { path, choice } => import::import(session, path, choice),
        FileAction::Dropped(path) if session.files.dialog.is_some() => {
            let path = files::shown(&path);
            session.messages.warning(format!("{path} was not opened: answer the dialog first."));
        }
        FileAction::Dropped(path) => ask(session, FileAction::OpenPath(path)),
        FileAction::OpenImported => import::open_imported(session),
        FileAction::SavePath(path) => save_and_go_on(session, path, false),
        FileAction::ReplacePath(path) => save_and_go_on(session, path, true),
        FileAction::Recover => keep::recover(session),
        FileAction::DiscardWork => keep::discard_work(session),
        FileAction::RecoverLater => keep::recover_later(session),
        FileAction::ExportPath(folder) => export(session, folder),
        FileAction::CloseDialog if session.files.dialog == Some(Dialog::Recover) => keep::recover_later(session),
        FileAction::CloseDialog => {
            session.files.dialog = None;
            session.files.after_save = None;
            session.files.granted = None;
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
pub fn take_path(session: &mut Session, path: Option<PathBuf>, at_once: bool) {
    let Some(purpose) = session.files.picking.take() else { return };
    match (path, session.files.dialog.clone()) {
        (Some(path), Some(Dialog::Path(dialog))) => {
            let path = if purpose == Purpose::Export { path.join(session.document.folder_name()) } else { path };
            let path = path.to_string_lossy().into_owned();
            session.files.dialog = Some(Dialog::Path(PathDialog { path, trouble: None, ..dialog }));
        }
        (Some(path), _) if purpose == Purpose::Open => ask(session, FileAction::Dropped(path)),
        // The desktop has asked about a plushie that would be replaced.
        (Some(path), _) => {
            let asked = path.extension().is_some() && is_design(&path);
            save_and_go_on(session, path, asked);
        }
        // Nobody cancels that fast: there was no dialog.
        (None, _) if at_once => {
            session.files.native_dialogs = false;
            if session.files.dialog.is_none() {
                paths::show_path_dialog(session, purpose);
            } else {
                session.messages.info("This desktop has no file dialogs; type the path instead.");
            }
        }
        (None, _) => {}
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

pub fn take_export(session: &mut Session, folder: &Path, result: Result<(), String>) {
    match result {
        Ok(()) => session.messages.info(format!("The blueprint is in {}", files::shown(folder))),
        Err(why) => session.messages.error(format!("The export failed: {why}")),
    }
}

fn export(session: &mut Session, folder: PathBuf) {
    session.files.dialog = None;
    session.files.working = Some("Exporting the blueprint");
    let (design, export) = (session.design().clone(), session.services.export.clone());
    session.files.running = Some(session.jobs.start("Export", move |_| {
        let result = export(&design, &folder);
        Outcome::Exported { folder, result }
    }));
}

/// Saves, and does what waited for that.
fn save_and_go_on(session: &mut Session, path: PathBuf, replace: bool) {
    if save::save(session, path, replace)
        && let Some(next) = session.files.after_save.take()
    {
        go_on(session, next);
    }
}
