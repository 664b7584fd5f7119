//! The quadratic model within the bounds.
//!
//! First a projected Newton method (Bertsekas, SIAM J. Control Optim. 20, 1982): winches at a bound that the model's gradient
//! pushes against are held; the others take the model's Newton step, projected to the bounds and shortened until the model falls.
//! That ends at once where few bounds play a part. Where many do it creeps, and a primal-dual interior-point method takes over
//! (Mehrotra, SIAM J. Optim. 2, 1992), whose count of steps does not depend on them. A step of either is one factorisation of the
//! saddle-point matrix; values and gradients of the model are two solves with the factor of `H`.

use super::saddle::{Form, Local, NotConvex, Saddle, Step};
use crate::soft_ik::Question;

/// Projected Newton steps before the interior-point method.
const PROJECTED_STEPS: usize = 2;
const MOST_HALVINGS: usize = 8;
/// The part of the first-order decrease that a projected step must bring.
const SUFFICIENT: f64 = 1e-4;
/// A winch that is as near to a bound as this part of its length, and is pushed against it, is moved there and held.
const NEAR: f64 = 1e-4;
/// Interior-point steps at most, and the gap that they leave, as a part of the decrease of the model.
const INTERIOR_STEPS: usize = 25;
const GAP: f64 = 1e-2;
/// Distance from the bounds at which the interior-point method begins, in lengths of the winch.
const INSIDE: f64 = 1e-2;
const LEAST_INSIDE: f64 = 1e-6;
const AWAY: f64 = 0.1;
const LEAST_WORTH: f64 = 1e-4;
/// Part of the way to the nearest bound that an interior step may go.
const FRACTION_TO_BOUND: f64 = 0.995;

/// The damped model at hand.
pub(super) struct Model<'a, 'q> {
    pub saddle: &'a mut Saddle,
    pub question: &'a mut Question<'q>,
    pub local: &'a Local,
    pub form: Form,
    pub damping: &'a [f64],
    /// How far each winch may move down and up.
    pub room: Vec<[f64; 2]>,
    pub lengths: &'a [f64],
    /// `O` at no step.
    pub objective: f64,
}

/// A point of the model: the step, the slopes there, and the value.
struct Point {
    step: Step,
    slopes: Vec<f64>,
    value: f64,
}

/// A point near the minimiser of the damped model within the bounds, at which the model is below its value at no step. The factor
/// of the body's model must be that of `local.hessian`.
pub(super) fn minimise(model: &mut Model, factorizations: &mut usize) -> Result<Step, NotConvex> {
    let count = model.room.len();
    let still = Step { beta: vec![0.0; count], x: vec![0.0; model.saddle.coordinates()], slope: 0.0, curvature: 0.0 };
    let mut best = Point { step: still, slopes: model.local.gradient.clone(), value: 0.0 };
    for _ in 0..PROJECTED_STEPS {
        *factorizations += model.saddle.cost();
        let (next, done) = model.project(&best)?;
        if let Some(next) = next {
            best = next;
        }
        if done {
            return Ok(best.step);
        }
    }
    let inner = model.interior(&best, factorizations)?;
    Ok(if inner.value < best.value { inner.step } else { best.step })
}

impl Model<'_, '_> {
    /// A projected Newton step from `from`, if one lowers the model; and whether it is the minimiser.
    fn project(&mut self, from: &Point) -> Result<(Option<Point>, bool), NotConvex> {
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
        self.saddle.factorize(self.question, &self.local.rows, self.form, self.damping, &held)?;
        let step = self.saddle.solve(&self.local.rows, &start.slopes)?;
        let mut t = 1.0;
        for _ in 0..MOST_HALVINGS {
            let way = start.step.beta.iter().zip(&step).map(|(b, d)| b + t * d);
            let tried: Vec<f64> = way.zip(&self.room).map(|(d, [low, high])| d.max(*low).min(*high)).collect();
            let inside =
                t == 1.0 && start.step.beta.iter().zip(&step).zip(&tried).all(|((b, d), tried)| b + d == *tried);
            let first: f64 = tried.iter().zip(&start.step.beta).zip(&start.slopes).map(|((d, b), g)| g * (d - b)).sum();
            let point = self.evaluate(tried);
            if point.value < from.value && point.value <= start.value + SUFFICIENT * first {
                let pulled_in = |j: usize| held[j] && (point.slopes[j] > 0.0) != (start.slopes[j] > 0.0);
                let done = inside && !(0..count).any(pulled_in);
                return Ok((Some(point), done));
            }
            t *= 0.5;
        }
        Ok((None, false))
    }

    fn evaluate(&mut self, beta: Vec<f64>) -> Point {
        let (step, slopes) = self.saddle.evaluate(self.question, self.local, self.form, self.damping, beta);
        let own: f64 = step.beta.iter().zip(self.damping).map(|(d, w)| w * d * d).sum();
        let value = step.slope + step.curvature + 0.5 * own;
        Point { step, slopes, value }
    }

