//! The two plushies.

/// Which of the two plushies a view shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plushie {
    Idealized,
    Realizable,
}

impl Plushie {
    pub fn other(self) -> Self {
        match self {
            Self::Idealized => Self::Realizable,
            Self::Realizable => Self::Idealized,
        }
    }
}
