//! Compiles a design into a physics model, poses both plushies, runs on a thread of its own, and rigs.
//!
//! The realizable plushie is always solved first; its activations are then held in the idealized one and the fibres
//! add what is missing (section 3, design loop).

pub mod compile;
pub mod propose;
pub mod response;
pub mod rig;
pub mod solver;
pub mod trial;
pub mod worker;

pub use propose::propose;
pub use solver::{Effort, Solver};

use crate::design::{Design, Network, Target};
use crate::discovery;
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
    pub iterations: usize,
    pub milliseconds: f64,
    /// What the user should know (not converged, body free to move, ...), ready to be shown.
    pub warning: Option<String>,
}

/// What the worker is asked for. The newest request wins.
#[derive(Clone, Debug)]
pub struct Request {
    /// Chosen by the caller and returned in the outcome.
    pub id: u64,
    pub design: Arc<Design>,
    pub question: Question,
    /// A view that is not shown is not solved.
    pub show_idealized: bool,
    pub show_realizable: bool,
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
}

/// A network proposed by discovery and tried out by simulation.
#[derive(Clone, Debug)]
pub struct Proposal {
    pub network: Network,
    pub parameters: discovery::Parameters,
    /// The stages of discovery, to be shown (fig. 6).
    pub stages: discovery::Stages,
    /// The realizable plushie with this network added, posed towards the same targets.
    pub preview: Shape,
    /// Target error before and after, in body lengths.
    pub error_before: f64,
    pub error_after: f64,
}
