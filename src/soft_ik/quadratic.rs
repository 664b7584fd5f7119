//! Bound-constrained quadratic models: `min g d + 1/2 d (R^T R + D) d`, `lower <= d <= upper`.
//!
//! Solved by a projected Newton method (Bertsekas 1982): variables at a bound with the gradient pushing outward are held, the
//! Newton step of the others is projected and searched along the projection arc. `R` has few rows where only targets count:
//! then each step costs `O(rows^2 m)` by the Woodbury identity instead of `O(m^3)`.

use nalgebra::{DMatrix, DVector};

/// Newton steps: the set of held variables settles in a few.
const MAX_STEPS: usize = 60;
/// Halvings along the projection arc.
const MAX_HALVINGS: usize = 30;

pub struct Quadratic {
    pub gradient: DVector<f64>,
    /// Rows of the residuals' Jacobian.
    pub rows: DMatrix<f64>,
    /// Diagonal part, positive where a variable has no row.
    pub diagonal: DVector<f64>,
    pub lower: Vec<f64>,
    pub upper: Vec<f64>,
    /// `R^T R`, where every step would need it ([`Self::prepare`]).
    pub gram: Option<DMatrix<f64>>,
}

/// Columns of `R^T R` between two questions whether to stop.
const COLUMNS: usize = 32;

impl Quadratic {
    /// Works out what all steps share: `O(rows m^2)`. `None` where `stop` has ended it.
    pub fn prepare(&mut self, stop: &dyn Fn() -> bool) -> Option<()> {
        let m = self.gradient.len();
        if self.rows.nrows() < m {
            return Some(());
        }
        let mut gram = DMatrix::zeros(m, m);
        for first in (0..m).step_by(COLUMNS) {
            if stop() {
                return None;
            }
            let count = COLUMNS.min(m - first);
            gram.columns_mut(first, count).gemm_tr(1.0, &self.rows, &self.rows.columns(first, count), 0.0);
        }
        self.gram = Some(gram);
        Some(())
    }

    /// The largest decrease that the model promises for moving one activation alone, within its bounds.
    pub fn best_single_promise(&self) -> f64 {
        let curvatures = self.curvatures();
        (0..self.gradient.len())
            .map(|j| {
                let (slope, curvature) = (self.gradient[j], curvatures[j].max(f64::MIN_POSITIVE));
                let step = (-slope / curvature).max(self.lower[j]).min(self.upper[j]);
                -slope * step - 0.5 * curvature * step * step
            })
            .fold(0.0, f64::max)
    }

    /// The diagonal of `R^T R + D`.
    pub fn curvatures(&self) -> DVector<f64> {
        DVector::from_fn(self.gradient.len(), |j, _| self.rows.column(j).norm_squared() + self.diagonal[j])
    }

    /// `g d + 1/2 d (R^T R + D + damping) d`, and its gradient.
    fn value(&self, damping: &DVector<f64>, d: &DVector<f64>) -> (f64, DVector<f64>) {
        let product = self.rows.tr_mul(&(&self.rows * d)) + (&self.diagonal + damping).component_mul(d);
        (self.gradient.dot(d) + 0.5 * product.dot(d), &self.gradient + product)
    }

    /// The decrease that the undamped model promises for `d`.
    pub fn promise(&self, d: &DVector<f64>) -> f64 {
        -self.value(&DVector::zeros(d.len()), d).0
    }

    /// The minimiser with `damping` added to the diagonal; `None` where `stop` has ended the search.
    pub fn minimise(&self, damping: &DVector<f64>, stop: &dyn Fn() -> bool) -> Option<DVector<f64>> {
        let m = self.gradient.len();
        let clamp = |j: usize, v: f64| v.max(self.lower[j]).min(self.upper[j]);
        let mut d = DVector::from_fn(m, |j, _| clamp(j, 0.0));
        let (mut value, mut gradient) = self.value(damping, &d);
        for _ in 0..MAX_STEPS {
            if stop() {
                return None;
            }
            let free: Vec<usize> = (0..m)
                .filter(|&j| {
                    !(d[j] <= self.lower[j] && gradient[j] > 0.0 || d[j] >= self.upper[j] && gradient[j] < 0.0)
                })
                .collect();
            let Some(step) = self.newton(damping, &free, &gradient) else { break };
            let mut t = 1.0;
            let mut moved = false;
            for _ in 0..MAX_HALVINGS {
                let mut trial = d.clone();
                for (&j, s) in free.iter().zip(step.iter()) {
                    trial[j] = clamp(j, d[j] + t * s);
                }
                let (trial_value, trial_gradient) = self.value(damping, &trial);
                if trial_value < value - 1e-4 * (gradient.dot(&d) - gradient.dot(&trial)).abs() {
                    moved = value - trial_value > 1e-12 * trial_value.abs();
                    (d, value, gradient) = (trial, trial_value, trial_gradient);
                    break;
                }
                t *= 0.5;
            }
            if !moved {
                break;
            }
        }
        Some(d)
    }

