//! Faults of a line and its controllers, on request.

use std::fmt;
use std::str::FromStr;

/// What goes wrong, and when.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    pub kind: FaultKind,
    /// With which command, from 1.
    pub at: usize,
}

/// What can go wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultKind {
    /// A command is not answered.
    NoReply,
    /// The answer is noise.
    Garbage,
    /// A controller reports an error of its own: too hot, an alarm.
    Error,
    /// A drive is at its limit and refuses.
    Limit,
    /// The line breaks; controllers go on with what they have been told.
    Gone,
    /// A winch, from 1, hears and says nothing any more.
    Missing(usize),
}

/// What faults are called, and what they are for people.
pub(super) const NAMES: [(&str, FaultKind); 5] = [
    ("no-reply", FaultKind::NoReply),
    ("garbage", FaultKind::Garbage),
    ("error", FaultKind::Error),
    ("limit", FaultKind::Limit),
    ("gone", FaultKind::Gone),
];
const MISSING: &str = "missing:";

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.kind, NAMES.iter().find(|(_, kind)| *kind == self.kind)) {
            (FaultKind::Missing(winch), _) => write!(f, "{MISSING}{winch}@{}", self.at),
            (_, Some((name, _))) => write!(f, "{name}@{}", self.at),
            (_, None) => Ok(()),
        }
    }
}

impl FromStr for Fault {
    type Err = String;

    /// `garbage@120`, `missing:2@120`; without a number, with the first command.
    fn from_str(text: &str) -> Result<Self, String> {
        let (name, at) = text.split_once('@').unwrap_or((text, "1"));
        let at = at.parse().ok().filter(|at| *at > 0);
        let kind = match name.strip_prefix(MISSING) {
            Some(winch) => winch.parse().ok().filter(|winch| *winch > 0).map(FaultKind::Missing),
            None => NAMES.iter().find(|(known, _)| *known == name).map(|(_, kind)| *kind),
        };
        match (kind, at) {
            (Some(kind), Some(at)) => Ok(Self { kind, at }),
            _ => Err(format!(
                "expected no-reply, garbage, error, limit, gone or missing:WINCH, with @COMMAND (from 1), found `{text}`"
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_are_read_as_they_are_written() {
        for text in ["no-reply@1", "garbage@120", "error@3", "limit@4", "gone@5", "missing:2@6"] {
            assert_eq!(text.parse::<Fault>().map(|fault| fault.to_string()), Ok(text.to_owned()));
        }
        assert_eq!("gone".parse(), Ok(Fault { kind: FaultKind::Gone, at: 1 }));
        for wrong in ["", "fire@3", "gone@0", "gone@-1", "missing@2", "missing:0", "missing:x@2"] {
            assert!(wrong.parse::<Fault>().is_err(), "{wrong}");
        }
    }
}
