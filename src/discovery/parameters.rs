//! The parameters of Algorithm 2.

use super::error::DiscoveryError;
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

impl Parameters {
    /// Whether the counts and `phi` mean something.
    ///
    /// # Errors
    /// [`DiscoveryError::Parameter`] for a count of zero where one is needed, or `phi` outside [0, 1].
    pub fn validate(&self) -> Result<(), DiscoveryError> {
        let refuse = |name, expected| Err(DiscoveryError::Parameter { name, expected });
        match self {
            Self { seed_num: 0, .. } => refuse("SEED_NUM", "at least 1"),
            Self { tendon_num: 0, .. } => refuse("TENDON_NUM", "at least 1"),
            _ if !(0.0..=1.0).contains(&self.phi) => refuse("PHI", "between 0 and 1"),
            _ => Ok(()),
        }
    }
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
