//! What ends a live drive.

use crate::motion::MotionError;
use std::io;
use thiserror::Error;

/// Why motors were not driven on, and how they were left.
#[derive(Debug, Error)]
#[error("{cause}{end}")]
pub struct LiveError {
    pub cause: Cause,
    pub end: End,
}

/// What went wrong.
#[derive(Debug, Error)]
pub enum Cause {
    #[error("stopped")]
    Cancelled,
    #[error("the port cannot be opened: {0}")]
    Port(io::Error),
    #[error("the line to the controllers broke: {0}")]
    Broken(io::Error),
    #[error(
        "{who} did not answer {command:?} within {patience_s} s: check its power, its cable, its number and the speed of the line"
    )]
    NoReply { who: String, command: String, patience_s: f64 },
    #[error("{who} answered {reply} to {command:?}")]
    Refused { who: String, command: String, reply: String },
    #[error(
        "{who} stands at {at_mm:.1} mm, beyond its travel of 0 to {travel_mm:.1} mm: wind it back by hand, or set zero where the cables are just slack"
    )]
    Beyond { who: String, at_mm: f64, travel_mm: f64 },
    #[error("{who} was asked to wind to {asked_mm:.1} mm, beyond its travel of 0 to {travel_mm:.1} mm")]
    Asked { who: String, asked_mm: f64, travel_mm: f64 },
    #[error("{who} did not come back to zero within {within_s:.0} s: it stands at {at_mm:.1} mm")]
    NotHome { who: String, at_mm: f64, within_s: f64 },
    #[error("the line is too slow: a move that was to be sent within {slot_s:.3} s was {late_s:.2} s late")]
    TooSlow { slot_s: f64, late_s: f64 },
    #[error(
        "the line is too slow for so quick a motion: a move is sent every {slot_s:.2} s, and {who} would never get one; give the motion more time, or use a faster line"
    )]
    LeftOut { who: String, slot_s: f64 },
    #[error(transparent)]
    Motion(#[from] MotionError),
}

/// How the motors were left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum End {
    /// None was switched on.
    Off,
    /// All were switched off, and said so.
    SwitchedOff,
    /// These did not say so, or nobody could.
    Unconfirmed(Vec<String>),
}

impl std::fmt::Display for End {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Off => Ok(()),
            Self::SwitchedOff => write!(f, "; all motors are switched off"),
            Self::Unconfirmed(who) => write!(
                f,
                "; {} could not be told to stop and may run on to the last target: switch the power off",
                who.join(", ")
            ),
        }
    }
}
