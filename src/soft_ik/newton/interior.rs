//! The quadratic model within the bounds by a primal-dual interior-point method with Mehrotra's predictor and corrector.
//!
//! Every finite bound is a side with the distance `s = +-(beta - bound) > 0` and a multiplier `z > 0`; on the central path `s z = mu`.
//! A step solves `(H + D + sum z/s) dbeta = -(slopes -+ (mu - c)/s)` with `c` the second-order term that the predictor has shown.

use super::damped::{Model, Point};
use super::form::NotConvex;

/// Steps at most: ten times the gap a step is usual, and the gap begins some five orders above what is asked for.
const MOST_STEPS: usize = 25;
/// The gap and the unbalanced slopes that are left, as a part of the decrease of the model. The next linearisation mends the rest.
const GAP: f64 = 1e-2;
/// A decrease of the model below this part of `O` is not resolved any further.
const LEAST_WORTH: f64 = 1e-4;
/// Distance from the bounds at which the method begins, in lengths of the winch: the largest of these powers of ten at which the model
/// lies at most `AWAY` of `O` higher.
const INSIDE: f64 = 1e-2;
const LEAST_INSIDE: f64 = 1e-6;
const AWAY: f64 = 0.1;
/// Part of the way to the nearest bound that a step may go.
const FRACTION_TO_BOUND: f64 = 0.995;
/// A winch that ends as near to a bound as this part of its length, and is pushed against it, is put on it.
const NEAR: f64 = 1e-4;

/// A finite bound of a winch.
struct Side {
    winch: usize,
    /// `+1` for the lower bound, `-1` for the upper one.
    sign: f64,
    bound: f64,
    /// Its multiplier.
    z: f64,
}

impl Side {
    fn distance(&self, beta: &[f64]) -> f64 {
        self.sign * (beta[self.winch] - self.bound)
    }

    /// How fast the distance grows along `step`.
    fn rate(&self, step: &[f64]) -> f64 {
        self.sign * step[self.winch]
    }
}

/// The state between steps.
struct Interior {
    beta: Vec<f64>,
    /// Slopes of the damped model.
    slopes: Vec<f64>,
    sides: Vec<Side>,
    held: Vec<bool>,
}

/// A point near the minimiser, from near `from`. Counts its factorisations.
pub(super) fn minimise(model: &mut Model, from: &Point, factorizations: &mut usize) -> Result<Point, NotConvex> {
    let worth = (-from.value).max(LEAST_WORTH * model.objective);
    let mut state = Interior::begin(model, from, worth);
    for _ in 0..MOST_STEPS {
        let gap = state.gap();
        if gap <= GAP * worth && state.unbalanced(model.lengths) <= GAP * worth {
            break;
        }
        *factorizations += model.saddle.cost();
        state.step(model, gap)?;
    }
    state.put_on_bounds(model.lengths);
    Ok(model.evaluate(state.beta))
}

impl Interior {
    fn begin(model: &mut Model, from: &Point, worth: f64) -> Self {
        let held: Vec<bool> = model.room.iter().map(|[low, high]| high <= low).collect();
        let mut inside = INSIDE;
        let start = loop {
            let moved = (0..held.len()).map(|j| {
                let [low, high] = model.room[j];
                let margin = (inside * model.lengths[j]).min(0.25 * (high - low));
                if held[j] { low } else { from.step.beta[j].max(low + margin).min(high - margin) }
            });
            let start = model.evaluate(moved.collect());
            if start.value <= from.value + AWAY * model.objective || inside <= LEAST_INSIDE {
                break start;
            }
            inside *= 0.1;
        };
        let (beta, slopes) = (start.step.beta, start.slopes);
        let mut sides = Vec::new();
        for (winch, [low, high]) in model.room.iter().enumerate().filter(|(j, _)| !held[*j]) {
            for (sign, bound) in [(1.0, *low), (-1.0, *high)] {
                if bound.is_finite() {
                    sides.push(Side { winch, sign, bound, z: 0.0 });
                }
            }
        }
        let mu = 0.1 * worth / sides.len().max(1) as f64;
        for side in &mut sides {
            let away = side.distance(&beta);
            side.z = mu / away;
            // Near the bound the slope is what the multiplier has to balance.
            if away <= 2.0 * inside * model.lengths[side.winch] {
                side.z = side.z.max(side.sign * slopes[side.winch]);
            }
        }
        Self { beta, slopes, sides, held }
    }

