//! What the core has to say, in the words of the command line: its options by name.

use super::error::CommandError;
use super::meant;
use super::output::refused_folder;
use crate::defaults;
use crate::design::Design;
use crate::fabrication::ExportError;
use crate::files::shown;
use crate::motion::MotionError;
use crate::operations::explore::Point;
use crate::operations::{NoSuchPose, Progress, Unbalanced, key, new_design, preview, reshape};
use crate::outline::{Change, Changes, Note, OutlineError, Remedy};
use crate::rigging;
use serde::Serialize;
use std::path::Path;

/// Why an outline made no design.
pub fn unmade(path: &Path, error: new_design::Error) -> CommandError {
    match error {
        new_design::Error::Outline(error) => unread(path, &error),
        new_design::Error::Mesh(error) => CommandError::input(path, error),
        new_design::Error::Cancelled(_) => CommandError::Cancelled,
    }
}

/// Why there is no preview of an outline.
pub fn unshown(path: &Path, error: preview::Error) -> CommandError {
    match error {
        preview::Error::Outline(error) => CommandError::input(path, outline(&error)),
        preview::Error::Picture(error) => CommandError::Failed(error.to_string()),
        preview::Error::Cancelled(_) => CommandError::Cancelled,
    }
}

/// Why a design was not given another silhouette.
pub fn unshaped(design: &Path, path: &Path, error: reshape::Error) -> CommandError {
    match error {
        reshape::Error::Outline(error) => unread(path, &error),
        reshape::Error::Mesh(error) => CommandError::input(path, error),
        reshape::Error::Edit(error) => CommandError::input(design, error),
        reshape::Error::Cancelled(_) => CommandError::Cancelled,
    }
}

/// Why a file gave no outline, and what is called alike where there is none.
fn unread(path: &Path, error: &OutlineError) -> CommandError {
    match meant::like(path) {
        Some(advice) => CommandError::input(path, format!("{}; {advice}", outline(error))),
        None => CommandError::input(path, outline(error)),
    }
}

/// A pose that a design does not have, and the one that may be meant.
pub fn no_such_pose(error: &NoSuchPose) -> CommandError {
    let NoSuchPose { name, known } = error;
    if known.is_empty() {
        let advice = "the design has none yet; `plushwright pose` makes one";
        return CommandError::Usage(format!("no pose `{name}`; {advice}"));
    }
    CommandError::Usage(match meant::closest(name, known.iter().map(String::as_str)) {
        Some(pose) => format!("{error}; did you mean `{pose}`?"),
        None => error.to_string(),
    })
}

/// Why there is no blueprint of a design.
pub fn unexported(design: &Path, error: ExportError) -> CommandError {
    match error {
        ExportError::Folder(error) => refused_folder(error),
        ExportError::Motion(error) => unplanned(design, &error),
        ExportError::WinchesCollide { .. } => CommandError::input(
            design,
            format!(
                "{error}; move one of them (`plushwright network move`) or take a smaller spool (fabrication.spool_radius_mm)"
            ),
        ),
        ExportError::NoNetworks => CommandError::input(design, format!("{error}; run `plushwright rig` first")),
        ExportError::AllOff => {
            CommandError::input(design, format!("{error}; `plushwright network unmute` switches one on"))
        }
        error => CommandError::input(design, error),
    }
}

/// Why motors cannot be told the animation of a design.
pub fn unplanned(design: &Path, error: &MotionError) -> CommandError {
    match error {
        MotionError::TooFast { .. } => {
            CommandError::input(design, format!("{error}; move the keyframes apart, or use --stretch"))
        }
        MotionError::NoSuchFamily { .. } => CommandError::Usage(error.to_string()),
        error => CommandError::input(design, error),
    }
}

/// For the end of a command, when what was found is written.
///
/// # Errors
/// A plushie did not come to equilibrium.
pub fn balanced<'a>(unbalanced: impl IntoIterator<Item = &'a Unbalanced>) -> Result<(), CommandError> {
    let told: Vec<String> = unbalanced.into_iter().map(Unbalanced::to_string).collect();
    if told.is_empty() { Ok(()) } else { Err(CommandError::NotConverged(told.join("; "))) }
}

/// What is to be done where keyframes of poses wind what they did for the winches, the body or the targets that were there.
pub fn outdated(before: &Design, now: &Design, path: &Path) -> Option<String> {
    let poses = key::outdated(before, now);
    let again = format!("`plushwright key {} --again` works them out", shown(path));
    (!poses.is_empty()).then(|| format!("keyframes of {} wind what they did before: {again}", poses.join(", ")))
}

/// So many of something.
pub fn count(count: usize, one: &str, several: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { several })
}

/// So many winches and tendons.
pub fn built(winches: usize, tendons: usize) -> String {
    format!("{}, {}", count(winches, "winch", "winches"), count(tendons, "tendon", "tendons"))
}

