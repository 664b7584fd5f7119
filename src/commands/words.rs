//! What outlines have to say, in the words of the command line: every setting by its option.

use crate::outline::{Changes, Note, OutlineError, Remedy};
use serde::Serialize;

/// The report of a clean-up as `--json` prints it.
#[derive(Serialize)]
pub struct CleanUp<'a> {
    #[serde(flatten)]
    changes: &'a Changes,
    notes: Vec<String>,
}

impl<'a> CleanUp<'a> {
    pub fn of(changes: &'a Changes) -> Self {
        Self { changes, notes: changes.notes.iter().map(note).collect() }
    }
}

/// A note, and the option that would change it.
pub fn note(note: &Note) -> String {
    if let Note::MoreFibers { asked, count } = note {
        return format!("the outline needs more than {asked} fibers; it has {count}");
    }
    match note.remedy() {
        Some(Remedy::Unit) => format!("{note} (--unit sets another)"),
        Some(Remedy::Threshold) => format!("{note} (--threshold sets another value)"),
        Some(Remedy::Background) => format!("{note} (--background keep keeps it)"),
        Some(Remedy::MinWidth) => format!("{note}; --min-width widens them"),
        Some(remedy) => format!("{note}; {}", option(remedy)),
        None => note.to_string(),
    }
}

/// Why there is no outline, and the option that would help.
pub fn outline_error(error: &OutlineError) -> String {
    error.remedy().map_or_else(|| error.to_string(), |remedy| format!("{error}; {}", option(remedy)))
}

fn option(remedy: Remedy) -> &'static str {
    match remedy {
        Remedy::Height => "--height sets another height",
        Remedy::Unit => "--unit sets another",
        Remedy::Threshold => "--threshold sets another value",
        Remedy::Background => "--background keep keeps it",
        Remedy::Holes => "--holes fill makes a solid body of it",
        Remedy::MinWidth => "--min-width widens them",
        Remedy::Pieces => "choose --pieces largest, or join them in the drawing",
    }
}
