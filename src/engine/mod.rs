//! Compiles a design into a physics model, poses both plushies, and runs on a thread of its own.
//!
//! The realizable plushie is always solved first; its activations are then held in the idealized one and the fibres
//! add what is missing (section 3, design loop).

mod body_spec;
pub mod compile;
mod compiled;
pub mod friction;
mod idealized;
mod measure;
pub mod patch;
pub mod play;
mod realizable;
pub mod report;
mod request;
mod shape;
pub mod solver;
mod thorough;
pub mod warning;
pub mod worker;

pub use crate::soft_ik::Quality;
pub use body_spec::BodySpec;
pub use compile::winch_reach_mm;
pub use compiled::Effort;
pub use friction::{FrictionPose, FrictionPoseError, pose_with_friction};
pub use measure::target_error;
pub use play::Play;
pub use request::{Outcome, Request, Setpoint};
pub use shape::{EQUILIBRIUM, NEAR_EQUILIBRIUM, Shape};
pub use solver::{Solver, solve_once};
pub use warning::Warning;
