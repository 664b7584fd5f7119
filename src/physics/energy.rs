//! The one place where an energy term plugs in.

use super::pattern::Scatter;

/// Which second derivative is assembled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HessianForm {
    /// The true Hessian: for Newton steps near a minimum and for every sensitivity.
    Exact,
    /// Each local block projected to positive semi-definite: a descent step where the exact one is not convex. Never
    /// for sensitivities.
    Projected,
}

/// Relative change of coordinates by which sensitivity to rounding is measured: ten orders above rounding itself.
pub const ROUNDING: f64 = 1e-6;

/// A term of the total energy. Local stencils are node lists that never change while a model lives, so that the
/// sparsity pattern is fixed.
pub trait Energy: Send + Sync {
    /// Number of stencils.
    fn stencils(&self) -> usize;

    /// The distinct nodes of stencil `k`.
    fn stencil(&self, k: usize) -> &[usize];

    /// The energy at `x`; infinite outside the term's domain, never NaN.
    fn value(&self, x: &[f64]) -> f64;

    /// Adds `dE/dx` to `gradient`.
    fn add_gradient(&self, x: &[f64], gradient: &mut [f64]);

    /// Adds `d2E/dx2`, one 2 x 2 block per pair of stencil nodes.
    fn add_hessian(&self, x: &[f64], form: HessianForm, out: &mut Scatter);

    /// The energy that a shift of the whole body by `by` adds, of a term that does not move along: the same in every state. Zero where
    /// the term does not depend on where the body is.
    fn of_shift(&self, by: [f64; 2]) -> f64 {
        let _ = by;
        0.0
    }

    /// Largest step `t <= 1` along `dx` that stays inside the domain with a margin.
    fn step_limit(&self, x: &[f64], dx: &[f64]) -> f64 {
        let _ = (x, dx);
        1.0
    }

    /// Adds, entry by entry, what a residual is compared with.
    fn add_scales(&self, x: &[f64], scales: &mut Scales);

    /// [`Self::add_gradient`] and [`Self::add_scales`], where one pass costs less than two.
    fn add_gradient_and_scales(&self, x: &[f64], gradient: &mut [f64], scales: &mut Scales) {
        self.add_gradient(x, gradient);
        self.add_scales(x, scales);
    }
}

/// Magnitudes that a residual is small against, entry by entry.
pub struct Scales<'a> {
    at_work: &'a mut [f64],
    rounding: Option<&'a mut [f64]>,
}

impl<'a> Scales<'a> {
    /// Both sums on their own.
    pub fn apart(at_work: &'a mut [f64], rounding: &'a mut [f64]) -> Self {
        at_work.fill(0.0);
        rounding.fill(0.0);
        Self { at_work, rounding: Some(rounding) }
    }

    /// Both in one sum.
    pub fn together(sum: &'a mut [f64]) -> Self {
        sum.fill(0.0);
        Self { at_work: sum, rounding: None }
    }

    /// The magnitude of one of the forces that meet in both components of a node.
    pub fn add_force(&mut self, node: usize, magnitudes: [f64; 2]) {
        for (axis, magnitude) in magnitudes.into_iter().enumerate() {
            self.at_work[2 * node + axis] += magnitude;
        }
    }

    /// Both at once, the rounding the same in both components.
    #[inline(always)]
    pub fn add(&mut self, node: usize, force: [f64; 2], rounding: f64) {
        if self.rounding.is_some() {
            self.add_force(node, force);
            self.add_rounding(node, [rounding; 2]);
            return;
        }
        self.at_work[2 * node] += force[0] + rounding;
        self.at_work[2 * node + 1] += force[1] + rounding;
    }

    /// What a change of the coordinates by [`ROUNDING`] of their size does to a force.
    pub fn add_rounding(&mut self, node: usize, magnitudes: [f64; 2]) {
        let sum = self.rounding.as_deref_mut().unwrap_or(self.at_work);
        for (axis, magnitude) in magnitudes.into_iter().enumerate() {
            sum[2 * node + axis] += magnitude;
        }
    }
}
