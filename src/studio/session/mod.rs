//! The state of the window: a [`Session`] of parts, each with what can be done to it alone.

mod basis;
mod discovery;
mod document;
mod files;
mod import_choice;
mod import_preview;
mod judgement;
mod judging;
mod look;
mod meshing;
mod overlay;
mod picked;
mod playback;
mod rigging;
mod safety;
#[expect(clippy::module_inception, reason = "the state itself, beside its parts")]
mod session;
mod sketching;
mod solo;
mod solver;
mod tasks;
mod texturing;
mod winding;

pub use super::jobs::Told;
pub use discovery::Discovery;
pub use document::Document;
pub(crate) use files::Picking;
pub use files::{Dialog, FileAction, Files, PathDialog, Purpose, Why, desktop_has_dialogs};
pub use import_choice::ImportChoice;
pub use import_preview::ImportPreview;
pub use judgement::Judgement;
pub use judging::{Judging, PoseError};
pub use look::{Look, Views};
pub use meshing::{FINEST, Meshing, Resolution};
pub use overlay::{Overlay, Renamed};
pub use picked::{Mode, Picked, Selection};
pub use playback::Playback;
pub use rigging::{Curve, RigChoice, Rigging};
pub use safety::Safety;
pub use session::{Export, Propose, Services, Session};
pub use sketching::{FREEHAND, Sketching};
pub use solo::Solo;
pub use solver::{Shapes, Solver};
pub use tasks::{Task, Tasks};
pub use texturing::{Found, Texturing};
pub use winding::Winding;
