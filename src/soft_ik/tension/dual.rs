//! The convex subproblem of the all-at-once method, solved in its dual of the size of the targets.

/// `min 1/2 |r_0 + J (tau - tau_k)|^2 + c (tau - tau_k) + rho/2 |tau|^2 + nu/2 |tau - tau_k|^2` over `lowest <= tau <= highest`.
///
/// With `q` the residual at the solution, `tau(q) = clamp((nu tau_k - c - J^T q)/(rho + nu))`; `q` solves
/// `q = r_0 + J (tau(q) - tau_k)`, the gradient of a convex function, found by a semismooth Newton method.
/// Cost of a Newton step: `O(rows^2 m)`.
pub(super) struct Subproblem<'a> {
    pub residual: &'a [f64],
    /// `J`, row after row.
    pub jacobian: &'a [f64],
    pub linear: &'a [f64],
    pub now: &'a [f64],
    /// `[lowest, highest]` tension of every element.
    pub limits: &'a [[f64; 2]],
    pub rho: f64,
    pub nu: f64,
}

/// What the solution works in; kept between subproblems.
#[derive(Default)]
pub(super) struct Dual {
    /// `r_0 - J tau_k`.
    offset: Vec<f64>,
    gradient: Vec<f64>,
    trial_gradient: Vec<f64>,
    step: Vec<f64>,
    trial: Vec<f64>,
    trial_tension: Vec<f64>,
    matrix: Vec<f64>,
    /// `tau - tau_k`, and the weights of the elements in the Newton matrix.
    change: Vec<f64>,
}

/// Newton steps: the set of elements between their limits settles in a few.
const MAX_STEPS: usize = 60;
/// Halvings of a Newton step.
const MAX_HALVINGS: usize = 30;
/// Rows of the Newton matrix between two questions whether to stop: more than the few targets of a hand have.
const ROWS: usize = 32;
/// Largest entry of the gradient at which `q` counts as found, relative to the residuals.
const TOLERANCE: f64 = 1e-8;

impl Dual {
    /// Solves from the multipliers `q`; leaves the solution in `q` and `tension`. `false` where `stop` has ended the search.
    pub fn solve(&mut self, problem: &Subproblem, q: &mut [f64], tension: &mut [f64], stop: &dyn Fn() -> bool) -> bool {
        let rows = problem.residual.len();
        for buffer in [&mut self.offset, &mut self.gradient, &mut self.trial_gradient, &mut self.step, &mut self.trial]
        {
            buffer.resize(rows, 0.0);
        }
        self.trial_tension.resize(tension.len(), 0.0);
        self.matrix.resize(rows * rows, 0.0);
        for ((o, r), row) in self.offset.iter_mut().zip(problem.residual).zip(problem.rows()) {
            *o = r - dot(row, problem.now);
        }
        self.change.resize(tension.len(), 0.0);
        let mut value = problem.value(q, &self.offset, tension, &mut self.gradient, &mut self.change);
        for _ in 0..MAX_STEPS {
            if largest(&self.gradient) <= TOLERANCE * (largest(problem.residual) + largest(q)) {
                break;
            }
            if !problem.hessian(tension, &mut self.matrix, &mut self.change, stop) {
                return false;
            }
            for (s, g) in self.step.iter_mut().zip(&self.gradient) {
                *s = -g;
            }
            if !solve_positive_definite(&mut self.matrix, &mut self.step) {
                break;
            }
            let slope = dot(&self.gradient, &self.step);
            let mut t = 1.0;
            let mut moved = false;
            for _ in 0..MAX_HALVINGS {
                for ((p, q), s) in self.trial.iter_mut().zip(q.iter()).zip(&self.step) {
                    *p = q + t * s;
                }
                let (tau, g) = (&mut self.trial_tension, &mut self.trial_gradient);
                let next = problem.value(&self.trial, &self.offset, tau, g, &mut self.change);
                if next <= value + 1e-4 * t * slope + 1e-14 * value.abs() {
                    q.copy_from_slice(&self.trial);
                    tension.copy_from_slice(&self.trial_tension);
                    std::mem::swap(&mut self.gradient, &mut self.trial_gradient);
                    value = next;
                    moved = true;
                    break;
                }
                t *= 0.5;
            }
            if !moved {
                break;
            }
        }
        true
    }
}

