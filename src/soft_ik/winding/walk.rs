//! Winding by continuation: along a straight line of activations, in steps that the change of pose bounds.

use crate::physics::StaticsSettings;
use crate::soft_ik::{Posture, Question};

/// First step, as a part of the way; what moves tells how long the next may be.
const FIRST_STEP: f64 = 1.0 / 16.0;
/// Shortest step. A pose that still moves far in it has snapped to another branch, as the plushie would.
const SHORTEST_STEP: f64 = 1.0 / 1024.0;
/// A step may move the pose so many times further than asked before it is taken back.
const TOO_FAR: f64 = 1.6;
/// Steps aim at this part of what is asked, grow at most to this many times their length, and shrink at most to the inverse.
const AIM: f64 = 0.9;
const GROWTH: f64 = 2.0;
/// Newton steps for one state on the way. One that needs more is told as not in equilibrium, and the walk goes on from there.
const MOST_NEWTON_STEPS: usize = 60;
/// A walk ends after so many states in a row in which forces do not balance, or so many snaps: a body that crumples like that is not wound on, no
/// proof ever holds there, and each of its thousand small steps costs as much as a whole walk elsewhere.
const MOST_LOST: usize = 4;
const MOST_SNAPS: usize = 4;

/// How a walk proceeds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pace {
    /// Largest move of a node in a step, as a part of the body: a valley narrower than that may be stepped over.
    pub stride: f64,
    /// Longest step, as a part of the way: where all is slack nothing moves, and yet a valley must not be stepped over.
    pub longest: f64,
    /// On the way forces balance to this part of those at work. It need only tell one valley from another.
    pub balance: f64,
}

/// Settings of statics for states that are passed by.
pub fn passing(balance: f64) -> StaticsSettings {
    StaticsSettings { tolerance: balance, stagnation_tolerance: balance, max_iterations: MOST_NEWTON_STEPS }
}

/// A walk from a posture in equilibrium to other activations, step by step.
pub struct Walk {
    from: Vec<f64>,
    to: Vec<f64>,
    /// Part of the way taken, and the length of the next step.
    t: f64,
    step: f64,
    now: Posture,
    /// The two states before `now`, the later one first: they predict the next.
    before: Vec<(f64, Vec<f64>)>,
    /// Whether `O` fell in the last step.
    falling: bool,
    /// States in a row in which forces do not balance, and snaps.
    lost: usize,
    snaps: usize,
    /// Factorisations of states that were not kept, or in which forces do not balance.
    pub wasted: usize,
    pace: Pace,
    /// Largest move of a node in a step, length.
    stride: f64,
}

impl Walk {
    pub fn new(start: &Posture, to: Vec<f64>, size: f64, pace: Pace) -> Self {
        Self {
            from: start.beta.clone(),
            to,
            t: 0.0,
            step: FIRST_STEP.min(pace.longest),
            now: start.clone(),
            before: Vec::new(),
            falling: false,
            lost: 0,
            snaps: 0,
            wasted: 0,
            pace,
            stride: pace.stride * size,
        }
    }

    pub fn is_over(&self) -> bool {
        self.t >= 1.0 || self.lost >= MOST_LOST || self.snaps >= MOST_SNAPS
    }

