//! What the core has to say, in the words of the command line: its options by name.

use super::error::CommandError;
use crate::fabrication::ExportError;
use crate::operations::{Progress, Unbalanced, new_design, reshape};
use crate::outline::{Change, Changes, Note, OutlineError};
use crate::rigging;
use serde::Serialize;
use std::path::Path;

/// Why an outline made no design.
pub fn unmade(path: &Path, error: new_design::Error) -> CommandError {
    match error {
        new_design::Error::Outline(error) => CommandError::input(path, outline(&error)),
        new_design::Error::Mesh(error) => CommandError::input(path, error),
        new_design::Error::Cancelled(_) => CommandError::Cancelled,
    }
}

/// Why a design was not given another silhouette.
pub fn unshaped(design: &Path, path: &Path, error: reshape::Error) -> CommandError {
    match error {
        reshape::Error::Outline(error) => CommandError::input(path, outline(&error)),
        reshape::Error::Mesh(error) => CommandError::input(path, error),
        reshape::Error::Edit(error) => CommandError::input(design, error),
        reshape::Error::Cancelled(_) => CommandError::Cancelled,
    }
}

/// Why there is no blueprint of a design.
pub fn unexported(design: &Path, error: ExportError) -> CommandError {
    match error {
        ExportError::Write { path, source } => CommandError::write(&path, source),
        ExportError::NotOurs { .. } | ExportError::Changed { .. } => CommandError::Usage(error.to_string()),
        ExportError::NoNetworks => CommandError::input(design, format!("{error}; run `plushwright rig` first")),
        error => CommandError::input(design, error),
    }
}

/// Fails where a plushie did not come to equilibrium; for the end of a command, when what was found is written.
pub fn balanced<'a>(unbalanced: impl IntoIterator<Item = &'a Unbalanced>) -> Result<(), CommandError> {
    let told: Vec<String> = unbalanced.into_iter().map(Unbalanced::to_string).collect();
    if told.is_empty() { Ok(()) } else { Err(CommandError::NotConverged(told.join("; "))) }
}

/// One line about a step of an operation.
pub fn progress(step: &Progress) -> String {
    match step {
        Progress::Rig(rigging::Progress::Candidates { winch, count }) => {
            format!("winch {}: {count} candidate networks", winch + 1)
        }
        Progress::Rig(rigging::Progress::Accepted { winch, tendons, errors }) => {
            let errors: Vec<String> =
                errors.iter().map(|(name, error)| format!("{name} {:.1} %", 100.0 * error)).collect();
            format!("winch {}: {tendons} tendons; {}", winch + 1, errors.join(", "))
        }
    }
}

/// A note of a reader or the clean-up, with the option that would have it otherwise.
fn note(note: &Note) -> String {
    match note {
        Note::BackgroundLeftOut => format!("{note} (--background keep keeps it)"),
        Note::NoUnit(_) => format!("{note} (--unit sets another)"),
        Note::Ink(_) => format!("{note} (--threshold sets another value)"),
        Note::MostlyHoles => format!("{note}; --holes fill makes a solid body of it"),
        Note::Thin { .. } => format!("{note}; --min-width widens them"),
        Note::Small { .. } => format!("{note}; --height sets another height"),
        Note::TextSet(_)
        | Note::PicturesLeftOut(_)
        | Note::FiltersLeftOut
        | Note::OffPage
        | Note::Unsound
        | Note::Specks { .. }
        | Note::OpenLines(_)
        | Note::LeftOut { .. } => note.to_string(),
    }
}

/// Why a file gave no outline, with the option that may help.
fn outline(error: &OutlineError) -> String {
    match error {
        OutlineError::Pieces { .. } => format!("{error}; choose --pieces largest, or join them in the drawing"),
        OutlineError::Size(_) => format!("{error}; --height sets another height"),
        _ => error.to_string(),
    }
}

/// [`Changes`] as they are printed as JSON.
#[derive(Serialize)]
pub struct CleanUp<'a> {
    painted_mm2: f64,
    outline_mm2: f64,
    unasked: f64,
    steps: &'a [Change],
    notes: Vec<String>,
}

impl<'a> CleanUp<'a> {
    /// `more`: what the operation has to say besides.
    pub fn new<N: ToString>(changes: &'a Changes, more: &[N]) -> Self {
        let &Changes { painted_mm2, outline_mm2, unasked, ref steps, ref notes } = changes;
        let notes = notes.iter().map(note).chain(more.iter().map(N::to_string)).collect();
        Self { painted_mm2, outline_mm2, unasked, steps, notes }
    }

    /// A line for each step and note.
    pub fn lines(&self) -> impl Iterator<Item = String> {
        self.steps.iter().map(Change::line).chain(self.notes.iter().cloned())
    }
}
