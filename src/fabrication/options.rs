//! The choices of an export.

use crate::motion::TooFast;
use serde::{Deserialize, Serialize};

/// How a blueprint is made.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    /// Whether an animation that is too fast for the motors is refused or stretched.
    pub too_fast: TooFast,
    /// Families of controllers by name ([`crate::motion::families`]); none for all that can play the motion.
    pub controllers: Vec<String>,
}
