//! Every use case once: what the command line and the window both do, without a word of either.
//!
//! | operation | from, to |
//! | --- | --- |
//! | [`new_design`] | the bytes of an outline to a meshed design |
//! | [`preview`] | the bytes of an outline to a picture of what would be read |
//! | [`remesh`] | a design to the same one at another resolution |
//! | [`reshape`] | a design and another outline to the design with that body |
//! | [`pose`] | places of the body to pins, and to targets of a pose |
//! | [`arrange`] | targets and pins to the same ones moved, turned, scaled, weighed or mirrored together |
//! | [`starch`] | a place of the body to a stiffer or softer patch |
//! | [`network`] | places and numbers to winches and tendons that are changed |
//! | [`propose`] | a pose to networks that reach it, the best first |
//! | [`rig`] | all poses to networks, and to a timeline where there is none |
//! | [`explore`] | all poses to the curve of their error against winches and tendons |
//! | [`key`] | a pose to a keyframe of winch activations |
//! | [`retime`] | a timeline to one at other times: moved, stretched, copied, or as slow as the motors need |
//! | [`film`] | an animation to a GIF, numbered pictures, or a page that plays it |
//! | [`check`] | a design to its figures |
//! | [`export`] | a design to the folder of its blueprint |
//! | [`play`] | a design to motors that play its animation |
//! | [`render`] | a design to a picture of both plushies |
//!
//! An operation has `Options` (with a default, and readable from a file), runs under a [`Context`], and fails with an `Error` of its own.
//! What its caller should know comes back as `Note`s. Both are data: their texts say what happened, and which option of which front end
//! would help is for that front end to say.
//!
//! An operation that takes long has two halves, for a window in which the design goes on changing: `prepare` works out what is to be
//! put in, and that is put into the design, as it is by then, by `apply`. [`run`](remesh::run) does both.

//!
//! ```
//! use plushwright::operations::{Context, FiberCount, new_design, remesh};
//! use plushwright::mesh::Size;
//! use std::sync::atomic::AtomicBool;
//!
//! let svg = br#"<svg xmlns="http://www.w3.org/2000/svg" width="120mm" height="40mm"><rect width="120mm" height="40mm"/></svg>"#;
//! let cancel = AtomicBool::new(false);
//! let context = Context::new(&cancel);
//! let options = new_design::Options { name: "bar".into(), fibers: FiberCount::AtLeast(60), ..Default::default() };
//! let mut design = new_design::run(svg, &options, &context)?.design;
//! assert!((design.body_length_mm() - 120.0).abs() < 0.01);
//! let report = remesh::run(&mut design, &remesh::Options { size: Size::EdgeMm(10.0), ..Default::default() }, &context)?;
//! assert!(report.fibers[1] > report.fibers[0]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod arrange;
pub mod check;
mod context;
pub mod explore;
pub mod export;
mod fibers;
pub mod film;
pub mod key;
pub mod network;
pub mod new_design;
pub mod play;
pub mod pose;
mod posing;
pub mod preview;
pub mod propose;
pub mod remesh;
pub mod render;
pub mod reshape;
pub mod retime;
pub mod rig;
pub mod starch;

pub use context::{Cancelled, Context, Progress};
pub use fibers::{FiberCount, MoreFibers};
pub use posing::{NoSuchPose, Unbalanced, View};

use crate::design::Design;
use crate::design::edit::EditError;

/// Changes a design, unless that is refused or what comes of it is unsound.
fn changed<T>(design: &mut Design, change: impl FnOnce(&mut Design) -> Result<T, EditError>) -> Result<T, EditError> {
    let mut changed = design.clone();
    let outcome = change(&mut changed)?;
    changed.validate()?;
    *design = changed;
    Ok(outcome)
}