    /// `-(R^T R + D + damping)^-1 gradient` on the free variables.
    fn newton(&self, damping: &DVector<f64>, free: &[usize], gradient: &DVector<f64>) -> Option<DVector<f64>> {
        let rhs = DVector::from_fn(free.len(), |a, _| -gradient[free[a]]);
        let diagonal = DVector::from_fn(free.len(), |a, _| self.diagonal[free[a]] + damping[free[a]]);
        if self.rows.nrows() < free.len() && diagonal.iter().all(|v| *v > 0.0) {
            let rows = self.rows.select_columns(free);
            // (D + R^T R)^-1 b = D^-1 b - D^-1 R^T (I + R D^-1 R^T)^-1 R D^-1 b
            let mut scaled = rows.clone();
            for (a, mut column) in scaled.column_iter_mut().enumerate() {
                column /= diagonal[a];
            }
            let small = DMatrix::identity(rows.nrows(), rows.nrows()) + &scaled * rows.transpose();
            let first = rhs.component_div(&diagonal);
            let inner = small.cholesky()?.solve(&(&rows * &first));
            Some(first - scaled.tr_mul(&inner))
        } else {
            let mut matrix = match &self.gram {
                Some(gram) => gram.select_columns(free).select_rows(free),
                None => {
                    let rows = self.rows.select_columns(free);
                    rows.tr_mul(&rows)
                }
            };
            for a in 0..free.len() {
                matrix[(a, a)] += diagonal[a];
            }
            Some(matrix.cholesky()?.solve(&rhs))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A random model; `rows` below and above the number of variables takes both ways of solving.
    fn model(rows: usize, m: usize, seed: u64) -> Quadratic {
        let mut state = seed;
        let mut random = move || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as f64 / (1u64 << 31) as f64 - 0.5
        };
        Quadratic {
            gradient: DVector::from_fn(m, |_, _| random()),
            rows: DMatrix::from_fn(rows, m, |_, _| random()),
            diagonal: DVector::from_fn(m, |_, _| 0.01 + random().abs() * 0.1),
            lower: (0..m).map(|_| -random().abs()).collect(),
            upper: (0..m).map(|_| random().abs()).collect(),
            gram: None,
        }
    }

    #[test]
    fn a_search_ends_when_it_is_told_to() {
        let mut quadratic = model(30, 20, 7);
        let damping = DVector::zeros(20);
        let plain = quadratic.minimise(&damping, &|| false).unwrap();
        assert!(quadratic.prepare(&|| true).is_none() && quadratic.gram.is_none());
        assert!(quadratic.minimise(&damping, &|| true).is_none());
        quadratic.prepare(&|| false).unwrap();
        let prepared = quadratic.minimise(&damping, &|| false).unwrap();
        assert!((plain - prepared).norm() < 1e-10);
    }

    #[test]
    fn the_minimiser_satisfies_the_optimality_conditions() {
        for (rows, m, seed) in [(3, 20, 1), (30, 20, 2), (1, 2, 3), (8, 60, 4), (80, 60, 5)] {
            let quadratic = model(rows, m, seed);
            let damping = DVector::zeros(m);
            let d = quadratic.minimise(&damping, &|| false).unwrap();
            let (_, gradient) = quadratic.value(&damping, &d);
            for j in 0..m {
                assert!(d[j] >= quadratic.lower[j] && d[j] <= quadratic.upper[j]);
                let tolerance = 1e-5;
                if d[j] > quadratic.lower[j] {
                    assert!(gradient[j] < tolerance, "{rows} x {m}: {j} wants down, {}", gradient[j]);
                }
                if d[j] < quadratic.upper[j] {
                    assert!(gradient[j] > -tolerance, "{rows} x {m}: {j} wants up, {}", gradient[j]);
                }
            }
        }
    }
}