impl Subproblem<'_> {
    fn rows(&self) -> std::slice::ChunksExact<'_, f64> {
        self.jacobian.chunks_exact(self.now.len().max(1))
    }

    /// `tau(q)` into `tension`; the dual function (to be minimised), and its gradient into `gradient`.
    fn value(&self, q: &[f64], offset: &[f64], tension: &mut [f64], gradient: &mut [f64], change: &mut [f64]) -> f64 {
        let weight = self.rho + self.nu;
        for ((t, now), c) in tension.iter_mut().zip(self.now).zip(self.linear) {
            *t = self.nu * now - c;
        }
        for (row, q) in self.rows().zip(q) {
            axpy(-q, row, tension);
        }
        let mut conjugate = 0.0;
        for (((t, d), now), limits) in tension.iter_mut().zip(change.iter_mut()).zip(self.now).zip(self.limits) {
            let pull = *t;
            let tau = (pull / weight).min(limits[1]).max(limits[0]);
            conjugate += (pull - 0.5 * weight * tau) * tau;
            *d = tau - now;
            *t = tau;
        }
        for (((g, q), r), row) in gradient.iter_mut().zip(q).zip(self.residual).zip(self.rows()) {
            *g = q - r - dot(row, change);
        }
        0.5 * dot(q, q) - dot(q, offset) + conjugate
    }

    /// `I + J_F J_F^T/(rho + nu)` over the elements `F` between their limits; lower triangle, row by row. `false` where `stop` has
    /// ended it.
    fn hessian(&self, tension: &[f64], matrix: &mut [f64], weights: &mut [f64], stop: &dyn Fn() -> bool) -> bool {
        let n = self.residual.len();
        let scale = 1.0 / (self.rho + self.nu);
        for ((w, tau), limits) in weights.iter_mut().zip(tension).zip(self.limits) {
            *w = if *tau > limits[0] && *tau < limits[1] { scale } else { 0.0 };
        }
        for (i, a) in self.rows().enumerate() {
            if i % ROWS == ROWS - 1 && stop() {
                return false;
            }
            for (j, b) in self.rows().take(i + 1).enumerate() {
                matrix[i * n + j] = dot3(a, b, weights) + (i == j) as usize as f64;
            }
        }
        true
    }
}

/// Running sums in a dot product: independent of each other, so that they can be computed side by side.
const LANES: usize = 8;

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (mut a, mut b) = (a.chunks_exact(LANES), b[..a.len()].chunks_exact(LANES));
    let mut sums = [0.0; LANES];
    for (a, b) in (&mut a).zip(&mut b) {
        for l in 0..LANES {
            sums[l] += a[l] * b[l];
        }
    }
    let rest: f64 = a.remainder().iter().zip(b.remainder()).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}

fn dot3(a: &[f64], b: &[f64], c: &[f64]) -> f64 {
    let n = a.len();
    let (mut a, mut b, mut c) = (a.chunks_exact(LANES), b[..n].chunks_exact(LANES), c[..n].chunks_exact(LANES));
    let mut sums = [0.0; LANES];
    for ((a, b), c) in (&mut a).zip(&mut b).zip(&mut c) {
        for l in 0..LANES {
            sums[l] += a[l] * b[l] * c[l];
        }
    }
    let rest = a.remainder().iter().zip(b.remainder()).zip(c.remainder()).map(|((a, b), c)| a * b * c);
    sums.iter().sum::<f64>() + rest.sum::<f64>()
}

