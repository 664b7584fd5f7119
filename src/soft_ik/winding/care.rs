//! How carefully wound states are looked at.

use super::walk::Pace;

/// Up to this many winches, the lines lie on a lattice.
pub const LATTICE: usize = 3;

/// Factorisations of thorough walks: several times what all lines of a sound body take. One that crumples when it is wound would take a thousand times
/// as many, and nothing that is found beyond is ever proved.
const MOST_WALKING: usize = 2500;

/// Bounds on the cost of a search for wound states, and the proof it owes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Care {
    /// Parts of a winch's range between lines, for one, two and three winches; powers of two.
    pub levels: [usize; LATTICE],
    /// Lines where there are more winches.
    pub spread: usize,
    /// How the lines are walked.
    pub pace: Pace,
    /// Valleys polished at most.
    pub polished: usize,
    /// Factorisations spent on walks at most.
    pub walking: usize,
    /// Whether the answer must be proved to be wound from rest.
    pub proved: bool,
}

impl Care {
    /// For a plushie's pose that is kept: what winding from rest reaches.
    pub const THOROUGH: Self = Self {
        levels: [1, 4, 2],
        spread: 8,
        pace: Pace { stride: 0.05, longest: 0.125, balance: 1e-4 },
        polished: 8,
        walking: MOST_WALKING,
        proved: true,
    };
    /// For the equilibrium of least `O`, on whatever branch, in a few times the work of one Gauss-Newton run.
    pub fn quick(winches: usize) -> Self {
        let pace = match winches {
            1 => Pace { stride: 0.1, longest: 0.125, balance: 1e-4 },
            _ => Pace { stride: 0.2, longest: 0.25, balance: 1e-2 },
        };
        Self { levels: [1, 2, 2], spread: 0, pace, polished: 3, walking: usize::MAX, proved: false }
    }
}
