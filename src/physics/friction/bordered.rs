//! The Jacobian of the law of friction: the symmetric matrix of statics and a border of few columns.

use super::Friction;
use super::cable::Cable;
use crate::physics::cholesky::NotPositiveDefinite;
use crate::physics::{HessianForm, Model};
use nalgebra::{DMatrix, DVector, Dyn, LU};

/// `J = H + P Q^T` at a state, factorised: `H` by the model's Cholesky factor, which must stay as it is, the border by
/// `(I + Q^T H^-1 P)`. Costs one factorisation and a solve for each hole at which a taut cable turns, and one for each such cable.
pub struct Bordered {
    /// Columns of `Q`.
    rows: Vec<Vec<(usize, f64)>>,
    /// `H^-1 P`, column after column.
    solved: Vec<f64>,
    /// `I + Q^T H^-1 P`.
    small: LU<f64, Dyn, Dyn>,
}

/// The border: columns of `P`, one after the other, and of `Q`, which have few entries.
#[derive(Default)]
struct Border {
    columns: Vec<f64>,
    rows: Vec<Vec<(usize, f64)>>,
}

impl Bordered {
    /// At `x`, with a `part` of every coefficient ([`Friction::residual`]).
    ///
    /// # Errors
    /// `H` is not positive definite in this form, or the whole is singular.
    pub fn new(
        friction: &Friction,
        model: &mut Model,
        x: &[f64],
        part: f64,
        form: HessianForm,
    ) -> Result<Self, NotPositiveDefinite> {
        model.assemble(x, form);
        let (mut border, mut first) = (Border::default(), 0);
        for cable in &friction.cables {
            let (tau, tangent) = cable.law(model, x);
            if tau > 0.0 {
                let turns = cable.turns(x);
                let weights = cable.weights_of(&turns, part);
                model.add_assembled(&friction.slots, |out| cable.add_curvature(x, &weights, tau, first, out));
                border.add(cable, x, [part, tau, tangent], &weights);
            }
            first += cable.pieces.len();
        }
        model.factorize_assembled()?;
        let Border { columns: mut solved, rows } = border;
        model.solve_many(&mut solved, rows.len());
        let (n, width) = (x.len(), rows.len());
        let small = DMatrix::from_fn(width, width, |i, j| {
            sparse_dot(&rows[i], &solved[j * n..(j + 1) * n]) + if i == j { 1.0 } else { 0.0 }
        });
        if !small.iter().all(|v| v.is_finite()) {
            return Err(NotPositiveDefinite);
        }
        let small = small.lu();
        if small.is_invertible() { Ok(Self { rows, solved, small }) } else { Err(NotPositiveDefinite) }
    }

    /// Solves `J z = rhs` in place. `None` where it has no solution.
    pub fn solve(&self, model: &mut Model, rhs: &mut [f64]) -> Option<()> {
        model.solve(rhs);
        if self.rows.is_empty() {
            return Some(());
        }
        let n = rhs.len();
        let projected = DVector::from_iterator(self.rows.len(), self.rows.iter().map(|row| sparse_dot(row, rhs)));
        let amounts = self.small.solve(&projected)?;
        for (column, amount) in self.solved.chunks_exact(n).zip(amounts.iter()) {
            rhs.iter_mut().zip(column).for_each(|(z, p)| *z -= amount * p);
        }
        Some(())
    }
}

impl Border {
    /// The columns of a taut cable: `U'' (g_w - g)` beside `g`, and for every hole `a_j` beside `dtheta_j/dx`.
    fn add(&mut self, cable: &Cable, x: &[f64], [part, tau, tangent]: [f64; 3], weights: &[f64]) {
        let (units, n) = (cable.units(x), x.len());
        let mut lost = vec![0.0; n];
        let mut length = Vec::new();
        for ((piece, unit), weight) in cable.pieces.iter().zip(&units).zip(weights) {
            piece.add(unit.map(|u| tangent * (weight - 1.0) * u), &mut lost);
            piece.push(*unit, &mut length);
        }
        self.columns.extend(lost);
        self.rows.push(length);
        // From the far end: what hangs behind a hole is what hangs behind the next one and the piece between.
        let mut behind = vec![0.0; n];
        for (j, turn) in cable.turns(x).iter().enumerate().rev() {
            let factor = -part * cable.mu * tau * weights[j + 1];
            cable.pieces[j + 1].add(units[j + 1].map(|u| factor * u), &mut behind);
            let mut row = Vec::new();
            cable.pieces[j].push(turn.by_before, &mut row);
            cable.pieces[j + 1].push(turn.by_after, &mut row);
            self.columns.extend_from_slice(&behind);
            self.rows.push(row);
        }
    }
}

fn sparse_dot(row: &[(usize, f64)], v: &[f64]) -> f64 {
    row.iter().map(|&(d, a)| a * v[d]).sum()
}
