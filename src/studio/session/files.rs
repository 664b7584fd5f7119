//! Dialogs about files, and what is asked for by them.

use super::done::Done;
use super::import_choice::ImportChoice;
use super::import_preview::ImportPreview;
use crate::design::Design;
use crate::operations::{export, film};
use crate::studio::jobs::{New, Running};
use crate::studio::language::t;
use std::path::{Path, PathBuf};
use std::sync::Arc;

#[derive(Clone, Debug, PartialEq)]
pub enum FileAction {
    /// Asks where.
    Open,
    Import,
    /// An empty sheet.
    NewDrawing,
    SaveAs,
    Export,
    Film,
    /// To where it came from, or asks.
    Save,
    OpenPath(PathBuf),
    OpenExample(usize),
    ImportPath {
        path: PathBuf,
        choice: Box<ImportChoice>,
    },
    SavePath(PathBuf),
    ExportPath {
        folder: PathBuf,
        options: export::Options,
    },
    FilmPath {
        path: PathBuf,
        options: film::Options,
    },
    CloseDialog,
    /// Something was typed.
    EditDialog(PathDialog),
    /// Answers about unsaved changes.
    SaveAndGoOn,
    DiscardAndGoOn,
    /// A file was dropped on the window.
    Dropped(PathBuf),
    /// What was imported, where the document has been changed in the meantime.
    OpenImported,
    /// Saves there, whatever is there.
    ReplacePath(PathBuf),
    /// Answers about work that another window left behind.
    Recover,
    DiscardWork,
    RecoverLater,
    /// Opens the desktop's own dialog for the dialog that is shown.
    Browse,
    Quit,
}

/// The purpose of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    Open,
    Import,
    SaveAs,
    Export,
    Film,
}

/// A dialog over the window.
#[derive(Clone, Debug, PartialEq)]
pub enum Dialog {
    /// There are unsaved changes; what was wanted is done afterwards.
    Unsaved(Box<FileAction>),
    Path(PathDialog),
    /// Something is in the place that would be saved to.
    Replace(PathBuf, Why),
    /// Work that another window left behind is offered.
    Recover,
}

/// Why it is asked whether a file may be replaced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Why {
    /// It is another plushie.
    Exists,
    /// It is no plushie.
    Foreign,
    /// It was changed since it was read.
    Changed,
}

/// Asks for a path in the window.
#[derive(Clone, Debug, PartialEq)]
pub struct PathDialog {
    pub purpose: Purpose,
    pub path: String,
    pub import: Box<ImportChoice>,
    pub export: Box<export::Options>,
    pub film: Box<film::Options>,
    /// Why what was asked for last could not be had.
    pub trouble: Option<String>,
}

#[derive(Default)]
pub struct Files {
    pub dialog: Option<Dialog>,
    /// The work that a thread is busy with, ready to be shown.
    pub working: Option<&'static str>,
    /// Waits for saving to succeed.
    pub(crate) after_save: Option<FileAction>,
    /// The document whose changes may be dropped, as was answered.
    pub(crate) granted: Option<Arc<Design>>,
    /// How far it is, where it tells.
    pub(crate) done: Done,
    /// The job of that thread.
    pub(crate) running: Option<Running>,
    /// Waits for an answer about the document that it would replace.
    pub(crate) imported: Option<Box<New>>,
    /// The desktop's dialog that is open.
    pub(crate) picking: Option<Picking>,
    /// Whether the desktop has dialogs.
    pub native_dialogs: bool,
    /// What would be read of the outline that the dialog names.
    pub preview: ImportPreview,
    /// The window should close.
    pub quit: bool,
}

/// A dialog of the desktop's, which is open until its job is over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Picking {
    pub purpose: Purpose,
    /// Of the job that waits for its answer.
    pub serial: u64,
    /// Whether the document that it was opened for is still there.
    pub wanted: bool,
}

impl Files {
    /// Drops what was answered about the document as it is: nothing follows the next save, and what replaces the document asks again.
    pub(crate) fn take_back(&mut self) {
        self.after_save = None;
        self.granted = None;
    }

    /// Another document is in the place of the one that a dialog was opened for: it is not saved to the path of the other.
    pub(crate) fn forget_document(&mut self) {
        self.granted = None;
        if let Some(picking) = &mut self.picking {
            picking.wanted = picking.purpose != Purpose::SaveAs;
        }
    }
}

impl Purpose {
    pub fn title(self) -> &'static str {
        match self {
            Self::Open => t("Open a plushie"),
            Self::Import => t("New plushie from an outline"),
            Self::SaveAs => t("Save the plushie as"),
            Self::Export => t("Export the blueprint"),
            Self::Film => t("Export the animation"),
        }
    }

    /// The text of the button.
    pub fn verb(self) -> &'static str {
        match self {
            Self::Open => t("Open"),
            Self::Import => t("Create"),
            Self::SaveAs => t("Save"),
            Self::Export => t("Export"),
            Self::Film => t("Make the film"),
        }
    }
}

impl PathDialog {
    pub fn confirm(&self) -> FileAction {
        let path = PathBuf::from(self.path.trim());
        match self.purpose {
            Purpose::Open => FileAction::OpenPath(path),
            Purpose::Import => FileAction::ImportPath { path, choice: self.import.clone() },
            Purpose::SaveAs => FileAction::SavePath(path),
            Purpose::Film => FileAction::FilmPath { path, options: (*self.film).clone() },
            Purpose::Export => FileAction::ExportPath { folder: path, options: (*self.export).clone() },
        }
    }
}

/// Whether the desktop is likely to have dialogs: on Linux they come over the session bus.
pub fn desktop_has_dialogs() -> bool {
    let bus = || {
        std::env::var_os("DBUS_SESSION_BUS_ADDRESS").is_some()
            || std::env::var_os("XDG_RUNTIME_DIR").is_some_and(|dir| Path::new(&dir).join("bus").exists())
    };
    !cfg!(target_os = "linux") || bus()
}
