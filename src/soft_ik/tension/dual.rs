//! The convex subproblem of the all-at-once method, solved in its dual of the size of the targets.

use crate::physics::wide::{self, Work, multiply_add};

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

/// Arrays that the solution works in; kept between subproblems.
#[derive(Default)]
pub(super) struct Dual {
    gradient: Vec<f64>,
    trial_gradient: Vec<f64>,
    step: Vec<f64>,
    trial: Vec<f64>,
    trial_tension: Vec<f64>,
    matrix: Vec<f64>,
    /// The rows of `J`, weighted, for a chunk of the elements.
    weighted: Vec<Part>,
}

/// Newton steps: the set of elements between their limits settles in a few.
const MAX_STEPS: usize = 60;
/// Halvings of a Newton step.
const MAX_HALVINGS: usize = 30;
/// Rows of the Newton matrix from which on it is asked whether to stop meanwhile: more than the few targets of a hand have.
const ROWS: usize = 32;
/// Largest entry of the gradient at which `q` counts as found, relative to the residuals.
const TOLERANCE: f64 = 1e-8;

impl Dual {
    /// Solves from the multipliers `q`; leaves the solution in `q` and `tension`. `false` where `stop` has ended the search.
    pub fn solve(&mut self, problem: &Subproblem, q: &mut [f64], tension: &mut [f64], stop: &dyn Fn() -> bool) -> bool {
        let rows = problem.residual.len();
        for buffer in [&mut self.gradient, &mut self.trial_gradient, &mut self.step, &mut self.trial] {
            buffer.resize(rows, 0.0);
        }
        self.trial_tension.resize(tension.len(), 0.0);
        self.matrix.resize(rows * rows, 0.0);
        self.weighted.resize(rows, [0.0; PART]);
        let mut value = problem.value(q, tension, &mut self.gradient);
        for _ in 0..MAX_STEPS {
            if largest(&self.gradient) <= TOLERANCE * (largest(problem.residual) + largest(q)) {
                break;
            }
            if !problem.hessian(tension, &mut self.matrix, &mut self.weighted, stop) {
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
                let next = problem.value(&self.trial, tau, g);
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

impl Dual {
    /// `J (tau - tau_k)` of the solution last found, where that was at the multipliers `q`.
    pub fn change<'a>(&'a self, residual: &'a [f64], q: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        q.iter().zip(residual).zip(&self.gradient).map(|((q, r), g)| q - r - g)
    }
}

impl Subproblem<'_> {
    fn rows(&self) -> std::slice::ChunksExact<'_, f64> {
        self.jacobian.chunks_exact(self.now.len().max(1))
    }

    /// `tau(q)` into `tension`; the dual function (to be minimised), and its gradient into `gradient`.
    fn value(&self, q: &[f64], tension: &mut [f64], gradient: &mut [f64]) -> f64 {
        let rest = wide::run(Choice { problem: self, q, tension, gradient });
        for ((g, q), r) in gradient.iter_mut().zip(q).zip(self.residual) {
            *g = q - r - *g;
        }
        0.5 * dot(q, q) - dot(q, self.residual) + rest
    }

    /// `I + J_F J_F^T/(rho + nu)` over the elements `F` between their limits; lower triangle, row by row. `false` where `stop` has
    /// ended it.
    fn hessian(&self, tension: &[f64], matrix: &mut [f64], weighted: &mut [Part], stop: &dyn Fn() -> bool) -> bool {
        matrix.fill(0.0);
        let n = self.residual.len();
        if !wide::run(Products { problem: self, tension, matrix: &mut *matrix, weighted, stop }) {
            return false;
        }
        for i in 0..n {
            matrix[i * n + i] += 1.0;
        }
        true
    }
}

/// The choice of all tensions: see [`Subproblem::value`]. Leaves `J (tau - tau_k)` in `gradient`; returns `q J tau_k` and the
/// conjugate.
struct Choice<'a> {
    problem: &'a Subproblem<'a>,
    q: &'a [f64],
    tension: &'a mut [f64],
    gradient: &'a mut [f64],
}

