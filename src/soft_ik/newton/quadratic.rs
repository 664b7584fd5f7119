//! The quadratic model within the bounds: a projected Newton method (Bertsekas, SIAM J. Control Optim. 20, 1982).
//!
//! Winches at a bound that the model's gradient pushes against are held; the others take the model's Newton step, projected to
//! the bounds and shortened until the model falls. A Newton step is one factorisation of the saddle-point matrix; values and
//! gradients of the model on the way are two solves with the factor of `H`.

use super::saddle::{Form, Local, NotConvex, Saddle, Step};
use crate::soft_ik::Question;

/// Newton steps on the model. What they leave is for the next linearisation.
const MOST_STEPS: usize = 8;
const MOST_HALVINGS: usize = 12;
/// The part of the first-order decrease that a projected step must bring.
const SUFFICIENT: f64 = 1e-4;
/// A winch that is as near to a bound as this part of its length, and is pushed against it, is moved there and held.
const NEAR: f64 = 1e-4;
/// A step that gains less than this part of what was gained before it is the last.
const WORTHWHILE: f64 = 0.03;

/// A point near the minimiser of the damped model within the bounds, at which the model is below its value at no step. The factor
/// of the model must be that of `local.hessian`.
pub(super) fn minimise(
    saddle: &mut Saddle,
    question: &mut Question,
    local: &Local,
    form: Form,
    damping: &[f64],
    beta: &[f64],
    lengths: &[f64],
    factorizations: &mut usize,
) -> Result<Step, NotConvex> {
    let actuation = question.actuation;
    let room: Vec<[f64; 2]> = actuation.winches.iter().zip(beta).map(|(w, b)| [w.lower - b, w.upper - b]).collect();
    let count = room.len();
    let mut best = Step { beta: vec![0.0; count], x: vec![0.0; saddle.coordinates()], slope: 0.0, curvature: 0.0 };
    let mut slopes = local.gradient.clone();
    let mut value = 0.0;
    let mut held = vec![None; count];
    for _ in 0..MOST_STEPS {
        for (j, hold) in held.iter_mut().enumerate() {
            let (d, [low, high], near) = (best.beta[j], room[j], NEAR * lengths[j]);
            *hold = match slopes[j] > 0.0 {
                true if d <= low + near => Some(low),
                false if d >= high - near => Some(high),
                _ => None,
            };
        }
        *factorizations += 1;
        let (step, there) = saddle.solve(question, local, form, damping, &held)?;
        let inside = step.beta.iter().zip(&room).all(|(d, [low, high])| low <= d && d <= high);
        let (next, next_slopes, next_value) = if inside {
            let value = damped(&step, damping);
            (step, there, value)
        } else {
            let Some(found) = search(saddle, question, local, form, damping, &room, &best, &step, &slopes, value) else {
                break;
            };
            found
        };
        let gained = value - next_value;
        (best, slopes, value) = (next, next_slopes, next_value);
        let outward = |j: usize| {
            best.beta[j] <= room[j][0] && slopes[j] > 0.0 || best.beta[j] >= room[j][1] && slopes[j] < 0.0
        };
        let same = inside && (0..count).all(|j| held[j].is_none() || outward(j));
        if same || gained <= WORTHWHILE * -value {
            break;
        }
    }
    Ok(best)
}

fn damped(step: &Step, damping: &[f64]) -> f64 {
    let own: f64 = step.beta.iter().zip(damping).map(|(d, w)| w * d * d).sum();
    step.slope + step.curvature + 0.5 * own
}

/// Searches along the projection of the way from `from` to `to`.
#[allow(clippy::too_many_arguments)]
fn search(
    saddle: &mut Saddle,
    question: &mut Question,
    local: &Local,
    form: Form,
    damping: &[f64],
    room: &[[f64; 2]],
    from: &Step,
    to: &Step,
    slopes: &[f64],
    value: f64,
) -> Option<(Step, Vec<f64>, f64)> {
    let mut t = 1.0;
    for _ in 0..MOST_HALVINGS {
        let tried: Vec<f64> = (0..room.len())
            .map(|j| (from.beta[j] + t * (to.beta[j] - from.beta[j])).max(room[j][0]).min(room[j][1]))
            .collect();
        let first: f64 = tried.iter().zip(&from.beta).zip(slopes).map(|((d, b), g)| g * (d - b)).sum();
        let (step, there) = saddle.evaluate(question, local, form, damping, tried);
        let reached = damped(&step, damping);
        if reached < value && reached <= value + SUFFICIENT * first {
            return Some((step, there, reached));
        }
        t *= 0.5;
    }
    None
}
