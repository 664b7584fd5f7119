//! Opening, importing, saving and exporting.
//!
//! Paths are asked for with the desktop's own dialogs, on a thread. Where there are none (a bare X server, a test) a
//! field in the window takes their place.

use super::action::FileAction;
use super::importing::ImportChoice;
use super::jobs::{New, Outcome, Running};
use super::meshing::Resolution;
use super::session::Session;
use super::sketching::{self, Sketch};
use crate::defaults;
use crate::design::{Design, FileError, bundled, file};
use crate::files;
use crate::outline;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What a path is wanted for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    Open,
    Import,
    SaveAs,
    Export,
}

/// What stands over the window.
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
    pub import: ImportChoice,
    /// Why what was asked for last could not be had.
    pub trouble: Option<String>,
}

#[derive(Default)]
pub struct Files {
    pub dialog: Option<Dialog>,
    /// What a thread is busy with, ready to be shown.
    pub working: Option<&'static str>,
    /// Waits for saving to succeed.
    after_save: Option<FileAction>,
    /// The document whose changes may be dropped, as was answered.
    pub(super) granted: Option<Arc<Design>>,
    /// What that thread is at.
    pub(super) running: Option<Running>,
    /// Waits for an answer about the document that it would replace.
    pub(super) imported: Option<Box<New>>,
    /// The path that the desktop's dialog was opened for.
    picking: Option<Purpose>,
    /// Whether the desktop has dialogs.
    pub native_dialogs: bool,
    /// The window should close.
    pub quit: bool,
}

