//! How a command ends: one typed error, its exit code, and its one line.

use crate::files::{printable, shown};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

/// Why a command did not do what was asked.
#[derive(Debug, thiserror::Error)]
pub enum CommandError {
    /// The tool itself failed.
    #[error("{0}")]
    Failed(String),
    /// An output could not be written.
    #[error("cannot write {}: {source}", shown(path))]
    Write { path: PathBuf, source: io::Error },
    /// Standard output could not be written.
    #[error("cannot print: {0}")]
    Print(io::Error),
    /// The command line asks for something that cannot be.
    #[error("{0}")]
    Usage(String),
    /// An input file is missing, unreadable or contradictory.
    #[error("{}: {reason}", shown(path))]
    Input { path: PathBuf, reason: String },
    /// A question has no converged answer; the best state reached is written.
    #[error("not converged: {0}")]
    NotConverged(String),
    /// No display or no graphics adapter; the text says what to install.
    #[error("{0}")]
    Environment(String),
    #[error("cancelled")]
    Cancelled,
    /// An interrupt ended it early; the text says what there is and how to go on.
    #[error("interrupted: {0}")]
    Interrupted(String),
}

impl CommandError {
    /// The exit code of the process.
    pub fn code(&self) -> u8 {
        match self {
            Self::Failed(_) | Self::Write { .. } | Self::Print(_) => 1,
            Self::Usage(_) | Self::Input { .. } => 2,
            Self::NotConverged(_) => 3,
            Self::Environment(_) => 4,
            Self::Cancelled | Self::Interrupted(_) => 130,
        }
    }

    /// The message as one line, whatever the errors below it contain, and nothing in it that a terminal would obey.
    pub fn line(&self) -> String {
        one_line(&self.to_string())
    }

    /// The same with more to say where its own text is all there is, or as a failure.
    #[must_use]
    pub fn adding(self, more: &str) -> Self {
        match self {
            Self::Usage(text) => Self::Usage(format!("{text}; {more}")),
            other => Self::Failed(format!("{other}; {more}")),
        }
    }

    /// An input file that cannot be used, with the reason.
    pub fn input(path: &Path, reason: impl ToString) -> Self {
        Self::Input { path: path.to_owned(), reason: reason.to_string() }
    }

    /// An output file that cannot be written.
    pub fn write(path: &Path, source: io::Error) -> Self {
        Self::Write { path: path.to_owned(), source }
    }
}

/// Ends a command once an interrupt was seen.
///
/// # Errors
/// [`CommandError::Cancelled`].
pub fn check_cancel(cancel: &AtomicBool) -> Result<(), CommandError> {
    if cancel.load(Ordering::SeqCst) { Err(CommandError::Cancelled) } else { Ok(()) }
}

/// Why reading the command line ended early.
#[derive(Debug)]
pub enum ParseStop {
    /// Help or the version was asked for.
    Information(clap::Error),
    Wrong(CommandError),
}

impl ParseStop {
    /// Prints help or version; a wrong command line becomes its error.
    ///
    /// # Errors
    /// A wrong command line is [`CommandError::Usage`]; help and version are none.
    pub fn print(self) -> Result<(), CommandError> {
        match self {
            Self::Information(text) => text.print().map_err(CommandError::Print),
            Self::Wrong(error) => Err(error),
        }
    }
}

/// Words in a line, and nothing in it that a terminal would obey.
pub fn one_line(text: &str) -> String {
    printable(&text.split_whitespace().collect::<Vec<_>>().join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_of_many_lines_becomes_one() {
        let error = CommandError::input(Path::new("a.plush"), "1:2: expected\n   a number\r\n");
        assert_eq!(error.line(), "a.plush: 1:2: expected a number");
        assert_eq!(error.code(), 2);
    }

    #[test]
    fn an_interrupt_is_code_130() {
        let cancel = AtomicBool::new(true);
        assert_eq!(check_cancel(&cancel).unwrap_err().code(), 130);
    }
}
