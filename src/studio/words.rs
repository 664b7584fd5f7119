//! What the core has to say, in the words of the window: its controls by name.

use crate::fabrication::ExportError;
use crate::motion::MotionError;
use crate::operations::{MoreFibers, Progress, key, new_design, play, preview, remesh, reshape, rig};
use crate::outline::{Change, Changes, Note, OutlineError, Remedy};
use crate::rigging::{self, RigError};
use crate::studio::language::{mark, t, tf, tn};

/// The choice in the dialog of the export that gives motors the time they need.
pub const STRETCH: &str = mark("Stretch what is too quick");

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
            tf!("{error}; move the keyframes apart, or choose “{choice}”", error, choice = t(STRETCH))
        }
        play::Error::NoNetworks => tf!("{error}: propose networks for a pose, or rig all poses", error),
        error => error.to_string(),
    }
}

/// What the dialog of the import has.
fn control(remedy: Remedy) -> &'static str {
    match remedy {
        Remedy::Height => t("“Height” sets another height"),
        Remedy::Unit => t("“Unit” sets another, “Height” the size"),
        Remedy::Threshold => t("“Ink from” sets another level"),
        Remedy::Opacity => t("“Ink from” 1 counts all that shows"),
        Remedy::Background => t("“Background” keeps it"),
        Remedy::DropBackground => t("“Background” leaves it out"),
        Remedy::Holes => t("“Holes” makes a solid body of it"),
        Remedy::KeepHoles => t("“Holes” keeps them"),
        Remedy::Gap => t("“Gaps up to” sets how wide they may be"),
        Remedy::Join => t("“Join ends up to” sets how far apart they may be"),
        Remedy::Smooth => t("“Smooth” sets how far"),
        Remedy::Layers => t("“Layers” names those that count"),
        Remedy::Blocks => t("“Blocks” names those that count"),
        Remedy::MinWidth => t("“Least width” widens them"),
        Remedy::Pieces => t("choose “Largest piece only”, or join them in the drawing"),
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
    tf!("The outline needs more than {asked} fibres; it has {count}.", asked, count)
}

/// Why a design was not given another body.
pub fn unshaped(error: &reshape::Error) -> String {
    match error {
        reshape::Error::Outline(OutlineError::Pieces { .. }) => {
            tf!("{error}: join them, or delete what is too much", error)
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
            t("Without networks there is nothing to animate: propose and accept one first.").to_owned()
        }
        error => tf!("Add keyframe: {error}", error),
    }
}

/// So many winches and tendons.
pub fn built(winches: usize, tendons: usize) -> String {
    let winches = tn!(winches, "{winches} winch", "{winches} winches");
    let tendons = tn!(tendons, "{tendons} tendon", "{tendons} tendons");
    format!("{winches}, {tendons}")
}

/// A step of an operation.
pub fn progress(step: &Progress) -> String {
    match step {
        Progress::Rig(rigging::Progress::Candidates { winch, count }) => {
            tf!("Winch {number}: trying {count} networks", number = winch + 1, count)
        }
        Progress::Rig(rigging::Progress::Accepted { winch, errors, .. }) => {
            let worst = errors.iter().map(|(_, error)| *error).fold(0.0, f64::max);
            tf!("Winch {number}: {percent:.1} % off at most", number = winch + 1, percent = 100.0 * worst)
        }
        Progress::Rig(rigging::Progress::Round { round, rounds, worst, .. }) => {
            tf!(
                "Round {round} of {rounds}: the worst pose misses {percent:.1} % of its way",
                round = round + 1,
                rounds,
                percent = 100.0 * worst
            )
        }
        Progress::Rig(rigging::Progress::Found { winches, tendons, .. }) => built(*winches, *tendons),
        Progress::Proposals(list) => tn!(count = list.len(), "{count} network so far", "{count} networks so far"),
        Progress::Picture { done, of } => tf!("Picture {number} of {of}", number = done + 1, of),
        Progress::Keyed { done, of } => tf!("Pose {number} of {of}", number = done + 1, of),
        Progress::Part { done, of } => tf!("Part {number} of {of}", number = done + 1, of),
    }
}

/// Why there is no rig.
pub fn unrigged(error: &rig::Error) -> String {
    match error {
        rig::Error::Rig(RigError::NoTargets) => {
            t("No pose has a target yet: drag a point of the body first.").to_owned()
        }
        rig::Error::Rig(RigError::NothingFound) => {
            t("No network brings any pose closer to its targets. Try more winches or tendons.").to_owned()
        }
        error => tf!("Rig: {error}", error),
    }
}

/// The remarks on a blueprint as one message, the first in full; `None` where there are none.
pub fn remarks(remarks: &[String]) -> Option<String> {
    /// Those that are told in full: more would cover the plushies. The README of the blueprint has them all.
    const IN_FULL: usize = 4;
    let told: Vec<String> = remarks.iter().take(IN_FULL).map(|remark| format!("\n- {remark}")).collect();
    let rest = match remarks.len().saturating_sub(IN_FULL) {
        0 => String::new(),
        more => tf!("\n{more} more are in its README.txt.", more),
    };
    (!remarks.is_empty()).then(|| tf!("Watch out with this blueprint:{remarks}{rest}", remarks = told.concat(), rest))
}

/// Why there is no blueprint.
pub fn unexported(error: &ExportError) -> String {
    match error {
        ExportError::NoNetworks => tf!("{error}: propose and accept one first", error),
        ExportError::Motion(MotionError::TooFast { .. }) => {
            tf!(
                "{error}; move the keyframes apart, or choose “{choice}” in the dialog of the export",
                error,
                choice = t(STRETCH)
            )
        }
        ExportError::WinchesCollide { .. } => {
            tf!("{error}; move one of them with the tendon tool, or take a smaller spool in the settings", error)
        }
        error => error.to_string(),
    }
}