    /// `sum s z`.
    fn gap(&self) -> f64 {
        self.sides.iter().map(|side| side.z * side.distance(&self.beta)).sum()
    }

    /// The slopes that no multiplier balances, each times the length of its winch.
    fn unbalanced(&self, lengths: &[f64]) -> f64 {
        let mut left = self.slopes.clone();
        for side in &self.sides {
            left[side.winch] -= side.sign * side.z;
        }
        (0..left.len()).filter(|j| !self.held[*j]).map(|j| (left[j] * lengths[j]).abs()).sum()
    }

    fn step(&mut self, model: &mut Model, gap: f64) -> Result<(), NotConvex> {
        let distances: Vec<f64> = self.sides.iter().map(|side| side.distance(&self.beta)).collect();
        let mut damping = model.damping.to_vec();
        for (side, s) in self.sides.iter().zip(&distances) {
            damping[side.winch] += side.z / s;
        }
        let rows = &model.local.rows;
        model.saddle.factorize(model.question, model.local, model.form, &damping, &self.held)?;
        let none = vec![0.0; self.sides.len()];
        let affine = model.saddle.solve(rows, &self.forces(&distances, 0.0, &none))?;
        let dual = self.dual_step(&distances, &affine, 0.0, &none);
        let [a, b] = self.longest(&distances, &affine, &dual);
        let sides = self.sides.iter().zip(&distances).zip(&dual);
        let after: f64 = sides.map(|((side, s), dz)| (s + a * side.rate(&affine)) * (side.z + b * dz)).sum();
        let mu = gap / self.sides.len().max(1) as f64 * (after / gap).clamp(0.0, 1.0).powi(3);
        let cross: Vec<f64> = self.sides.iter().zip(&dual).map(|(side, dz)| side.rate(&affine) * dz).collect();
        let step = model.saddle.solve(rows, &self.forces(&distances, mu, &cross))?;
        let change = model.saddle.change_of_slopes(rows, &step);
        let dual = self.dual_step(&distances, &step, mu, &cross);
        let [a, b] = self.longest(&distances, &step, &dual).map(|t| if t < 1.0 { FRACTION_TO_BOUND * t } else { 1.0 });
        for j in 0..step.len() {
            self.beta[j] += a * step[j];
            self.slopes[j] += a * (change[j] + model.damping[j] * step[j]);
        }
        for (side, dz) in self.sides.iter_mut().zip(&dual) {
            side.z = (side.z + b * dz).max(0.0);
        }
        Ok(())
    }

    /// The slopes with the push of all sides.
    fn forces(&self, distances: &[f64], mu: f64, cross: &[f64]) -> Vec<f64> {
        let mut forces = self.slopes.clone();
        for ((side, s), c) in self.sides.iter().zip(distances).zip(cross) {
            forces[side.winch] -= side.sign * (mu - c) / s;
        }
        forces
    }

    fn dual_step(&self, distances: &[f64], step: &[f64], mu: f64, cross: &[f64]) -> Vec<f64> {
        let sides = self.sides.iter().zip(distances).zip(cross);
        sides.map(|((side, s), c)| (mu - c - side.z * side.rate(step)) / s - side.z).collect()
    }

    /// The longest steps, at most 1, of positions and of multipliers.
    fn longest(&self, distances: &[f64], step: &[f64], dual: &[f64]) -> [f64; 2] {
        let mut longest = [1.0_f64; 2];
        for ((side, s), dz) in self.sides.iter().zip(distances).zip(dual) {
            if side.rate(step) < 0.0 {
                longest[0] = longest[0].min(s / -side.rate(step));
            }
            if *dz < 0.0 {
                longest[1] = longest[1].min(-side.z / dz);
            }
        }
        longest
    }

    fn put_on_bounds(&mut self, lengths: &[f64]) {
        for side in &self.sides {
            let near = side.distance(&self.beta) < NEAR * lengths[side.winch];
            if near && side.sign * self.slopes[side.winch] > 0.0 {
                self.beta[side.winch] = side.bound;
            }
        }
    }
}
