//! Asking for a path.

use crate::outline;
use crate::studio::jobs::Outcome;
use crate::studio::language::{mark, t};
use crate::studio::session::{Dialog, PathDialog, Picking, Purpose, Session};
use std::time::{Duration, Instant};

/// Asks with the desktop's dialog, or in the window where there is none.
pub fn ask_path(session: &mut Session, purpose: Purpose) {
    if session.files.native_dialogs { pick(session, purpose) } else { show_path_dialog(session, purpose) }
}

/// Asks in the window.
pub fn show_path_dialog(session: &mut Session, purpose: Purpose) {
    let (folder, document) = (session.document.folder(), &session.document);
    let path = match purpose {
        Purpose::Open | Purpose::Import => folder.join(""),
        Purpose::SaveAs => document.path.clone().unwrap_or_else(|| folder.join(document.file_name())),
        Purpose::Export => folder.join(document.folder_name()),
        Purpose::Film => folder.join(document.file_name()).with_extension("gif"),
    };
    session.files.dialog = Some(Dialog::Path(PathDialog {
        purpose,
        path: path.to_string_lossy().into_owned(),
        import: Box::default(),
        export: Box::default(),
        film: Box::default(),
        trouble: None,
    }));
}

/// Opens the desktop's dialog. One at a time: the answer to a second one could not be told from that to the first.
pub fn pick(session: &mut Session, purpose: Purpose) {
    /// Faster than any human.
    const AT_ONCE: Duration = Duration::from_millis(400);
    if let Some(open) = session.files.picking {
        if open.purpose != purpose || !open.wanted {
            session.files.take_back();
        }
        return session.messages.info(t("A file dialog is open already: answer or close that one first."));
    }
    let (folder, name) = (session.document.folder(), session.document.file_name());
    let running = session.jobs.start(mark("The file dialog"), move |_| {
        let started = Instant::now();
        let dialog = rfd::FileDialog::new().set_title(purpose.title()).set_directory(folder);
        let path = match purpose {
            Purpose::Open => dialog.add_filter(t("Plushies"), &["plush"]).pick_file(),
            Purpose::Import => dialog.add_filter(t("Outlines"), &outline::extensions()).pick_file(),
            Purpose::SaveAs => dialog.add_filter(t("Plushies"), &["plush"]).set_file_name(name).save_file(),
            Purpose::Export => dialog.pick_folder(),
            Purpose::Film => dialog.add_filter(t("Films"), &["gif", "html"]).save_file(),
        };
        Outcome::Picked { path, at_once: started.elapsed() < AT_ONCE }
    });
    session.files.picking = Some(Picking { purpose, serial: running.serial, wanted: true });
}
