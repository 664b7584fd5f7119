//! What statics works in.

use crate::physics::model::Model;

/// What statics works in; kept between solves, so that a warm one allocates nothing.
#[derive(Debug, Default)]
pub struct Workspace {
    pub(super) gradient: Vec<f64>,
    pub(super) step: Vec<f64>,
    pub(super) trial: Vec<f64>,
    pub(super) trial_gradient: Vec<f64>,
    pub(super) forces: Vec<f64>,
    pub(super) rounding: Vec<f64>,
}

impl Workspace {
    /// Ready for models of this dimension; an empty one grows where it is first used.
    pub fn new(dimension: usize) -> Self {
        let zero = || vec![0.0; dimension];
        Self { gradient: zero(), step: zero(), trial: zero(), trial_gradient: zero(), forces: zero(), rounding: zero() }
    }

    /// Works out the forces at `x`; returns the largest unbalanced one and the forces at work, as [`Model::gradient_and_scale`].
    pub fn forces_at(&mut self, model: &Model, x: &[f64]) -> (f64, f64) {
        let n = x.len();
        for buffer in [&mut self.gradient, &mut self.step, &mut self.trial, &mut self.trial_gradient, &mut self.forces]
        {
            buffer.resize(n, 0.0);
        }
        let scale = model.gradient_and_scale(x, &mut self.gradient, &mut self.forces);
        (norm(&self.gradient), scale)
    }
}

/// `max |v|`, infinite for NaN.
pub fn norm(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |m, a| if a.is_nan() { f64::INFINITY } else { m.max(a.abs()) })
}
