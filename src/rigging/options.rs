//! What a search for a rig may build, what it tells on the way, and why it may fail.

use super::robust::Sewn;
use crate::defaults;
use crate::design::Design;
use crate::engine::Shape;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// The options of a search: what may be built and tried.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RigOptions {
    pub method: Method,
    /// Whether the networks that are there are forgotten.
    pub fresh: bool,
    /// Whether the rules of sewing are kept ([`Method::Joint`] alone).
    pub rules: bool,
    pub trims: Trims,
    /// Rounds of search, and the seed of its random numbers ([`Method::Joint`] alone).
    pub rounds: usize,
    pub seed: u64,
    /// Starts that are raced in the first half of the rounds, before the best go on; `None`: as many as that half allows ([`Method::Joint`] alone).
    pub starts: Option<usize>,
    /// Whether a search that is told to stop ends with the best that it has, if anything, instead of [`RigError::Cancelled`].
    pub keep: bool,
    pub max_winches: usize,
    pub tendons: TendonChoice,
    /// Parameters of Algorithm 2 held at these values; `None` lets the search vary them.
    pub seed_num: Option<usize>,
    pub join_depth: Option<usize>,
    pub join_len: Option<usize>,
    pub phi: Option<f64>,
}

impl Default for RigOptions {
    fn default() -> Self {
        Self {
            method: Method::default(),
            fresh: false,
            rules: true,
            trims: Trims::default(),
            rounds: defaults::RIG_ROUNDS,
            seed: 1,
            starts: None,
            keep: false,
            max_winches: 3,
            tendons: TendonChoice::default(),
            seed_num: None,
            join_depth: None,
            join_len: None,
            phi: None,
        }
    }
}

/// What else of a cable is searched for than its way ([`Method::Joint`] alone).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Trims {
    /// The radius of its groove, as a part of the spool's: spools of several radii.
    pub ratios: bool,
    /// Slack at assembly: a cable that pulls later than the others of its winch.
    pub slack: bool,
}

/// How networks are looked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Method {
    /// All winches together, over all poses.
    #[default]
    Joint,
    /// Winch by winch, the networks of Algorithm 2 as they are.
    Algorithm2,
}

/// How many tendons each winch gets.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum TendonChoice {
    /// Winch by winch; the last number holds for all further ones.
    PerWinch(Vec<usize>),
    /// Whatever serves best between the two, both included.
    Between(usize, usize),
}

impl Default for TendonChoice {
    fn default() -> Self {
        Self::Between(1, 4)
    }
}

/// Most tendons of one winch: a spool does not hold more.
const MAX_TENDONS: usize = 16;

/// What is no number of tendons.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("expected N, N,N,... or A..B with numbers from 1 to {MAX_TENDONS}, found `{0}`")]
pub struct BadTendons(String);

/// Reads `N`, `N,N,...` or `A..B` (both ends included).
impl FromStr for TendonChoice {
    type Err = BadTendons;

    fn from_str(text: &str) -> Result<Self, BadTendons> {
        let bad = || BadTendons(text.to_owned());
        let number =
            |part: &str| part.trim().parse::<usize>().ok().filter(|n| (1..=MAX_TENDONS).contains(n)).ok_or_else(bad);
        if let Some((low, high)) = text.split_once("..") {
            let (low, high) = (number(low)?, number(high)?);
            return if low <= high { Ok(Self::Between(low, high)) } else { Err(bad()) };
        }
        Ok(Self::PerWinch(text.split(',').map(number).collect::<Result<_, _>>()?))
    }
}

impl fmt::Display for TendonChoice {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Between(low, high) => write!(f, "{low}..{high}"),
            Self::PerWinch(numbers) => f.write_str(&numbers.iter().map(usize::to_string).collect::<Vec<_>>().join(",")),
        }
    }
}

/// A step of the search. Winches count from zero, those found in this search alone.
#[derive(Clone, Debug, PartialEq)]
pub enum Progress {
    /// So many candidate networks will be tried out for a winch.
    Candidates { winch: usize, count: usize },
    /// A winch was accepted; `errors`: name and target error (body lengths) of every pose with all winches so far.
    Accepted { winch: usize, tendons: usize, errors: Vec<(String, f64)> },
    /// A round of the joint search begins: the worst pose's error so far, as a part of that at rest, and the holes of the rig.
    Round { round: usize, rounds: usize, worst: f64, holes: usize },
    /// The end of the joint search; `errors`: what a check says of every pose, body lengths; `sewn`: what is left of each when a
    /// hand sews it, empty where no rule of sewing counts.
    Found { winches: usize, tendons: usize, errors: Vec<(String, f64)>, sewn: Vec<Sewn> },
}

/// What a search has found.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    pub design: Design,
    /// Every pose that has targets.
    pub wound: Vec<Wound>,
    /// Whether what is wound is of a coarser mesh than the design's.
    pub coarse: bool,
}

impl Found {
    /// Whether the search was told to stop, and this is the best that it had by then: nothing was checked.
    pub fn is_interrupted(&self) -> bool {
        self.wound.iter().any(|wound| wound.checked.is_none())
    }
}

/// What the winches wind in a pose.
#[derive(Clone, Debug, PartialEq)]
pub struct Wound {
    /// Its name.
    pub pose: String,
    pub activations_mm: Vec<f64>,
    /// The realizable plushie there, as a check has it; a search that was told to stop checks nothing.
    pub checked: Option<Shape>,
    /// What a hand leaves of it, where that was worked out.
    pub sewn: Option<Sewn>,
}

impl Wound {
    pub(super) fn checked(pose: String, shape: Shape) -> Self {
        Self { pose, activations_mm: shape.activations_mm.clone(), checked: Some(shape), sewn: None }
    }
}

/// Why no rig was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RigError {
    #[error("the design has no pose with targets, so there is nothing to rig for")]
    NoTargets,
    #[error("the body has no model: a triangle has no area, or the mesh is too large for the memory")]
    NoModel,
    #[error("no network brings any pose closer to its targets")]
    NothingFound,
    #[error("no further network brings any pose closer to its targets by what anybody would see")]
    NothingToAdd,
    #[error("cancelled")]
    Cancelled,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tendon_choices_read_back() {
        for (text, choice) in [
            ("2", TendonChoice::PerWinch(vec![2])),
            ("1,2,3", TendonChoice::PerWinch(vec![1, 2, 3])),
            ("1..3", TendonChoice::Between(1, 3)),
        ] {
            assert_eq!(text.parse(), Ok(choice.clone()));
            assert_eq!(choice.to_string(), text);
        }
        for bad in ["", "0", "3..1", "1,,2", "a", "1..", "99"] {
            let refused = bad.parse::<TendonChoice>().unwrap_err();
            assert!(refused.to_string().contains(&format!("`{bad}`")), "{bad}");
        }
    }
}