/// One line about a step of an operation.
pub fn progress(step: &Progress) -> String {
    match step {
        Progress::Rig(rigging::Progress::Candidates { winch, count }) => {
            format!("winch {}: {}", winch + 1, self::count(*count, "candidate network", "candidate networks"))
        }
        Progress::Rig(rigging::Progress::Accepted { winch, tendons, errors }) => {
            let errors: Vec<String> =
                errors.iter().map(|(name, error)| format!("{name} {:.1} %", 100.0 * error)).collect();
            format!("winch {}: {}; {}", winch + 1, count(*tendons, "tendon", "tendons"), errors.join(", "))
        }
        Progress::Rig(rigging::Progress::Round { round, rounds, worst, holes }) => {
            format!(
                "round {} of {rounds}: worst pose {:.1} % of its error at rest, {}",
                round + 1,
                100.0 * worst,
                count(*holes, "hole", "holes")
            )
        }
        Progress::Rig(rigging::Progress::Found { winches, tendons, errors, sewn }) => {
            let by_hand = errors.iter().zip(sewn).map(|((name, _), sewn)| {
                format!("{name} {:.2} % ({:.2} % at worst)", 100.0 * sewn.median, 100.0 * sewn.worst)
            });
            let by_hand: Vec<String> = by_hand.collect();
            let errors: Vec<String> =
                errors.iter().map(|(name, error)| format!("{name} {:.2} %", 100.0 * error)).collect();
            let found = format!("{}; {}", built(*winches, *tendons), errors.join(", "));
            if by_hand.is_empty() {
                return found;
            }
            format!("{found}\nsewn by hand, holes {} mm off: {}", defaults::SEWN_HOLE_MM, by_hand.join(", "))
        }
        Progress::Proposals(list) => format!("{} so far", count(list.len(), "network", "networks")),
        Progress::Picture { done, of } => format!("picture {} of {of}", done + 1),
        Progress::Keyed { done, of } => format!("pose {} of {of}", done + 1),
        Progress::Part { done, of } => format!("part {} of {of}", done + 1),
    }
}

/// One line about a point of the curve.
pub fn explored(point: &Point) -> String {
    let Point { winches, tendons, takes, worst, .. } = point;
    let [taken, in_all] = takes;
    format!(
        "up to {} of {}: worst pose {:.1} % of its error at rest, with {}",
        count(*winches, "winch", "winches"),
        count(*tendons, "tendon", "tendons"),
        100.0 * worst,
        built(*taken, *in_all)
    )
}

/// A note of a reader or the clean-up, and the option that would have it otherwise.
fn note(note: &Note) -> String {
    match note.remedy() {
        Some(remedy) => format!("{note} ({})", option(remedy)),
        None => note.to_string(),
    }
}

/// A step of the clean-up, likewise. Its line ends in brackets of its own.
fn step(step: &Change) -> String {
    step.remedy().map_or_else(|| step.line(), |remedy| format!("{}; {}", step.line(), option(remedy)))
}

/// Why there is no outline, and the option that may help.
fn outline(error: &OutlineError) -> String {
    error.remedy().map_or_else(|| error.to_string(), |remedy| format!("{error}; {}", option(remedy)))
}

fn option(remedy: Remedy) -> &'static str {
    match remedy {
        Remedy::Height => "--height sets another height",
        Remedy::Unit => "--unit sets another, --height the size",
        Remedy::Threshold => "--threshold sets another value",
        Remedy::Opacity => "--threshold 1 counts all that shows",
        Remedy::Background => "--background keep keeps it",
        Remedy::DropBackground => "--background drop leaves it out",
        Remedy::Holes => "--holes fill makes a solid body of it",
        Remedy::KeepHoles => "--holes keep keeps the holes",
        Remedy::Gap => "--gap sets how wide they may be, 0 for none",
        Remedy::Join => "--join sets how far apart ends may be",
        Remedy::Smooth => "--smooth sets how far, 0 for not at all",
        Remedy::Layers => "--layer names those that count",
        Remedy::Blocks => "--block names those that count",
        Remedy::MinWidth => "--min-width widens them",
        Remedy::Pieces => "choose --pieces largest, or join them in the drawing",
    }
}

/// The report of a clean-up as it is printed.
#[derive(Serialize)]
pub struct CleanUp<'a> {
    #[serde(flatten)]
    changes: &'a Changes,
    notes: Vec<String>,
}

impl<'a> CleanUp<'a> {
    /// `more`: what the operation has to say besides.
    pub fn new<N: ToString>(changes: &'a Changes, more: &[N]) -> Self {
        let notes = changes.notes.iter().map(note).chain(more.iter().map(N::to_string)).collect();
        Self { changes, notes }
    }

    /// A line for each step and note.
    pub fn lines(&self) -> impl Iterator<Item = String> {
        self.changes.steps.iter().map(step).chain(self.notes.iter().cloned())
    }
}