    /// The interior-point method from near `from`.
    fn interior(&mut self, from: &Point, factorizations: &mut usize) -> Result<Point, NotConvex> {
        let count = self.room.len();
        let rows = &self.local.rows;
        let held: Vec<bool> = self.room.iter().map(|[low, high]| high <= low).collect();
        let mut inside = INSIDE;
        let start = loop {
            let mut beta = from.step.beta.clone();
            for j in 0..count {
                let [low, high] = self.room[j];
                let margin = (inside * self.lengths[j]).min(0.25 * (high - low));
                beta[j] = if held[j] { low } else { beta[j].max(low + margin).min(high - margin) };
            }
            let start = self.evaluate(beta);
            if start.value <= from.value + AWAY * self.objective || inside <= LEAST_INSIDE {
                break start;
            }
            inside *= 0.1;
        };
        let (mut beta, mut slopes) = (start.step.beta, start.slopes);
        let finite: Vec<[bool; 2]> =
            self.room.iter().zip(&held).map(|(r, held)| r.map(|bound| !held && bound.is_finite())).collect();
        let sides = finite.iter().flatten().filter(|f| **f).count().max(1) as f64;
        let room = self.room.clone();
        let distance =
            |beta: &[f64], j: usize, side: usize| if side == 0 { beta[j] - room[j][0] } else { room[j][1] - beta[j] };
        let worth = (-from.value).max(LEAST_WORTH * self.objective);
        let mut mu = 0.1 * worth / sides;
        let mut z: Vec<[f64; 2]> = (0..count)
            .map(|j| {
                [0, 1].map(|side| {
                    if !finite[j][side] {
                        return 0.0;
                    }
                    let (outward, away) = (if side == 0 { slopes[j] } else { -slopes[j] }, distance(&beta, j, side));
                    if away <= 2.0 * inside * self.lengths[j] { (mu / away).max(outward) } else { mu / away }
                })
            })
            .collect();
        for _ in 0..INTERIOR_STEPS {
            let gap: f64 = (0..count)
                .flat_map(|j| {
                    [0, 1].map(|side| if finite[j][side] { z[j][side] * distance(&beta, j, side) } else { 0.0 })
                })
                .sum();
            let dual =
                (0..count).filter(|j| !held[*j]).map(|j| ((slopes[j] - z[j][0] + z[j][1]) * self.lengths[j]).abs());
            if gap <= GAP * worth && dual.sum::<f64>() <= GAP * worth {
                break;
            }
            mu = gap / sides;
            let barrier: Vec<f64> = (0..count)
                .map(|j| [0, 1].map(|s| if finite[j][s] { z[j][s] / distance(&beta, j, s) } else { 0.0 }).iter().sum())
                .collect();
            let damping: Vec<f64> = self.damping.iter().zip(&barrier).map(|(d, b)| d + b).collect();
            *factorizations += self.saddle.cost();
            self.saddle.factorize(self.question, rows, self.form, &damping, &held)?;
            let direction = |saddle: &mut Saddle, mu: f64, cross: &dyn Fn(usize, usize) -> f64| {
                let force = |j: usize| {
                    let push = |s: usize| if finite[j][s] { (mu - cross(j, s)) / distance(&beta, j, s) } else { 0.0 };
                    slopes[j] - push(0) + push(1)
                };
                let forces: Vec<f64> = (0..count).map(force).collect();
                saddle.solve(rows, &forces)
            };
            let dual_step = |d: &[f64], j: usize, s: usize, mu: f64, cross: f64| {
                let toward = if s == 0 { d[j] } else { -d[j] };
                (mu - cross - z[j][s] * toward) / distance(&beta, j, s) - z[j][s]
            };
            let longest = |d: &[f64], dz: &dyn Fn(usize, usize) -> f64| {
                let (mut primal, mut dual) = (1.0_f64, 1.0_f64);
                for j in 0..count {
                    for s in 0..2 {
                        if finite[j][s] {
                            let toward = if s == 0 { -d[j] } else { d[j] };
                            if toward > 0.0 {
                                primal = primal.min(distance(&beta, j, s) / toward);
                            }
                            let change = dz(j, s);
                            if change < 0.0 {
                                dual = dual.min(-z[j][s] / change);
                            }
                        }
                    }
                }
                [primal, dual]
            };
            let affine = direction(self.saddle, 0.0, &|_, _| 0.0)?;
            let affine_dual = |j: usize, s: usize| dual_step(&affine, j, s, 0.0, 0.0);
            let [a, b] = longest(&affine, &affine_dual);
            let after: f64 = (0..count)
                .flat_map(|j| [0, 1].map(|s| (j, s)))
                .filter(|(j, s)| finite[*j][*s])
                .map(|(j, s)| {
                    let toward = if s == 0 { affine[j] } else { -affine[j] };
                    (distance(&beta, j, s) + a * toward) * (z[j][s] + b * affine_dual(j, s))
                })
                .sum();
            let centre = mu * (after / gap).clamp(0.0, 1.0).powi(3);
            let cross = |j: usize, s: usize| {
                let toward = if s == 0 { affine[j] } else { -affine[j] };
                toward * affine_dual(j, s)
            };
            let step = direction(self.saddle, centre, &cross)?;
            let change = self.saddle.change_of_slopes(rows, &step);
            let full_dual = |j: usize, s: usize| dual_step(&step, j, s, centre, cross(j, s));
            let [a, b] = longest(&step, &full_dual).map(|t| if t < 1.0 { FRACTION_TO_BOUND * t } else { 1.0 });
            let duals: Vec<[f64; 2]> =
                (0..count).map(|j| [0, 1].map(|s| if finite[j][s] { full_dual(j, s) } else { 0.0 })).collect();
            for j in 0..count {
                beta[j] += a * step[j];
                slopes[j] += a * (change[j] + self.damping[j] * step[j]);
                for s in 0..2 {
                    z[j][s] = (z[j][s] + b * duals[j][s]).max(0.0);
                }
            }
        }
        // On the bound is what is pushed there harder than it is kept away.
        for j in 0..count {
            for s in 0..2 {
                if finite[j][s]
                    && distance(&beta, j, s) < NEAR * self.lengths[j]
                    && (if s == 0 { slopes[j] } else { -slopes[j] }) > 0.0
                {
                    beta[j] = self.room[j][s];
                }
            }
        }
        Ok(self.evaluate(beta))
    }
}