impl Work for Choice<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> f64 {
        let Choice { problem, q, tension, gradient } = self;
        let fma = multiply_add::<FUSED>;
        let count = tension.len();
        let weight = problem.rho + problem.nu;
        let inverse = weight.recip();
        gradient.fill(0.0);
        let mut conjugate = 0.0;
        for from in (0..count).step_by(PART) {
            let chunk = from..count.min(from + PART);
            let size = chunk.len().min(PART);
            let (mut pull, mut change, mut parts) = ([0.0; PART], [0.0; PART], [0.0; PART]);
            let (now, linear) = (&problem.now[chunk.clone()][..size], &problem.linear[chunk.clone()][..size]);
            let mut base = [0.0; PART];
            for l in 0..size {
                base[l] = fma(problem.nu, now[l], -linear[l]);
                pull[l] = base[l];
            }
            for (row, q) in problem.rows().zip(q) {
                for (pull, j) in pull[..size].iter_mut().zip(&row[chunk.clone()]) {
                    *pull = fma(-*q, *j, *pull);
                }
            }
            let (limits, tension) = (&problem.limits[chunk.clone()][..size], &mut tension[chunk.clone()][..size]);
            for l in 0..size {
                let tau = (pull[l] * inverse).min(limits[l][1]).max(limits[l][0]);
                parts[l] = fma(fma(-0.5 * weight, tau, pull[l]), tau, (base[l] - pull[l]) * now[l]);
                change[l] = tau - now[l];
                tension[l] = tau;
            }
            conjugate += sum(&parts);
            for (row, g) in problem.rows().zip(gradient.iter_mut()) {
                *g += product::<FUSED>(&row[chunk.clone()], &change[..size]);
            }
        }
        conjugate
    }
}

/// The products of the rows of `J`, weighted: see [`Subproblem::hessian`].
struct Products<'a> {
    problem: &'a Subproblem<'a>,
    tension: &'a [f64],
    matrix: &'a mut [f64],
    /// One row each.
    weighted: &'a mut [Part],
    stop: &'a dyn Fn() -> bool,
}

impl Work for Products<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> bool {
        let Products { problem, tension, matrix, weighted, stop } = self;
        let (n, count) = (problem.residual.len(), tension.len());
        let scale = (problem.rho + problem.nu).recip();
        for from in (0..count).step_by(PART) {
            if n > ROWS && stop() {
                return false;
            }
            let chunk = from..count.min(from + PART);
            let size = chunk.len().min(PART);
            let (tension, limits) = (&tension[chunk.clone()][..size], &problem.limits[chunk.clone()][..size]);
            let mut weights = [0.0; PART];
            for l in 0..size {
                let inside = tension[l] > limits[l][0] && tension[l] < limits[l][1];
                weights[l] = if inside { scale } else { 0.0 };
            }
            for (row, weighted) in problem.rows().zip(weighted.iter_mut()) {
                for ((out, j), w) in weighted[..size].iter_mut().zip(&row[chunk.clone()]).zip(&weights) {
                    *out = j * w;
                }
            }
            for (i, (a, entries)) in weighted.iter().zip(matrix.chunks_exact_mut(n.max(1))).enumerate() {
                for (entry, b) in entries[..=i].iter_mut().zip(problem.rows()) {
                    *entry += product::<FUSED>(&a[..size], &b[chunk.clone()]);
                }
            }
        }
        true
    }
}

/// Elements that are taken through a loop together: their rows of `J`, and these once more, weighted, stay in the nearest cache.
const PART: usize = 256;
type Part = [f64; PART];

/// Running sums in a dot product: independent of each other, so that they can be computed side by side.
const LANES: usize = 8;

/// `a b`.
#[inline(always)]
fn product<const FUSED: bool>(a: &[f64], b: &[f64]) -> f64 {
    let ((a, end), (b, other)) = (a.as_chunks::<LANES>(), b[..a.len()].as_chunks::<LANES>());
    let mut sums = [[0.0; LANES]; 2];
    let (mut pairs, last) = ((a.chunks_exact(2), b.chunks_exact(2)), a.len() % 2);
    for (a, b) in (&mut pairs.0).zip(&mut pairs.1) {
        for (sums, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            for l in 0..LANES {
                sums[l] = multiply_add::<FUSED>(a[l], b[l], sums[l]);
            }
        }
    }
    for (a, b) in a[a.len() - last..].iter().zip(&b[b.len() - last..]) {
        for l in 0..LANES {
            sums[0][l] = multiply_add::<FUSED>(a[l], b[l], sums[0][l]);
        }
    }
    let rest: f64 = end.iter().zip(other).map(|(a, b)| a * b).sum();
    let mut lanes = [0.0; LANES];
    for l in 0..LANES {
        lanes[l] = sums[0][l] + sums[1][l];
    }
    lanes.iter().sum::<f64>() + rest
}

/// The sum of all, of which any may be zero.
#[inline(always)]
fn sum(parts: &Part) -> f64 {
    let mut lanes = [0.0; LANES];
    for part in parts.as_chunks::<LANES>().0 {
        for l in 0..LANES {
            lanes[l] += part[l];
        }
    }
    lanes.iter().sum()
}

struct Dot<'a>(&'a [f64], &'a [f64]);

impl Work for Dot<'_> {
    type Output = f64;

    #[inline(always)]
    fn run<const FUSED: bool>(self) -> f64 {
        product::<FUSED>(self.0, self.1)
    }
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    wide::run(Dot(a, b))
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
