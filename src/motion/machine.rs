//! What families of controllers are made for: the winches of a design with their spools, travels and motors.

use super::error::MotionError;
use super::limits::Limits;
use super::plan::limits;
use super::trajectory::Trajectory;
use super::winches::counts_per_mm;
use crate::design::{ControllerSettings, Design};
use std::f64::consts::PI;

/// The winches of a design as their controllers know them.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    pub winches: Vec<String>,
    /// Most cable that the motion winds on each, mm: it never winds less than none.
    pub travel_mm: Vec<f64>,
    pub controller: ControllerSettings,
    pub spool_radius_mm: f64,
    /// Encoder counts for a mm of cable.
    pub counts_per_mm: f64,
    /// Largest speed and acceleration of the plan.
    pub limits: Limits,
}

/// Speed on the way to zero, as a part of the plan's largest.
const STOP_SPEED: f64 = 0.25;
/// Time beyond what the way to zero takes before motors are switched off, s: a motion that was broken off still has speed, a load slows the motor.
const STOP_MARGIN_S: f64 = 1.0;

impl Machine {
    /// The winches of a design that play a trajectory.
    pub fn new(design: &Design, trajectory: &Trajectory) -> Self {
        let most = |winch: usize| trajectory.lengths_mm.iter().map(|row| row[winch]).fold(0.0, f64::max);
        Self {
            winches: trajectory.winches.clone(),
            travel_mm: (0..trajectory.winches.len()).map(most).collect(),
            controller: design.controller.clone(),
            spool_radius_mm: design.fabrication.spool_radius_mm,
            counts_per_mm: counts_per_mm(design),
            limits: limits(design),
        }
    }

    /// Encoder counts of so much cable.
    pub fn counts(&self, length_mm: f64) -> i64 {
        (self.counts_per_mm * length_mm).round() as i64
    }

    /// Counts of a turn of the motor.
    pub fn resolution(&self) -> u32 {
        self.controller.encoder_lines.saturating_mul(4)
    }

    /// Speed of the motor, rpm, that winds so much in such a time: rounded up, as a drive that comes early waits, and one that comes late falls back more
    /// and more; at least 1, at most the design's.
    pub fn rpm(&self, counts: i64, duration_s: f64) -> u32 {
        let speed = (60.0 * counts.abs() as f64 / f64::from(self.resolution()) / duration_s).ceil();
        if speed.is_finite() { speed.clamp(1.0, f64::from(self.controller.speed_rpm)) as u32 } else { 1 }
    }

    /// Limits on the way to zero.
    pub fn gently(&self) -> Limits {
        Limits { speed: STOP_SPEED * self.limits.speed, acceleration: self.limits.acceleration }
    }

    /// Speed of the motor on the way to zero, rpm.
    pub fn gentle_rpm(&self) -> u32 {
        ((STOP_SPEED * f64::from(self.controller.speed_rpm)) as u32).max(1)
    }

    /// Seconds until the farthest winch is back at zero, whole ones.
    pub fn stopping_s(&self) -> f64 {
        let farthest = self.travel_mm.iter().copied().fold(0.0, f64::max);
        (super::profile::Trapezoid::shortest(farthest, self.gently()) + STOP_MARGIN_S).ceil()
    }

    /// Turn of a spool that winds so much, degrees.
    pub fn degrees(&self, length_mm: f64) -> f64 {
        (length_mm / self.spool_radius_mm).to_degrees()
    }

    /// Whether no spool turns farther than its motor can.
    ///
    /// # Errors
    /// [`MotionError::BeyondTurn`] with the first winch that does, and the radius of a spool that would do.
    pub fn within_degrees(&self, most: f64, motor: &'static str) -> Result<(), MotionError> {
        for (winch, &travel_mm) in self.winches.iter().zip(&self.travel_mm) {
            let degrees = self.degrees(travel_mm);
            if degrees > most {
                let (winch, radius_mm) = (winch.clone(), self.radius_for(travel_mm, most));
                return Err(MotionError::BeyondTurn { winch, travel_mm, degrees, most, motor, radius_mm });
            }
        }
        Ok(())
    }

    /// Length on a turn of the spool, mm.
    pub fn turn_mm(&self) -> f64 {
        2.0 * PI * self.spool_radius_mm
    }

    /// The smallest radius of a spool that winds `length_mm` within so many degrees, mm, rounded up to a tenth.
    pub fn radius_for(&self, length_mm: f64, degrees: f64) -> f64 {
        (10.0 * length_mm / degrees.to_radians()).ceil() / 10.0
    }
}
