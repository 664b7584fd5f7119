//! What a rig really reaches: what a check of the finished design says.

use crate::design::{Design, Target};
use crate::engine::{Effort, Quality, Request, Setpoint, Shape, Solver};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// The realizable plushie of a design in a pose, with all effort and wound from rest. `None` where the design has no model.
pub fn realised(design: &Design, targets: &[Target], cancel: &AtomicBool) -> Option<Shape> {
    let request = Request {
        id: 0,
        design: Arc::new(design.clone()),
        setpoint: Setpoint::Targets(targets.to_vec()),
        quality: Quality::Accurate,
        show_idealized: false,
        show_realizable: true,
    };
    Solver::default().solve_with(&request, Effort::Thorough, cancel).realizable
}
