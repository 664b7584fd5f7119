//! One plushie, solved.

use super::play::Play;
use super::warning::Warning;
use crate::outline::Point;

/// One plushie, solved: a state that may be shown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shape {
    /// Node positions, mm.
    pub nodes: Vec<Point>,
    /// Cable wound by each winch, mm, in the order of the design's networks; 0 is the just-slack rest state.
    pub activations_mm: Vec<f64>,
    /// Contraction of each fibre, mm, in the order of `Design::fiber_routings`; empty for the realizable plushie.
    pub fiber_contractions_mm: Vec<f64>,
    /// Tension of each fibre, N; empty for the realizable plushie.
    pub fiber_tensions: Vec<f64>,
    /// Tension of each tendon, N, network by network.
    pub tendon_tensions: Vec<f64>,
    /// Rms distance of the targets, in body lengths (0 without targets).
    pub target_error: f64,
    /// Largest unbalanced nodal force, N.
    pub residual: f64,
    /// The forces at work, N: what `residual` is to be compared with.
    pub force_scale: f64,
    /// Whether the forces balance. A shape that has not converged is the nearest state found, fit to be shown and no more.
    pub converged: bool,
    /// Iterations of the posing method.
    pub iterations: usize,
    /// Numeric factorisations, those of statics included.
    pub factorizations: usize,
    /// From the request to this shape.
    pub milliseconds: f64,
    /// Whether this is the best pose that winding from rest was found to reach: looked for with all effort, not cut short.
    pub wound: bool,
    /// The effect of a millimetre of cable on the pose, where it was looked for with all effort.
    pub play: Option<Play>,
    /// A warning for the user.
    pub warning: Option<Warning>,
}

/// Below this distance a shape counts as in equilibrium: forces balance to eight digits, which is where statics stops when
/// rounding allows no more (dimensionless, see [`Shape::distance_from_equilibrium`]).
pub const EQUILIBRIUM: f64 = 1e-8;
/// Below this distance a shape is near enough to equilibrium to be shown while a hand drags: forces balance to three digits, and
/// what would still move can hardly be seen (dimensionless).
pub const NEAR_EQUILIBRIUM: f64 = 1e-3;

impl Shape {
    /// The largest unbalanced force as a part of the forces at work, dimensionless. Zero where nothing pulls.
    pub fn distance_from_equilibrium(&self) -> f64 {
        if self.residual == 0.0 { 0.0 } else { self.residual / self.force_scale.max(f64::MIN_POSITIVE) }
    }
}
