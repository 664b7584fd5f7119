//! Lines to motors: what every kind of link can do.

use std::io;
use thiserror::Error;

/// A line to one or more motors, with a clock of its own: that of the wall for a serial port, a virtual one for files and
/// simulations, which never wait.
pub trait Link {
    /// Opens the line and sets its clock to zero.
    ///
    /// # Errors
    /// A line that is not there, or in use.
    fn open(&mut self) -> Result<(), LinkError>;

    /// Sends one command; the link adds what frames it on the line.
    ///
    /// # Errors
    /// A line that is closed or broken.
    fn send(&mut self, command: &str) -> Result<(), LinkError>;

    /// Waits for one reply, for `patience_s` at most.
    ///
    /// # Errors
    /// A line that is closed or broken.
    fn read(&mut self, patience_s: f64) -> Result<Reply, LinkError>;

    /// Time since the line was opened, s.
    fn now_s(&self) -> f64;

    /// Waits until the clock shows `time_s`; not at all if it is later.
    ///
    /// # Errors
    /// A line that broke in the meantime.
    fn wait_until(&mut self, time_s: f64) -> Result<(), LinkError>;
}

/// The answer of the motors, if any.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reply {
    /// A line without its end.
    Line(String),
    /// Nothing in time.
    Nothing,
    /// Nothing ever does: the link has one direction.
    OneWay,
}

/// A command that was not carried, or not taken.
#[derive(Debug, Error)]
pub enum LinkError {
    #[error("the line to the motors is not open")]
    Closed,
    #[error("the motors did not answer {command:?} within {patience_s} s")]
    NoReply { command: String, patience_s: f64 },
    #[error("the motors answered {reply:?} to {command:?}")]
    Refused { command: String, reply: String },
    #[error("the line to the motors: {0}")]
    Broken(#[from] io::Error),
}
