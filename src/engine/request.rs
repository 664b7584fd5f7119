//! What the worker is asked for, and its answer.

use super::shape::Shape;
use crate::design::{Design, Target};
use crate::soft_ik::Quality;
use std::sync::Arc;

/// A request to the worker. The newest one wins.
#[derive(Clone, Debug)]
pub struct Request {
    /// Chosen by the caller and returned in the outcome.
    pub id: u64,
    pub design: Arc<Design>,
    pub setpoint: Setpoint,
    /// How much work a frame may take while a hand drags ([`super::Effort::Interactive`]).
    pub quality: Quality,
    /// A view that is not shown is not solved, see [`Request::solves`].
    pub show_idealized: bool,
    pub show_realizable: bool,
}

impl Request {
    /// Which plushies are solved: idealized, realizable. What is not shown is not, with one exception: the fibres of the
    /// idealized plushie add to what the winches reach, so where winches have to be searched for, they are.
    pub fn solves(&self) -> [bool; 2] {
        let searched = matches!(&self.setpoint, Setpoint::Targets(targets) if !targets.is_empty());
        let builds_on_winches = self.show_idealized && searched && !self.design.networks.is_empty();
        [self.show_idealized, self.show_realizable || builds_on_winches]
    }
}

/// The state that the plushies are to take.
#[derive(Clone, Debug)]
pub enum Setpoint {
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
