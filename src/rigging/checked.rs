//! What a check says of one pose of a rig.

use crate::design::{Design, Target};
use crate::engine::{Setpoint, Shape, pose_with_friction, solve_once};
use std::sync::atomic::{AtomicBool, Ordering};

/// A pose of the realizable plushie, wound from rest with all effort.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    pub shape: Shape,
    /// Rms distance of the targets in body lengths when cables rub and have been pulled; `None` without friction, infinite where there is no
    /// such figure.
    pub with_friction: Option<f64>,
}

impl Checked {
    /// The pose of a design towards targets, with a coefficient of friction at the holes.
    pub fn of(design: &Design, targets: &[Target], friction: f64, cancel: &AtomicBool) -> Self {
        let setpoint = Setpoint::Targets(targets.to_vec());
        let solved = solve_once(design, setpoint, [false, true], cancel).realizable;
        let shape = solved.unwrap_or_else(|| Shape { target_error: f64::INFINITY, ..Shape::default() });
        let rubs = friction > 0.0 && !design.networks.is_empty() && !targets.is_empty();
        let with_friction = rubs.then(|| {
            let stop = || cancel.load(Ordering::Relaxed);
            let found = pose_with_friction(design, targets, &shape.activations_mm, friction, &stop);
            found.map_or(f64::INFINITY, |found| found.error)
        });
        Self { shape, with_friction }
    }

    /// Rms distance of the targets in body lengths, without friction.
    pub fn error(&self) -> f64 {
        self.shape.target_error
    }

    /// With friction, where there is any: what a real plushie does.
    pub fn real_error(&self) -> f64 {
        self.with_friction.unwrap_or(self.shape.target_error)
    }
}
