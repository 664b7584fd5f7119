//! How a blueprint is made, and which parts of it.

use super::catalogue::Catalogue;
use super::piece::Cutting;
use super::preset::{Cutter, SheetSize};
use crate::motion::TooFast;
use serde::{Deserialize, Serialize};

/// How a blueprint is made.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    /// Whether an animation that is too fast for the motors is refused or stretched.
    pub too_fast: TooFast,
    /// The parts that are wanted.
    pub only: Topics,
    /// The machine that cuts the felt, its sheets, and how it cuts.
    pub cutter: Cutter,
    pub sheet: SheetSize,
    pub cutting: Cutting,
    /// Whether the pattern is widened so that the stuffed body is as drawn.
    pub compensate: bool,
    /// Motors that winches may have.
    #[serde(skip)]
    pub motors: Catalogue,
    /// Families of controllers by name ([`crate::motion::families`]); none for all that can play the motion.
    pub controllers: Vec<String>,
}

/// A part of a blueprint that somebody may want alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Topic {
    /// Patterns for machines that cut.
    Laser,
    /// Patterns on paper, at their size.
    Print,
    /// The ways of the cables.
    Routing,
    /// Spools and housings.
    Winches,
    /// Tracks and programs for controllers.
    Motors,
    /// Parts list and assembly.
    Guide,
}

impl Topic {
    pub const ALL: [Self; 6] = [Self::Laser, Self::Print, Self::Routing, Self::Winches, Self::Motors, Self::Guide];
}

/// A set of parts, all by default.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "Vec<Topic>", into = "Vec<Topic>")]
pub struct Topics([bool; 6]);

impl Topics {
    pub fn has(self, topic: Topic) -> bool {
        self.0[topic as usize]
    }

    pub fn set(&mut self, topic: Topic, wanted: bool) {
        self.0[topic as usize] = wanted;
    }
}

impl Default for Topics {
    fn default() -> Self {
        Self([true; 6])
    }
}

impl From<Vec<Topic>> for Topics {
    fn from(wanted: Vec<Topic>) -> Self {
        Self(Topic::ALL.map(|topic| wanted.contains(&topic)))
    }
}

impl From<Topics> for Vec<Topic> {
    fn from(topics: Topics) -> Self {
        Topic::ALL.into_iter().filter(|&topic| topics.has(topic)).collect()
    }
}