/// `y += factor x`.
pub(super) fn axpy(factor: f64, x: &[f64], y: &mut [f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}

fn largest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |m: f64, a| m.max(a.abs()))
}

/// `rhs := A^-1 rhs` for the lower triangle `a` (row by row), which becomes its Cholesky factor. Without allocation, which is
/// why it stands here. Whether `A` is positive definite.
fn solve_positive_definite(a: &mut [f64], rhs: &mut [f64]) -> bool {
    let n = rhs.len();
    for i in 0..n {
        for j in 0..=i {
            let (before, row) = a.split_at_mut(i * n);
            let mut sum = row[j];
            let other = if j < i { &before[j * n..j * n + j] } else { &row[..j] };
            sum -= dot(&row[..j], other);
            if j < i {
                row[j] = sum / before[j * n + j];
            } else if sum > 0.0 {
                row[i] = sum.sqrt();
            } else {
                return false;
            }
        }
        rhs[i] = (rhs[i] - dot(&a[i * n..i * n + i], &rhs[..i])) / a[i * n + i];
    }
    for i in (0..n).rev() {
        rhs[i] /= a[i * n + i];
        let (head, last) = rhs.split_at_mut(i);
        axpy(-last[0], &a[i * n..i * n + i], head);
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_systems_are_solved() {
        let mut a = [4.0, 0.0, 0.0, 2.0, 5.0, 0.0, -1.0, 0.5, 3.0];
        let full = [[4.0, 2.0, -1.0], [2.0, 5.0, 0.5], [-1.0, 0.5, 3.0]];
        let z = [0.3, -0.7, 1.1];
        let mut rhs = full.map(|row| dot(&row, &z));
        assert!(solve_positive_definite(&mut a, &mut rhs));
        for (a, b) in rhs.iter().zip(z) {
            assert!((a - b).abs() < 1e-15);
        }
        assert!(!solve_positive_definite(&mut [-1.0], &mut [1.0]));
    }

    /// The optimality conditions of the primal problem hold at the solution.
    #[test]
    fn the_dual_solves_the_primal() {
        let (rows, m) = (4, 60);
        let wave = |i: usize| (1.7 * i as f64 + 0.3 * (i * i) as f64).sin();
        let jacobian: Vec<f64> = (0..rows * m).map(wave).collect();
        let linear: Vec<f64> = (0..m).map(|i| 0.2 * wave(i + 5)).collect();
        let now: Vec<f64> = (0..m).map(|i| 0.5 + 0.4 * wave(i + 9)).collect();
        let limits: Vec<[f64; 2]> = (0..m).map(|i| [0.0, 0.6 + 0.3 * wave(i + 2)]).collect();
        let residual = [1.0, -2.0, 0.5, 0.1];
        let problem = Subproblem {
            residual: &residual,
            jacobian: &jacobian,
            linear: &linear,
            now: &now,
            limits: &limits,
            rho: 0.1,
            nu: 0.4,
        };
        let (mut q, mut tension) = (residual, vec![0.0; m]);
        assert!(Dual::default().solve(&problem, &mut q, &mut tension, &|| false));
        let mut r = residual;
        for (r, row) in r.iter_mut().zip(jacobian.chunks_exact(m)) {
            *r += dot(row, &tension) - dot(row, &now);
        }
        let mut inside = 0;
        for k in 0..m {
            let along: f64 = (0..rows).map(|i| jacobian[i * m + k] * r[i]).sum();
            let slope = along + linear[k] + problem.rho * tension[k] + problem.nu * (tension[k] - now[k]);
            if tension[k] <= limits[k][0] {
                assert!(slope >= -1e-6);
            } else if tension[k] >= limits[k][1] {
                assert!(slope <= 1e-6);
            } else {
                inside += 1;
                assert!(slope.abs() < 1e-6, "{slope}");
            }
        }
        assert!(inside > 3 && inside < m);
    }
}
