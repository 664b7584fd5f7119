//! What a frame under the hand may cost, and what it took.

/// How much work a frame may take: the user's trade between speed and accuracy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality {
    /// A quarter of the work of `Balanced`: follows the hand on slow machines, lags behind fast moves.
    Draft,
    /// What a core does in a sixtieth of a second, up to 10 000 fibres; converged in most frames of small scenes.
    #[default]
    Balanced,
    /// Until nothing moves any more.
    Accurate,
}

/// Fibres times factorisations of a balanced frame: about 16 ms on one core.
const BALANCED_WORK: usize = 12_000;
/// Most factorisations of a balanced frame: more than converge a warm one.
const BALANCED_FACTORIZATIONS: usize = 24;
const DRAFT_PART: usize = 4;
const ACCURATE_FACTORIZATIONS: usize = 200;

impl Quality {
    /// From the fastest to the most accurate.
    pub const ALL: [Self; 3] = [Self::Draft, Self::Balanced, Self::Accurate];

    /// Numeric factorisations that a frame with this many free elements may take.
    pub fn factorizations(self, elements: usize) -> usize {
        let balanced = (BALANCED_WORK / elements.max(1)).clamp(1, BALANCED_FACTORIZATIONS);
        match self {
            Self::Draft => (balanced / DRAFT_PART).max(1),
            Self::Balanced => balanced,
            Self::Accurate => ACCURATE_FACTORIZATIONS,
        }
    }

    /// A frame is done when no node moves further than this part of the body in an iteration, or no target would come nearer
    /// by more than that. A thousandth of a millimetre in a plushie of 100 mm cannot be seen.
    pub fn step_tolerance(self) -> f64 {
        match self {
            Self::Draft => 1e-4,
            Self::Balanced => 1e-5,
            Self::Accurate => 1e-7,
        }
    }
}

/// Where the time of a frame went, seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Phases {
    pub assembly: f64,
    pub factorization: f64,
    pub solves: f64,
    pub dual: f64,
    pub line_search: f64,
}

/// Cost and result of a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frame {
    pub iterations: usize,
    pub factorizations: usize,
    /// Whether nothing moves any more.
    pub converged: bool,
    /// `max |dE/dx|` of the state shown, and the forces at work against which it is small.
    pub residual: f64,
    pub force_scale: f64,
    pub phases: Phases,
}
