//! The convex subproblem of the all-at-once method, solved in its dual of the size of the targets.

use nalgebra::{DMatrix, DVector};

/// `min 1/2 |r_0 + J (tau - tau_k)|^2 + c (tau - tau_k) + rho/2 |tau|^2 + nu/2 |tau - tau_k|^2` over `lowest <= tau <= highest`.
///
/// With `q` the residual at the solution, `tau(q) = clamp((nu tau_k - c - J^T q)/(rho + nu))`; `q` solves
/// `q = r_0 + J (tau(q) - tau_k)`, the gradient of a convex function, found by a semismooth Newton method.
pub(super) struct Dual<'a> {
    pub residual: &'a DVector<f64>,
    pub jacobian: &'a DMatrix<f64>,
    pub linear: &'a DVector<f64>,
    pub now: &'a DVector<f64>,
    pub lowest: &'a DVector<f64>,
    pub highest: &'a DVector<f64>,
    pub rho: f64,
    pub nu: f64,
}

impl Dual<'_> {
    /// `nu tau_k - c - J^T q`, by which the tensions are pulled.
    fn pull(&self, q: &DVector<f64>) -> DVector<f64> {
        self.now * self.nu - self.linear - self.jacobian.tr_mul(q)
    }

    fn tension(&self, q: &DVector<f64>) -> DVector<f64> {
        let mut out = self.pull(q) / (self.rho + self.nu);
        for i in 0..out.len() {
            out[i] = out[i].min(self.highest[i]).max(self.lowest[i]);
        }
        out
    }

    /// Value of the dual function (to be minimised) and its gradient.
    fn value(&self, q: &DVector<f64>, tension: &DVector<f64>) -> (f64, DVector<f64>) {
        let gradient = q - self.residual - self.jacobian * (tension - self.now);
        let offset = self.residual - self.jacobian * self.now;
        let conjugate = self.pull(q).dot(tension) - 0.5 * (self.rho + self.nu) * tension.norm_squared();
        (0.5 * q.norm_squared() - q.dot(&offset) + conjugate, gradient)
    }

    pub fn solve(&self, start: DVector<f64>) -> (DVector<f64>, DVector<f64>) {
        let rows = self.residual.len();
        let mut q = start;
        let mut tension = self.tension(&q);
        let (mut value, mut gradient) = self.value(&q, &tension);
        for _ in 0..60 {
            if gradient.amax() <= 1e-12 * (self.residual.amax() + q.amax()) {
                break;
            }
            let mut matrix = DMatrix::identity(rows, rows);
            for i in 0..tension.len() {
                if tension[i] > self.lowest[i] && tension[i] < self.highest[i] {
                    let column = self.jacobian.column(i);
                    matrix.ger(1.0 / (self.rho + self.nu), &column, &column, 1.0);
                }
            }
            let Some(cholesky) = matrix.cholesky() else { break };
            let step = -cholesky.solve(&gradient);
            let slope = gradient.dot(&step);
            let mut t = 1.0;
            let mut moved = false;
            for _ in 0..30 {
                let trial = &q + &step * t;
                let trial_tension = self.tension(&trial);
                let (trial_value, trial_gradient) = self.value(&trial, &trial_tension);
                if trial_value <= value + 1e-4 * t * slope + 1e-14 * value.abs() {
                    (q, tension, value, gradient) = (trial, trial_tension, trial_value, trial_gradient);
                    moved = true;
                    break;
                }
                t *= 0.5;
            }
            if !moved {
                break;
            }
        }
        (q, tension)
    }
}
