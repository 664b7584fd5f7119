//! Why a question has no converged answer: one type for all of them, one line each.

use crate::physics::{Cause, Model};

/// The reason why a part of the answer did not converge. The best state reached is in the answer all the same.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Failure {
    #[error("{part}: {cause}")]
    Statics { part: Part, cause: Cause },
    /// A piece of the body, named by its smallest node, is not held.
    #[error("{part}: {cause}{}", piece(*node, *whole))]
    FreeToMove { part: Part, cause: Cause, node: usize, whole: bool },
    #[error("{part}: the time budget ended the search")]
    TimeBudget { part: Part },
    /// The search ended where the objective can still be lowered (both figures in units of the objective).
    #[error(
        "{part}: the search ended early, the projected gradient is {projected:.1e} and should be at most {tolerance:.1e}"
    )]
    NotMinimal { part: Part, projected: f64, tolerance: f64 },
    #[error("the equilibrium is not stable: it has no sensitivities")]
    Unstable,
    #[error("{part}: the numbers of the answer are beyond what can be written")]
    Overflow { part: Part },
}

/// The part of the answer that is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Statics,
    SoftIk,
    /// A frame of the drag.
    Frame(usize),
    /// All that was left when the time was up, from this frame on.
    After(usize),
}

impl std::fmt::Display for Part {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            Self::Statics => f.write_str("statics"),
            Self::SoftIk => f.write_str("soft_ik"),
            Self::Frame(k) => write!(f, "drag: frame {k}"),
            Self::After(k) => write!(f, "drag: after frame {k}"),
        }
    }
}

fn piece(node: usize, whole: bool) -> String {
    if whole { String::new() } else { format!(" (the piece with node {node} is not held)") }
}

impl Failure {
    /// The cause that statics ended with, and which piece of the body is free if that is why.
    pub(super) fn of(part: Part, cause: Cause, model: &Model) -> Self {
        match (cause, model.loose().first()) {
            (Cause::Cancelled, _) => Self::TimeBudget { part },
            (Cause::FreeToMove, Some(loose)) => {
                Self::FreeToMove { part, cause, node: loose.node, whole: model.pieces() == 1 }
            }
            _ => Self::Statics { part, cause },
        }
    }
}
