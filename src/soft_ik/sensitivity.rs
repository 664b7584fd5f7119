//! Exact sensitivities of an equilibrium (eqs. 12 to 25).
//!
//! With `dE/dx = 0`: `H dx = -G^T U'' d(alpha_c)`, so `dx/dalpha_c = -H^-1 G^T U''` (the paper's `H^-1 A U''`, `A = -G^T`).
//! `H` is the full, unprojected Hessian with the contractile stiffness included.
//! Adjoint: `p = H^-1 dO/dx`, `dO/dalpha_c = -U'' (G p)` plus the explicit terms.

use super::Question;
use crate::physics::HessianForm;

/// Derivatives of `O` at an equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct Gradient {
    /// Total derivative by every element's contraction.
    pub by_contraction: Vec<f64>,
    /// Total derivative by every free winch's activation.
    pub by_activation: Vec<f64>,
}

/// `dO/dalpha_c` and `dO/dbeta` at the equilibrium `x` (all elements springs at `contractions`), by the adjoint: one
/// factorisation and one solve. `None` where the Hessian is not positive definite: no sensitivity exists there.
pub fn gradient(question: &mut Question, x: &[f64], contractions: &[f64]) -> Option<Gradient> {
    question.model.factorize(x, HessianForm::Exact).ok()?;
    Some(gradient_with_factor(question, x, contractions))
}

/// [`gradient`] with the exact Hessian at `x` already factorised.
pub fn gradient_with_factor(question: &mut Question, x: &[f64], contractions: &[f64]) -> Gradient {
    let model = &mut *question.model;
    let objective = question.objective;
    let laws: Vec<(f64, f64)> = model
        .contractile
        .elements
        .iter()
        .zip(&model.contractile.laws)
        .map(|(e, law)| law.tension_and_tangent(e, e.length(x)))
        .collect();
    let mut p = vec![0.0; x.len()];
    objective.position_gradient(x, &mut p);
    let mut by_tension = vec![0.0; laws.len()];
    if objective.tension_weight > 0.0 {
        for &(e, _) in question.actuation.winches.iter().flat_map(|w| &w.members) {
            by_tension[e] = objective.tension_weight * laws[e].0;
            model.contractile.elements[e].add_length_gradient(x, by_tension[e] * laws[e].1, &mut p);
        }
    }
    model.solve(&mut p);
    let by_contraction: Vec<f64> = model
        .contractile
        .elements
        .iter()
        .enumerate()
        .map(|(i, e)| {
            let tangent = laws[i].1;
            let explicit = objective.contraction_weight * contractions[i] / (e.alpha0 * e.alpha0);
            tangent * (by_tension[i] - e.length_rate(x, &p)) + explicit
        })
        .collect();
    let by_activation = question.actuation.collect(&by_contraction);
    Gradient { by_contraction, by_activation }
}

/// Columns that are solved for at once: enough for the solves to be fast, few enough to be stopped in between.
const COLUMNS: usize = 16;

/// `dx/dbeta`, column after column, with tangents `U''` given per element; the exact Hessian at `x` must be factorised. `None`
/// where `stop` has ended it.
pub fn position_jacobian(
    question: &mut Question,
    x: &[f64],
    tangents: &[f64],
    stop: &dyn Fn() -> bool,
) -> Option<Vec<f64>> {
    let n = x.len();
    let winches = &question.actuation.winches;
    let mut columns = vec![0.0; n * winches.len()];
    for (winch, column) in winches.iter().zip(columns.chunks_exact_mut(n)) {
        for &(e, ratio) in &winch.members {
            if tangents[e] != 0.0 {
                let element = &question.model.contractile.elements[e];
                element.add_length_gradient(x, -tangents[e] * ratio, column);
            }
        }
    }
    for some in columns.chunks_mut(COLUMNS * n) {
        if stop() {
            return None;
        }
        question.model.solve_many(some, some.len() / n);
    }
    Some(columns)
}
