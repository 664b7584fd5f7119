//! Network discovery: from co-active fibres to a winch-tendon network (section 6, Algorithm 2).

use crate::defaults;
use serde::{Deserialize, Serialize};

/// Parameters of Algorithm 2.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameters {
    pub seed_num: usize,
    pub join_depth: usize,
    pub join_len: usize,
    pub tendon_num: usize,
    /// Between 0 (equal tendons) and 1 (long tendons).
    pub phi: f64,
    /// How the spread of net contractions is measured.
    pub spread: Spread,
}

/// `phi * mean - (1 - phi) * spread`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Spread {
    /// Population variance, as printed: m and m^2 are mixed.
    Variance,
    /// Standard deviation: `phi` means the same at every size.
    StandardDeviation,
}

/// What each stage of discovery found, for fig. 6. Edges are node pairs with the smaller id first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stages {
    /// Contraction of every edge of the activation graph, in the order of the edges given.
    pub weights: Vec<f64>,
    pub seeds: Vec<[usize; 2]>,
    pub start: Vec<[usize; 2]>,
    pub joins: Vec<Vec<usize>>,
    pub tree: Vec<[usize; 2]>,
    pub winch: usize,
    pub tendons: Vec<Vec<usize>>,
    pub score: f64,
}

impl Default for Parameters {
    fn default() -> Self {
        Self {
            seed_num: defaults::SEED_NUM,
            join_depth: defaults::JOIN_DEPTH,
            join_len: defaults::JOIN_LEN,
            tendon_num: defaults::TENDON_NUM,
            phi: defaults::PHI,
            spread: Spread::StandardDeviation,
        }
    }
}
