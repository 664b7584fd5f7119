//! Compiles a design into a physics model, poses both plushies, and runs on a thread of its own.
//!
//! The realizable plushie is always solved first; its activations are then held in the idealized one and the fibres
//! add what is missing (section 3, design loop).

mod body_spec;
pub mod compile;
pub mod patch;
pub mod play;
pub mod solver;
pub mod warning;
pub mod worker;

pub use crate::soft_ik::Quality;
pub use body_spec::BodySpec;
pub use play::Play;
pub use solver::{Effort, Solver, target_error};
pub use warning::Warning;

use crate::design::{Design, Target};
use crate::outline::Point;
use std::sync::Arc;

/// One plushie, solved: a state that may be shown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shape {
    /// Node positions, mm.
    pub nodes: Vec<Point>,
    /// Cable wound by each winch, mm, in the order of the design's networks; 0 is the just-slack rest state.
    pub activations_mm: Vec<f64>,
    /// Contraction of each fibre, mm, in the order of [`Design::fiber_routings`]; empty for the realizable plushie.
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
    /// From the question to this shape.
    pub milliseconds: f64,
    /// Whether this is the best pose that winding from rest was found to reach: looked for with all effort, not cut short.
    pub wound: bool,
    /// What a millimetre of cable does to the pose, where it was looked for with all effort.
    pub play: Option<Play>,
    /// What the user should know.
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

/// What the worker is asked for. The newest request wins.
#[derive(Clone, Debug)]
pub struct Request {
    /// Chosen by the caller and returned in the outcome.
    pub id: u64,
    pub design: Arc<Design>,
    pub question: Question,
    /// How much work a frame may take while a hand drags ([`Effort::Interactive`]).
    pub quality: Quality,
    /// A view that is not shown is not solved, see [`Request::solves`].
    pub show_idealized: bool,
    pub show_realizable: bool,
}

impl Request {
    /// Which plushies are solved: idealized, realizable. What is not shown is not, with one exception: the fibres of the
    /// idealized plushie add to what the winches reach, so where winches have to be searched for, they are.
    pub fn solves(&self) -> [bool; 2] {
        let searched = matches!(&self.question, Question::Targets(targets) if !targets.is_empty());
        let builds_on_winches = self.show_idealized && searched && !self.design.networks.is_empty();
        [self.show_idealized, self.show_realizable || builds_on_winches]
    }
}

#[derive(Clone, Debug)]
pub enum Question {
    /// Pose both plushies towards these targets (none: the rest pose).
    Targets(Vec<Target>),
    /// Show the animation: winch activations given, mm, fibres passive.
    Activations(Vec<f64>),
}

/// The answer to a [`Request`].
#[derive(Clone, Debug)]
pub struct Outcome {
    pub id: u64,
    pub idealized: Option<Shape>,
    pub realizable: Option<Shape>,
    /// Found with all effort while nothing newer waited, in the place of an earlier outcome of the same request.
    pub refined: bool,
}
