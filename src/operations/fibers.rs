//! How many muscle fibres a body is given.

use crate::defaults;
use serde::{Deserialize, Serialize};

/// How many muscle fibres are wanted of a body whose outline may not allow every number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum FiberCount {
    /// As many as there are where there are any: those of the design, or of a file that brings its own mesh. Otherwise
    /// [`defaults::FIBERS`], or the fewest that the outline allows where that is more.
    #[default]
    Usual,
    /// So many, or the fewest that the outline allows where that is more.
    AtLeast(usize),
    /// So many; an outline that does not allow it is refused.
    Exactly(usize),
}

impl FiberCount {
    /// [`Self::Exactly`] as many as are asked for, if any are.
    pub fn asked(fibers: Option<usize>) -> Self {
        fibers.map_or(Self::Usual, Self::Exactly)
    }

    /// The number that is tried first, and whether more will do; `present`: how many there are.
    pub(super) fn wanted(self, present: Option<usize>) -> (usize, bool) {
        match self {
            Self::Usual => (present.unwrap_or(defaults::FIBERS), true),
            Self::AtLeast(fibers) => (fibers, true),
            Self::Exactly(fibers) => (fibers, false),
        }
    }
}

/// More fibres than were asked for: the fewest that the outline allows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the outline needs more than {asked} fibers; it has {count}{}", hint(*.asked, *.count))]
pub struct MoreFibers {
    pub asked: usize,
    pub count: usize,
}

/// A body needs this many times the fibres asked for where its outline is fur or noise.
const FAR_MORE: usize = 8;

/// What is the matter with an outline that needs far more fibres than asked for.
fn hint(asked: usize, count: usize) -> &'static str {
    if count > FAR_MORE * asked {
        ", for its rim is very fine: smoothing or a least width makes it plainer"
    } else {
        ""
    }
}