impl Purpose {
    pub fn title(self) -> &'static str {
        match self {
            Self::Open => "Open a plushie",
            Self::Import => "New plushie from an outline",
            Self::SaveAs => "Save the plushie as",
            Self::Export => "Export the blueprint",
        }
    }

    /// What the button says.
    pub fn verb(self) -> &'static str {
        match self {
            Self::Open => "Open",
            Self::Import => "Create",
            Self::SaveAs => "Save",
            Self::Export => "Export",
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
            Purpose::Export => FileAction::ExportPath(path),
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

impl Session {
    pub(super) fn file(&mut self, action: FileAction) {
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
            && self.files.granted.as_ref().is_some_and(|granted| Arc::ptr_eq(granted, self.design()));
        if replaces && !granted && self.history.is_modified() {
            self.files.after_save = None;
            self.files.dialog = Some(Dialog::Unsaved(Box::new(action)));
            return;
        }
        self.file_unguarded(action);
    }

    fn file_unguarded(&mut self, action: FileAction) {
        match action {
            FileAction::Open => self.ask_path(Purpose::Open),
            FileAction::Import => self.show_path_dialog(Purpose::Import),
            FileAction::NewDrawing => {
                self.open(sketching::sheet(), None);
                self.sketching.fresh = true;
                self.meshing.wanted = Some(Resolution { fibers: defaults::FIBERS, finer: 1 });
                self.sketch(Sketch::Open(true));
                self.tools[1] = sketching::FREEHAND;
            }
            FileAction::SaveAs => self.ask_path(Purpose::SaveAs),
            FileAction::Export if self.design().networks.is_empty() => {
                self.messages.warning("There is nothing to export yet: propose and accept a network first.");
            }
            FileAction::Export => self.show_path_dialog(Purpose::Export),
            FileAction::Save => match self.path.clone() {
                Some(path) => self.save(path, false),
                None => self.ask_path(Purpose::SaveAs),
            },
            FileAction::OpenPath(path) => self.open_path(path),
            FileAction::OpenExample(index) => self.open_example(index),
            FileAction::ImportPath { path, choice } => self.import(path, choice),
            FileAction::Dropped(path) if self.files.dialog.is_some() => {
                let path = files::shown(&path);
                self.messages.warning(format!("{path} was not opened: answer the dialog first."));
            }
            FileAction::Dropped(path) => self.file(FileAction::OpenPath(path)),
            FileAction::OpenImported => self.open_imported(),
            FileAction::SavePath(path) => self.save(path, false),
            FileAction::ReplacePath(path) => self.save(path, true),
            FileAction::Recover => self.recover(),
            FileAction::DiscardWork => self.discard_work(),
            FileAction::RecoverLater => self.recover_later(),
            FileAction::ExportPath(folder) => self.export(folder),
            FileAction::CloseDialog if self.files.dialog == Some(Dialog::Recover) => self.recover_later(),
            FileAction::CloseDialog => {
                self.files.dialog = None;
                self.files.after_save = None;
                self.files.granted = None;
                self.files.imported = None;
            }
            FileAction::EditDialog(dialog) => self.files.dialog = Some(Dialog::Path(dialog)),
            FileAction::SaveAndGoOn => {
                if let Some(Dialog::Unsaved(next)) = self.files.dialog.take() {
                    self.files.after_save = Some(*next);
                    self.file_unguarded(FileAction::Save);
                }
            }
            FileAction::DiscardAndGoOn => {
                if let Some(Dialog::Unsaved(next)) = self.files.dialog.take() {
                    self.files.granted = Some(self.design().clone());
                    self.file_unguarded(*next);
                }
            }
            FileAction::Browse => {
                if let Some(Dialog::Path(dialog)) = &self.files.dialog {
                    self.pick(dialog.purpose);
                }
            }
            FileAction::Quit => self.quit(),
        }
    }

    pub(super) fn take_path(&mut self, path: Option<PathBuf>, at_once: bool) {
        let Some(purpose) = self.files.picking.take() else { return };
        match (path, self.files.dialog.clone()) {
            (Some(path), Some(Dialog::Path(dialog))) => {
                let path = if purpose == Purpose::Export { path.join(self.folder_name()) } else { path };
                let path = path.to_string_lossy().into_owned();
                self.files.dialog = Some(Dialog::Path(PathDialog { path, trouble: None, ..dialog }));
            }
            (Some(path), _) if purpose == Purpose::Open => self.file(FileAction::Dropped(path)),
            // The desktop has asked about a plushie that would be replaced.
            (Some(path), _) => {
                let asked = path.extension().is_some() && file::is_design(&path);
                self.save(path, asked);
            }
            // Nobody cancels that fast: there was no dialog.
            (None, _) if at_once => {
                self.files.native_dialogs = false;
                if self.files.dialog.is_none() {
                    self.show_path_dialog(purpose);
                } else {
                    self.messages.info("This desktop has no file dialogs; type the path instead.");
                }
            }
            (None, _) => {}
        }
    }

    pub(super) fn take_export(&mut self, folder: &Path, result: Result<(), String>) {
        self.files.working = None;
        match result {
            Ok(()) => self.messages.info(format!("The blueprint is in {}", files::shown(folder))),
            Err(why) => self.messages.error(format!("The export failed: {why}")),
        }
    }

    fn ask_path(&mut self, purpose: Purpose) {
        if self.files.native_dialogs { self.pick(purpose) } else { self.show_path_dialog(purpose) }
    }

    fn show_path_dialog(&mut self, purpose: Purpose) {
        let folder = self.folder();
        let path = match purpose {
            Purpose::Open | Purpose::Import => folder.join(""),
            Purpose::SaveAs => self.path.clone().unwrap_or_else(|| folder.join(self.file_name())),
            Purpose::Export => folder.join(self.folder_name()),
        };
        self.files.dialog = Some(Dialog::Path(PathDialog {
            purpose,
            path: path.to_string_lossy().into_owned(),
            import: ImportChoice::default(),
            trouble: None,
        }));
    }

    /// Opens the desktop's dialog.
    fn pick(&mut self, purpose: Purpose) {
        /// Faster than any human.
        const AT_ONCE: Duration = Duration::from_millis(400);
        if self.files.picking.replace(purpose).is_some() {
            return;
        }
        let (folder, name) = (self.folder(), self.file_name());
        self.jobs.start("The file dialog", move |_| {
            let started = Instant::now();
            let dialog = rfd::FileDialog::new().set_title(purpose.title()).set_directory(folder);
            let path = match purpose {
                Purpose::Open => dialog.add_filter("Plushies", &["plush"]).pick_file(),
                Purpose::Import => dialog.add_filter("Outlines", &outline::extensions()).pick_file(),
                Purpose::SaveAs => dialog.add_filter("Plushies", &["plush"]).set_file_name(name).save_file(),
                Purpose::Export => dialog.pick_folder(),
            };
            Outcome::Picked { path, at_once: started.elapsed() < AT_ONCE }
        });
    }

    fn open_path(&mut self, path: PathBuf) {
        if outline::extensions().iter().any(|known| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(known))) {
            self.show_path_dialog(Purpose::Import);
            if let Some(Dialog::Path(dialog)) = &mut self.files.dialog {
                dialog.path = path.to_string_lossy().into_owned();
            }
            return;
        }
        match file::read_stamped(&path) {
            Ok((design, seen)) => {
                self.files.dialog = None;
                self.open(design, Some(path.clone()));
                self.safety.seen = Some(seen);
                self.opened(&path);
            }
            Err(error) => self.messages.error(error.to_string()),
        }
    }

    fn open_example(&mut self, index: usize) {
        let Some(example) = bundled::ALL.get(index) else { return };
        match example.design() {
            Ok(design) => self.open(design, None),
            Err(error) => self.messages.error(format!("{}: {error}", example.name)),
        }
    }

    /// Saves the document. What is not the document's own file, or is not what was read any more, is asked about, unless the answer was
    /// to `replace` it.
    fn save(&mut self, path: PathBuf, replace: bool) {
        let path = if path.extension().is_none() { path.with_extension("plush") } else { path };
        let own = self.path.as_deref().is_some_and(|own| own == path || files::same(own, &path));
        let found = std::fs::metadata(&path);
        if found.as_ref().is_ok_and(|found| !found.is_file() && !found.is_dir()) {
            // A pipe or a device keeps nothing: it would count as saved.
            self.files.after_save = None;
            self.messages.error(format!("{} is not a regular file; nothing would be kept there", files::shown(&path)));
            return;
        }
        let there = found.is_ok_and(|found| found.is_file() && found.len() > 0);
        if there && !own && !replace {
            let why = if file::is_design(&path) { Why::Exists } else { Why::Foreign };
            self.files.dialog = Some(Dialog::Replace(path, why));
            return;
        }
        let seen = self.safety.seen.filter(|_| own && !replace);
        let saved = Self::hold(&path).map_err(|source| FileError::Write { path: path.clone(), source });
        let saved = saved.and_then(|_held| file::save(self.design(), self.origin.as_deref(), &path, seen.as_ref()));
        match saved {
            Ok(seen) => {
                self.history.mark_saved();
                self.messages.info(format!("Saved {}", files::shown(&path)));
                self.opened(&path);
                self.safety.seen = Some(seen);
                self.path = Some(path);
                self.files.dialog = None;
                if let Some(next) = self.files.after_save.take() {
                    self.file_unguarded(next);
                }
            }
            Err(FileError::Changed { path }) => self.files.dialog = Some(Dialog::Replace(path, Why::Changed)),
            Err(error) => {
                // What was to follow a success does not follow another one.
                self.files.after_save = None;
                self.messages.error(error.to_string());
            }
        }
    }

    fn export(&mut self, folder: PathBuf) {
        self.files.dialog = None;
        self.files.working = Some("Exporting the blueprint");
        let (design, export) = (self.design().clone(), self.services.export.clone());
        self.files.running = Some(self.jobs.start("Export", move |_| {
            let result = export(&design, &folder);
            Outcome::Exported { folder, result }
        }));
    }

    /// Where files of this plushie are likely to be.
    fn folder(&self) -> PathBuf {
        let beside = self.path.as_deref().and_then(Path::parent).map(Path::to_path_buf);
        beside.filter(|p| !p.as_os_str().is_empty()).or_else(|| std::env::current_dir().ok()).unwrap_or_default()
    }

    fn file_name(&self) -> String {
        format!("{}.plush", plain(&self.design().name))
    }

    fn folder_name(&self) -> String {
        format!("{}-blueprint", plain(&self.design().name))
    }
}

/// A name that every file system takes.
fn plain(name: &str) -> String {
    let name: String = name.trim().chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
    if name.is_empty() { "plushie".to_owned() } else { name.to_lowercase() }
}
