//! The quadratic model within the bounds.
//!
//! First by active sets ([`active`]), which a few rounds find where those of the last linearisation are nearly right. Where they go round
//! in circles a primal-dual interior-point method takes over ([`interior`]; Mehrotra, SIAM J. Optim. 2, 1992), whose count of steps
//! does not depend on the bounds, and a projected Newton step puts what it found on them (Bertsekas, SIAM J. Control Optim. 20, 1982).
//! A round, or a step, of each is one factorisation of the saddle-point matrix; values and gradients of the model are two solves with
//! the factor of `H`.

use super::damped::{Model, Point};
use super::form::NotConvex;
use super::saddle::Step;
use super::{active, interior};

/// Halvings of a projected step before it counts as failed.
const MOST_HALVINGS: usize = 8;
/// The part of the first-order decrease that a projected step must bring.
const SUFFICIENT: f64 = 1e-4;
/// A winch that is as near to a bound as this part of its length, and is pushed against it, is moved there and held.
const NEAR: f64 = 1e-4;

/// A point near the minimiser of the damped model within the bounds, at which the model is below its value at no step. The factor
/// of the body's model must be that of `local.hessian`.
pub(super) fn minimise(model: &mut Model, factorizations: &mut usize) -> Result<Step, NotConvex> {
    let count = model.room.len();
    let still = Step { beta: vec![0.0; count], x: vec![0.0; model.saddle.coordinates()], slope: 0.0, curvature: 0.0 };
    let mut best = Point { step: still, slopes: model.local.gradient.clone(), value: 0.0 };
    let (found, exact) = active::minimise(model, factorizations)?;
    if found.value < best.value {
        best = found;
    }
    if exact {
        return Ok(best.step);
    }
    let inner = interior::minimise(model, &best, factorizations)?;
    if inner.value < best.value {
        best = inner;
    }
    // Now the active set is right, or nearly; what was put on its bound has left slopes behind.
    *factorizations += model.saddle.cost();
    let last = model.project(&best)?;
    Ok(last.unwrap_or(best).step)
}

impl Model<'_, '_> {
    /// A projected Newton step from `from`, if one lowers the model.
    fn project(&mut self, from: &Point) -> Result<Option<Point>, NotConvex> {
        let count = self.room.len();
        let mut base = from.step.beta.clone();
        let mut held = vec![false; count];
        for j in 0..count {
            let ([low, high], near) = (self.room[j], NEAR * self.lengths[j]);
            if from.slopes[j] > 0.0 && base[j] <= low + near {
                (base[j], held[j]) = (low, true);
            } else if from.slopes[j] < 0.0 && base[j] >= high - near {
                (base[j], held[j]) = (high, true);
            }
        }
        let moved = base != from.step.beta;
        let start = if moved { Some(self.evaluate(base)) } else { None };
        let start = start.as_ref().unwrap_or(from);
        self.saddle.factorize(self.question, self.local, self.form, self.damping, &held)?;
        let step = self.saddle.solve(&self.local.rows, &start.slopes)?;
        let mut t = 1.0;
        for _ in 0..MOST_HALVINGS {
            let way = start.step.beta.iter().zip(&step).map(|(b, d)| b + t * d);
            let tried: Vec<f64> = way.zip(&self.room).map(|(d, [low, high])| d.max(*low).min(*high)).collect();
            let first: f64 = tried.iter().zip(&start.step.beta).zip(&start.slopes).map(|((d, b), g)| g * (d - b)).sum();
            let point = self.evaluate(tried);
            if point.value < from.value && point.value <= start.value + SUFFICIENT * first {
                return Ok(Some(point));
            }
            t *= 0.5;
        }
        Ok(None)
    }
}
