//! Steps with a factor that is at hand.

use super::workspace::{Workspace, norm};
use crate::physics::model::Model;

/// How far steps with a factor that is at hand go on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reuse {
    /// Residual at which they end, force.
    pub enough: f64,
    /// The part of the residual that a step may leave at most; else it is not taken, and was the last.
    pub left: f64,
    pub steps: usize,
}

impl Reuse {
    /// Takes steps from `x`, whose forces are in `work`; see [`Workspace::forces_at`]. Returns the residual reached. Nothing
    /// happens where the model has no factor.
    pub fn settle(&self, model: &mut Model, x: &mut [f64], work: &mut Workspace) -> f64 {
        let Workspace { gradient, step, trial, trial_gradient, .. } = work;
        if model.has_factor() {
            self.steps(model, x, [&mut *gradient, step, trial, trial_gradient]);
        }
        norm(gradient)
    }

    /// Returns how many steps were taken. The first buffer holds the forces at `x`, before and after.
    pub(super) fn steps(&self, model: &mut Model, x: &mut [f64], buffers: [&mut Vec<f64>; 4]) -> usize {
        let [gradient, step, trial, trial_gradient] = buffers;
        for taken in 0..self.steps {
            let residual = norm(gradient);
            if residual <= self.enough {
                return taken;
            }
            for (s, g) in step.iter_mut().zip(gradient.iter()) {
                *s = -g;
            }
            model.solve(step);
            if model.step_limit(x, step) < 1.0 {
                return taken;
            }
            for ((p, x), s) in trial.iter_mut().zip(x.iter()).zip(step.iter()) {
                *p = x + s;
            }
            model.gradient(trial, trial_gradient);
            if norm(trial_gradient) > self.left * residual {
                return taken;
            }
            x.copy_from_slice(trial);
            std::mem::swap(gradient, trial_gradient);
        }
        self.steps
    }
}
