//! Algorithm 1 of the paper as the baseline: the time it needs for a target error.
//!
//! It shares the statics and the factorisation of the other methods. Iterations are timed one by one, so that it can stop as
//! soon as it is close enough; what setting it up again for every iteration costs is measured and taken off.

use crate::soft_ik::gradient::Gradient;
use crate::soft_ik::{Budget, Method, Posture, Question};
use std::time::Instant;

/// Iterations after which it gives up on a frame.
pub const ITERATIONS: usize = 200;
/// Target errors count as equal within this part of the body length: some micrometres on a soft toy.
pub const EQUAL_ERROR: f64 = 1e-5;

/// How a frame of Algorithm 1 ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// As close as asked.
    Reached,
    /// Out of iterations or of patience: its time is a lower bound.
    GaveUp,
    /// No step lowers the objective any more: it never gets there.
    Stalled,
}

/// Follows the targets of `question` from `posture`, which it moves, until the rms target error (a length) is at most
/// `error`. Says how it ended and the time, ms.
pub fn follow(
    question: &mut Question,
    posture: &mut Posture,
    error: f64,
    patience_ms: f64,
    stop: &dyn Fn() -> bool,
) -> (End, f64) {
    // The same activations under the new targets.
    *posture = question.settle(&posture.beta, &posture.x, stop).0;
    let method = Gradient::default();
    let mut time = 0.0;
    for iteration in 0..ITERATIONS {
        // One iteration at least: the targets have moved.
        if iteration > 0 && question.objective.target_error(&posture.x) <= error {
            return (End::Reached, time);
        }
        if time > patience_ms || stop() {
            return (End::GaveUp, time);
        }
        let clock = Instant::now();
        method.solve(question, posture, &Budget { iterations: 0, stop });
        let setting_up = clock.elapsed();
        let clock = Instant::now();
        let answer = method.solve(question, posture, &Budget { iterations: 1, stop });
        time += 1e3 * clock.elapsed().saturating_sub(setting_up).as_secs_f64();
        if answer.posture.objective >= posture.objective {
            let reached = question.objective.target_error(&posture.x) <= error;
            return (if reached { End::Reached } else { End::Stalled }, time);
        }
        *posture = answer.posture;
    }
    let reached = question.objective.target_error(&posture.x) <= error;
    (if reached { End::Reached } else { End::GaveUp }, time)
}

/// Frames of Algorithm 1 beside ours.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Comparison {
    frames: Vec<(End, f64)>,
}

impl Comparison {
    /// A frame: how it ended, and its time in units of ours.
    pub fn push(&mut self, end: End, ratio: f64) {
        self.frames.push((end, ratio));
    }

    /// The median ratio, and whether it is only a lower bound. A stalled frame counts as an infinite time, so that the median is
    /// infinite where more than half of the frames stall. `None` without frames.
    pub fn median(&self) -> Option<(f64, bool)> {
        let mut sorted: Vec<(f64, bool)> = self
            .frames
            .iter()
            .map(|(end, ratio)| (if *end == End::Stalled { f64::INFINITY } else { *ratio }, *end != End::Reached))
            .collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (median, _) = sorted.get(sorted.len().checked_sub(1)? / 2).copied()?;
        // A lower bound among the lower half may in truth belong to the upper half.
        let bounded = sorted.iter().any(|(ratio, bound)| *bound && *ratio <= median);
        Some((median, bounded))
    }

    /// How many frames ended so.
    pub fn count(&self, end: End) -> usize {
        self.frames.iter().filter(|frame| frame.0 == end).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn comparison(frames: &[(End, f64)]) -> Comparison {
        Comparison { frames: frames.to_vec() }
    }

    #[test]
    fn medians_know_what_they_bound() {
        use End::{GaveUp, Reached, Stalled};
        assert_eq!(comparison(&[]).median(), None);
        assert_eq!(comparison(&[(Reached, 3.0), (Reached, 1.0), (Reached, 9.0)]).median(), Some((3.0, false)));
        assert_eq!(comparison(&[(Reached, 3.0), (Reached, 1.0), (GaveUp, 9.0)]).median(), Some((3.0, false)));
        assert_eq!(comparison(&[(Reached, 3.0), (GaveUp, 1.0), (GaveUp, 9.0)]).median(), Some((3.0, true)));
        assert_eq!(comparison(&[(Stalled, 0.1), (Stalled, 0.1), (Reached, 9.0)]).median(), Some((f64::INFINITY, true)));
    }
}
