//! What a search for a rig may build, what it tells on the way, and why it may fail.

/// What the search may build and try.
#[derive(Clone, Debug, PartialEq)]
pub struct RigOptions {
    pub max_winches: usize,
    pub tendons: TendonChoice,
    /// Parameters of Algorithm 2 held at these values; `None` lets the search vary them.
    pub seed_num: Option<usize>,
    pub join_depth: Option<usize>,
    pub join_len: Option<usize>,
    pub phi: Option<f64>,
}

/// How many tendons each winch gets.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TendonChoice {
    /// Winch by winch; the last number holds for all further ones.
    PerWinch(Vec<usize>),
    /// Whatever serves best between the two, both included.
    Between(usize, usize),
}

/// A step of the search. Winches count from zero, those found in this search alone.
#[derive(Clone, Debug, PartialEq)]
pub enum Progress {
    /// So many candidate networks will be tried out for a winch.
    Candidates { winch: usize, count: usize },
    /// A winch was accepted; `errors`: name and target error (body lengths) of every pose with all winches so far.
    Accepted { winch: usize, tendons: usize, errors: Vec<(String, f64)> },
}

/// Why no rig was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RigError {
    #[error("the design has no pose with targets, so there is nothing to rig for")]
    NoTargets,
    #[error("no network brings any pose closer to its targets")]
    NothingFound,
    #[error("cancelled")]
    Cancelled,
}
