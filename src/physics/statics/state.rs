//! Settings of statics, and what it comes to.

/// Settings of [`super::solve()`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StaticsSettings {
    /// Converged when the largest unbalanced force is below this fraction of the forces at work. 1e-12 is near what
    /// rounding allows; positions are then good to about ten digits.
    pub tolerance: f64,
    /// Where rounding stops progress, a residual below this fraction still counts as converged.
    pub stagnation_tolerance: f64,
    /// Newton steps. Ordinary bodies take fewer than 30; cables a million times stiffer than the body take hundreds.
    pub max_iterations: usize,
}

impl Default for StaticsSettings {
    fn default() -> Self {
        Self { tolerance: 1e-12, stagnation_tolerance: 1e-8, max_iterations: 1000 }
    }
}

/// A converged state.
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    pub x: Vec<f64>,
    pub energy: f64,
    /// `max |dE/dx|`.
    pub residual: f64,
    pub iterations: usize,
    pub factorizations: usize,
    /// Iterations in which the Hessian had to be projected.
    pub projections: usize,
}

/// Why statics did not converge; the best state reached comes with it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{cause}")]
pub struct StaticsError {
    pub cause: Cause,
    pub best: Equilibrium,
}

/// What kept forces from balancing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Cause {
    #[error("the rest state itself is inverted or not finite")]
    InvalidStart,
    #[error("the stiffness matrix could not be factorised, even projected")]
    Factorization,
    #[error("no step lowers the energy any further, and forces are still unbalanced")]
    Stalled,
    #[error("the allowed number of Newton steps was not enough")]
    Iterations,
    #[error("the body is free to move: add a pin")]
    FreeToMove,
    #[error("a triangle is pressed flat: pull less")]
    Collapsed,
    #[error("cancelled")]
    Cancelled,
}

/// What a search for equilibrium did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Progress {
    pub energy: f64,
    /// `max |dE/dx|`.
    pub residual: f64,
    /// The forces at work, against which the residual is small.
    pub force_scale: f64,
    pub iterations: usize,
    pub factorizations: usize,
    pub projections: usize,
    /// Why it is not in equilibrium; `None` where it is.
    pub cause: Option<Cause>,
}
