//! Trajectories of the winches: how much cable each spool has wound at each step of the plan.

use super::error::MotionError;
use super::limits::{MAX_COUNTS, MAX_STEPS};
use super::plan::{Note, Plan, TooFast};
use super::winches::{counts_per_mm, winch_labels};
use crate::design::{Design, Keyframe, Tendon, animation};
use crate::numbers;

/// Positions of all winches over the plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// Names of the winches, in the order of the networks: the columns of the rows below.
    pub winches: Vec<String>,
    pub times_s: Vec<f64>,
    /// Cable wound on a spool of ratio 1, mm, rounded to the six decimals of the table; 0 is the just-slack rest state.
    pub lengths_mm: Vec<Vec<f64>>,
    /// Encoder counts of the rounded lengths.
    pub counts: Vec<Vec<i64>>,
    /// Changes that the animation took on the way.
    pub notes: Vec<Note>,
}

/// Refuses an animation that is beyond what a trajectory can hold, by its keyframes alone: the design need not be sound.
///
/// # Errors
/// Too many steps, or a position beyond the controllers'.
pub fn check(design: &Design) -> Result<(), MotionError> {
    let steps = animation::track_steps(design);
    if steps.is_nan() || steps > MAX_STEPS {
        return Err(MotionError::TooLong { steps });
    }
    let (scale, winches) = (counts_per_mm(design), winch_labels(design));
    let lengths = |k: &'_ Keyframe| winches.iter().cloned().zip(k.activations_mm.clone()).collect::<Vec<_>>();
    for (winch, length) in design.keyframes.iter().flat_map(lengths) {
        let counts = (scale * length).round();
        if counts.is_nan() || counts.abs() > MAX_COUNTS {
            return Err(MotionError::TooFar { winch, counts });
        }
    }
    Ok(())
}

impl Trajectory {
    /// The whole animation as [`Plan`] has it, in steps of at most the track rate's, keyframes included; a single step of zeros without any.
    ///
    /// # Errors
    /// Too many steps, a position beyond the controllers', more cable than there is, or a section that no motor can follow where it may not be
    /// stretched.
    pub fn of(design: &Design, too_fast: TooFast) -> Result<Self, MotionError> {
        let plan = Plan::of(design, too_fast)?;
        enough_cable(design)?;
        let rate = design.controller.track_rate_hz;
        let steps = plan.count(rate);
        if steps > MAX_STEPS {
            return Err(MotionError::TooLong { steps });
        }
        let winches = winch_labels(design);
        let scale = counts_per_mm(design);
        let times_s = plan.steps(rate);
        let mut lengths_mm = Vec::with_capacity(times_s.len());
        let mut counts = Vec::with_capacity(times_s.len());
        for &time in &times_s {
            let lengths: Vec<f64> = plan.at(time).into_iter().map(six_decimals).collect();
            let mut row = Vec::with_capacity(lengths.len());
            for (winch, length) in winches.iter().zip(&lengths) {
                let position = (scale * length).round();
                if position.is_nan() || position.abs() > MAX_COUNTS {
                    return Err(MotionError::TooFar { winch: winch.clone(), counts: position });
                }
                row.push(position as i64);
            }
            lengths_mm.push(lengths);
            counts.push(row);
        }
        Ok(Self { winches, times_s, lengths_mm, counts, notes: plan.notes })
    }

    /// Lowest and highest position of a winch, counts.
    pub fn range(&self, winch: usize) -> (i64, i64) {
        let positions = || self.counts.iter().map(|row| row[winch]);
        (positions().min().unwrap_or(0), positions().max().unwrap_or(0))
    }
}

/// Refuses a keyframe that winds more cable than a winch has: networks were changed since, or it was typed.
fn enough_cable(design: &Design) -> Result<(), MotionError> {
    for (winch, network) in design.networks.iter().enumerate() {
        let all = |tendon: &Tendon| (tendon.cable_mm(&design.mesh.nodes) + tendon.slack_mm) / tendon.ratio;
        let cable_mm = network.tendons.iter().map(all).fold(f64::INFINITY, f64::min);
        for keyframe in &design.keyframes {
            let winds_mm = keyframe.activations_mm.get(winch).copied().unwrap_or(0.0);
            if winds_mm > cable_mm {
                let (winch, time_s) = (network.name.clone(), keyframe.time_s);
                return Err(MotionError::NoCable { winch, time_s, winds_mm, cable_mm });
            }
        }
    }
    Ok(())
}

/// Rounds as the table prints, so that the counts beside a length are those of that length; never a negative zero.
fn six_decimals(v: f64) -> f64 {
    numbers::plain(v, 6).parse().unwrap_or(v)
}
