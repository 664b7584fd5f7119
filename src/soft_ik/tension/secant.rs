//! The curvature that linearised residuals leave out.
//!
//! With the residuals `r` of the targets and their Jacobian `J` by the tensions, the Hessian of `1/2 |r|^2` is `J^T J + S`,
//! `S = sum r_i d2r_i`. Where targets are out of reach `S` is not small: a limb that is pulled beyond its end swings on an arc.
//! What it does along a step `s` is known after the step, `S s ~ w = (J_+ - J)^T r_+` (Dennis, Gay, Welsch, *An adaptive
//! nonlinear least-squares algorithm*, 1981). The symmetric matrix of rank one that does the same is `z z^T` with
//! `z = w / sqrt(s w)`: one more row of `J`, whose residual is zero. Negative curvature is left out, so that the choice of
//! tensions stays convex.

use super::dual::{axpy, dot};

/// Least cosine of the angle between `s` and `w`: below it `z` would be long and say little about `S`.
const LEAST_COSINE: f64 = 0.03;

/// The curvature that the last step has shown.
pub(super) struct Secant {
    /// `J` where the last step began, row after row, `z` below it, and the step; nothing where there is no such step.
    jacobian: Vec<f64>,
    step: Vec<f64>,
    taken: bool,
    change: Vec<f64>,
    /// `z`; zero where nothing is known.
    pub row: Vec<f64>,
}

impl Secant {
    pub fn new(elements: usize, rows: usize) -> Self {
        let zero = || vec![0.0; elements];
        Self { jacobian: vec![0.0; elements * (rows + 1)], step: zero(), taken: false, change: zero(), row: zero() }
    }

    /// Other targets: nothing is known.
    pub fn forget(&mut self) {
        self.taken = false;
        self.row.fill(0.0);
    }

    /// The state was left on another way than by a step.
    pub fn interrupt(&mut self) {
        self.taken = false;
    }

    /// A part of the step from tensions `now` to `next` is taken, where the Jacobian is `jacobian` (with room for `z` below it); it
    /// is exchanged for another of the same size.
    pub fn leave(&mut self, jacobian: &mut Vec<f64>, now: &[f64], next: &[f64], part: f64) {
        self.jacobian.resize(jacobian.len(), 0.0);
        std::mem::swap(&mut self.jacobian, jacobian);
        for ((s, now), next) in self.step.iter_mut().zip(now).zip(next) {
            *s = part * (next - now);
        }
        self.taken = part > 0.0;
    }

    /// Learns from the step that led here, with Jacobian and residuals as they are here.
    pub fn arrive(&mut self, jacobian: &[f64], residual: &[f64]) {
        if !std::mem::take(&mut self.taken) {
            return;
        }
        let count = self.step.len().max(1);
        self.change.fill(0.0);
        for (matrix, sign) in [(jacobian, 1.0), (&self.jacobian, -1.0)] {
            for (row, r) in matrix.chunks_exact(count).zip(residual) {
                axpy(sign * r, row, &mut self.change);
            }
        }
        let (s, w) = (&self.step, &self.change);
        let along = dot(s, w);
        let known = along > LEAST_COSINE * (dot(s, s) * dot(w, w)).sqrt();
        let factor = if known { along.sqrt().recip() } else { 0.0 };
        for (z, w) in self.row.iter_mut().zip(&self.change) {
            *z = if known { factor * w } else { 0.0 };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two residuals of two unknowns, `r = (x^2 + y - 9, x y)`, with their Jacobian.
    fn residuals([x, y]: [f64; 2]) -> ([f64; 2], [f64; 4]) {
        ([x * x + y - 9.0, x * y], [2.0 * x, 1.0, y, x])
    }

    /// With room for the row of the secant.
    fn below(jacobian: &[f64]) -> Vec<f64> {
        [jacobian, &[0.0; 2]].concat()
    }

    #[test]
    fn the_row_gives_the_change_of_the_gradient_along_the_step() {
        let ([a, b], mut secant) = ([[2.0, 1.0], [3.5, 1.5]], Secant::new(2, 2));
        let ((_, before), (r, after)) = (residuals(a), residuals(b));
        secant.leave(&mut below(&before), &a, &b, 1.0);
        secant.arrive(&after, &r);
        let s = [b[0] - a[0], b[1] - a[1]];
        let along = dot(&secant.row, &s);
        for k in 0..2 {
            let w: f64 = (0..2).map(|i| (after[2 * i + k] - before[2 * i + k]) * r[i]).sum();
            assert!((secant.row[k] * along - w).abs() < 1e-12, "{k}");
        }
        // Without a step nothing is learnt; with other targets nothing is known.
        let row = secant.row.clone();
        secant.arrive(&before, &r);
        assert_eq!(secant.row, row);
        secant.forget();
        assert_eq!(secant.row, [0.0, 0.0]);
    }

    #[test]
    fn negative_curvature_is_left_out() {
        let ([a, b], mut secant) = ([[2.0, 1.0], [2.5, 1.0]], Secant::new(2, 2));
        let ((_, before), (r, after)) = (residuals(a), residuals(b));
        secant.leave(&mut below(&before), &a, &b, 1.0);
        secant.arrive(&after, &[-r[0].abs(), 0.0]);
        assert_eq!(secant.row, [0.0, 0.0]);
        secant.leave(&mut below(&before), &a, &b, 0.0);
        secant.arrive(&after, &[1.0, 0.0]);
        assert_eq!(secant.row, [0.0, 0.0], "no part of the step was taken");
    }
}
