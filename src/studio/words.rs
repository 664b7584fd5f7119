//! What the core has to say, in the words of the window: its controls by name.

use crate::fabrication::ExportError;
use crate::motion::MotionError;
use crate::operations::{MoreFibers, Progress, key, new_design, play, preview, remesh, reshape, rig};
use crate::outline::{Change, Changes, Note, OutlineError, Remedy};
use crate::rigging::{self, RigError};

/// The choice in the dialog of the export that gives motors the time they need.
pub const STRETCH: &str = "Stretch what is too quick";

/// The steps and notes of a clean-up, a line each.
pub fn changes(changes: &Changes) -> impl Iterator<Item = String> {
    changes.steps.iter().map(Change::line).chain(changes.notes.iter().map(note))
}

/// A note of a reader or the clean-up, and the control that would have it otherwise.
pub fn note(note: &Note) -> String {
    note.remedy().map_or_else(|| note.to_string(), |remedy| format!("{note}; {}", control(remedy)))
}

/// Why a file gave no outline, and the control that may help.
pub fn outline(error: &OutlineError) -> String {
    error.remedy().map_or_else(|| error.to_string(), |remedy| format!("{error}; {}", control(remedy)))
}

/// Why motors do not play.
pub fn unplayed(error: &play::Error) -> String {
    match error {
        play::Error::Motion(MotionError::TooFast { .. }) => {
            format!("{error}; move the keyframes apart, or choose “{STRETCH}”")
        }
        play::Error::NoNetworks => format!("{error}: propose networks for a pose, or rig all poses"),
        error => error.to_string(),
    }
}

/// What the dialog of the import has.
fn control(remedy: Remedy) -> &'static str {
    match remedy {
        Remedy::Height => "“Height” sets another height",
        Remedy::Unit => "“Unit” sets another, “Height” the size",
        Remedy::Threshold => "“Ink from” sets another level",
        Remedy::Opacity => "“Ink from” 1 counts all that shows",
        Remedy::Background => "“Background” keeps it",
        Remedy::DropBackground => "“Background” leaves it out",
        Remedy::Holes => "“Holes” makes a solid body of it",
        Remedy::KeepHoles => "“Holes” keeps them",
        Remedy::Gap => "“Gaps up to” sets how wide they may be",
        Remedy::Join => "“Join ends up to” sets how far apart they may be",
        Remedy::Smooth => "“Smooth” sets how far",
        Remedy::Layers => "“Layers” names those that count",
        Remedy::Blocks => "“Blocks” names those that count",
        Remedy::MinWidth => "“Least width” widens them",
        Remedy::Pieces => "choose “Largest piece only”, or join them in the drawing",
    }
}

/// Why an outline made no design.
pub fn unmade(error: &new_design::Error) -> String {
    match error {
        new_design::Error::Outline(error) => outline(error),
        new_design::Error::Mesh(_) | new_design::Error::Cancelled(_) => error.to_string(),
    }
}

/// Why it cannot be shown what would be read of a file.
pub fn unshown(error: &preview::Error) -> String {
    match error {
        preview::Error::Outline(error) => outline(error),
        preview::Error::Picture(_) | preview::Error::Cancelled(_) => error.to_string(),
    }
}

/// Fibres besides those asked for, of an import or of a new body.
pub fn more_fibers(MoreFibers { asked, count }: MoreFibers) -> String {
    format!("The outline needs more than {asked} fibres; it has {count}.")
}

/// Why a design was not given another body.
pub fn unshaped(error: &reshape::Error) -> String {
    match error {
        reshape::Error::Outline(OutlineError::Pieces { .. }) => {
            format!("{error}: join them, or delete what is too much")
        }
        reshape::Error::Outline(_)
        | reshape::Error::Mesh(_)
        | reshape::Error::Edit(_)
        | reshape::Error::Cancelled(_) => error.to_string(),
    }
}

/// Why there is no other mesh.
pub fn unmeshed(error: &remesh::Error) -> String {
    error.to_string()
}

/// Why there is no keyframe.
pub fn unkeyed(error: &key::Error) -> String {
    match error {
        key::Error::NoNetworks => {
            "Without networks there is nothing to animate: propose and accept one first.".to_owned()
        }
        error => format!("Add keyframe: {error}"),
    }
}

/// A step of an operation.
pub fn progress(step: &Progress) -> String {
    match step {
        Progress::Rig(rigging::Progress::Candidates { winch, count }) => {
            format!("Winch {}: trying {count} networks", winch + 1)
        }
        Progress::Rig(rigging::Progress::Accepted { winch, errors, .. }) => {
            let worst = errors.iter().map(|(_, error)| *error).fold(0.0, f64::max);
            format!("Winch {}: {:.1} % off at most", winch + 1, 100.0 * worst)
        }
        Progress::Rig(rigging::Progress::Round { round, rounds, worst, .. }) => {
            format!("Round {} of {rounds}: the worst pose misses {:.1} % of its way", round + 1, 100.0 * worst)
        }
        Progress::Rig(rigging::Progress::Found { winches, tendons, .. }) => {
            format!("{winches} winches with {tendons} tendons")
        }
        Progress::Proposals(list) => format!("{} networks so far", list.len()),
        Progress::Picture { done, of } => format!("Picture {} of {of}", done + 1),
        Progress::Part { done, of } => format!("Part {} of {of}", done + 1),
    }
}

/// Why there is no rig.
pub fn unrigged(error: &rig::Error) -> String {
    match error {
        rig::Error::Rig(RigError::NoTargets) => "No pose has a target yet: drag a point of the body first.".to_owned(),
        rig::Error::Rig(RigError::NothingFound) => {
            "No network brings any pose closer to its targets. Try more winches or tendons.".to_owned()
        }
        error => format!("Rig: {error}"),
    }
}

/// The remarks on a blueprint as one message, the first in full; `None` where there are none.
pub fn remarks(remarks: &[String]) -> Option<String> {
    /// Those that are told in full: more would cover the plushies. The README of the blueprint has them all.
    const IN_FULL: usize = 4;
    let told: Vec<String> = remarks.iter().take(IN_FULL).map(|remark| format!("\n- {remark}")).collect();
    let rest = match remarks.len().saturating_sub(IN_FULL) {
        0 => String::new(),
        more => format!("\n{more} more are in its README.txt."),
    };
    (!remarks.is_empty()).then(|| format!("Mind of the blueprint:{}{rest}", told.concat()))
}

/// Why there is no blueprint.
pub fn unexported(error: &ExportError) -> String {
    match error {
        ExportError::NoNetworks => format!("{error}: propose and accept one first"),
        ExportError::Motion(MotionError::TooFast { .. }) => {
            format!("{error}; move the keyframes apart, or choose “{STRETCH}” in the dialog of the export")
        }
        ExportError::WinchesCollide { .. } => {
            format!("{error}; move one of them with the tendon tool, or take a smaller spool in the settings")
        }
        error => error.to_string(),
    }
}
