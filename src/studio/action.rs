//! What panels and viewports ask for. They borrow the session, read only, and return these; the session alone acts.

use super::canvas::{Camera, Hit};
use super::change::Change;
use super::commands::Command;
use super::files::PathDialog;
use super::importing::ImportChoice;
use super::meshing::Resolution;
use super::rigging::RigChoice;
use super::session::{Overlay, Renamed, Selection};
use super::sketching::Sketch;
use crate::discovery::Parameters;
use crate::engine::Quality;
use crate::outline::Point;
use crate::picture::Stage;
use std::path::PathBuf;

/// Wanted, in the order in which it was asked for.
pub type Actions = Vec<Action>;

#[derive(Clone, Debug, PartialEq)]
pub enum Action {
    /// One undo step.
    Change(Change),
    /// Part of a gesture (a slider, a dragged keyframe): one undo step when the hand is off the controls.
    Live(Change),
    /// A command, and what it is about.
    Run(&'static Command, Hit),
    /// What stands over the window instead of what did.
    Overlay(Option<Overlay>),
    /// A name that is being typed.
    Typed(Option<(Renamed, String)>),
    /// Moves the target that is selected, mm; part of a gesture.
    DragTarget(Point),
    SelectPose(Option<usize>),
    Select(Selection),
    SetQuality(Quality),
    SetCamera(Camera),
    Scrub(f64),
    SetParameters(Parameters),
    SetResolution(Resolution),
    SetRig(RigChoice),
    ShowProposal(Option<usize>),
    ShowStage(Stage),
    /// Of the outline.
    Sketch(Sketch),
    File(FileAction),
    DismissMessage(u64),
}

#[derive(Clone, Debug, PartialEq)]
pub enum FileAction {
    /// Asks where.
    Open,
    Import,
    /// An empty sheet.
    NewDrawing,
    SaveAs,
    Export,
    /// To where it came from, or asks.
    Save,
    OpenPath(PathBuf),
    OpenExample(usize),
    ImportPath {
        path: PathBuf,
        choice: ImportChoice,
    },
    SavePath(PathBuf),
    ExportPath(PathBuf),
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