    /// One more state. Returns the bottom of a valley of `O` where one has been passed (or the end, where `O` still falls), and
    /// the factorisations spent. What is returned lies within the last stride of the bottom.
    pub fn step(&mut self, question: &mut Question, stop: &dyn Fn() -> bool) -> (Option<Posture>, usize) {
        let mut spent = 0;
        let (next, t, moved, last_spent) = loop {
            let t = if self.t + 1.25 * self.step >= 1.0 { 1.0 } else { self.t + self.step };
            let beta: Vec<f64> = if t == 1.0 {
                self.to.clone()
            } else {
                self.from.iter().zip(&self.to).map(|(a, b)| a + t * (b - a)).collect()
            };
            let guess = self.predict(question, t);
            let (next, count) = question.settle_to(&beta, &guess, &passing(self.pace.balance), stop);
            spent += count;
            let moved = distance(&next.x, &self.now.x);
            // The last step takes what is left of the way, up to a quarter more than was asked for. Asked for again it would be the same, so it
            // is what was asked for that tells whether there is a shorter one.
            let shortest = self.step.min(t - self.t) <= SHORTEST_STEP;
            if moved <= TOO_FAR * self.stride || shortest || stop() {
                break (next, t, moved, count);
            }
            self.step = ((t - self.t) * (AIM * self.stride / moved).max(0.25)).max(SHORTEST_STEP);
        };
        self.lost = if next.in_equilibrium() { 0 } else { self.lost + 1 };
        self.wasted += if self.lost == 0 { spent - last_spent } else { spent };
        self.snaps += (moved > TOO_FAR * self.stride) as usize;
        let longer = (AIM * self.stride / moved.max(f64::MIN_POSITIVE)).clamp(1.0 / GROWTH, GROWTH);
        self.step = ((t - self.t) * longer).clamp(SHORTEST_STEP, self.pace.longest);
        let falls = next.objective < self.now.objective;
        let last = std::mem::replace(&mut self.now, next);
        let valley = if self.falling && !falls && last.in_equilibrium() {
            Some(last.clone())
        } else if falls && t >= 1.0 && self.now.in_equilibrium() {
            Some(self.now.clone())
        } else {
            None
        };
        self.falling = falls;
        self.before.truncate(1);
        self.before.insert(0, (self.t, last.x));
        self.t = t;
        (valley, spent)
    }

    /// Prediction of the state at `t`: along the parabola through the last three states, or along the line through the last two
    /// where these are not on a smooth curve (a cable has become taut), or the present one where a prediction would invert a
    /// triangle.
    fn predict(&self, question: &Question, t: f64) -> Vec<f64> {
        let x = &self.now.x;
        let Some((t1, x1)) = self.before.first() else { return x.clone() };
        let slope = |k: usize| (x[k] - x1[k]) / (self.t - t1);
        let ahead = t - self.t;
        let mut dx: Vec<f64> = (0..x.len()).map(|k| ahead * slope(k)).collect();
        if let Some((t2, x2)) = self.before.get(1) {
            // Newton's form: the second divided difference bends the line.
            let bend = |k: usize| (slope(k) - (x1[k] - x2[k]) / (t1 - t2)) / (self.t - t2);
            let bent: Vec<f64> = (0..x.len()).map(|k| dx[k] + ahead * (t - t1) * bend(k)).collect();
            let (straight, off) = (largest(&dx), largest_difference(&bent, &dx));
            if off <= BENT * straight {
                dx = bent;
            }
        }
        if question.model.step_limit(x, &dx) < 1.0 {
            return x.clone();
        }
        x.iter().zip(&dx).map(|(a, d)| a + d).collect()
    }
}

/// A parabola is trusted where it departs from the line by at most this part of the step.
const BENT: f64 = 0.5;

fn largest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |m, a| m.max(a.abs()))
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |m, (p, q)| m.max((p - q).abs()))
}

/// The largest distance between the places of a node in two poses.
pub fn distance(a: &[f64], b: &[f64]) -> f64 {
    let moved = a.chunks_exact(2).zip(b.chunks_exact(2)).map(|(p, q)| (p[0] - q[0]).hypot(p[1] - q[1]));
    moved.fold(0.0, f64::max)
}

/// The longer side of the box around the rest pose.
pub fn size(rest: &[f64]) -> f64 {
    let extent = |axis: usize| {
        let values = rest.iter().skip(axis).step_by(2);
        values.clone().fold(f64::NEG_INFINITY, |m, v| m.max(*v)) - values.fold(f64::INFINITY, |m, v| m.min(*v))
    };
    extent(0).max(extent(1)).max(0.0)
}
