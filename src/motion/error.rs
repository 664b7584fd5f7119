//! The errors of motion.

use super::limits::{MAX_COUNTS, MAX_NODES, MAX_RESOLUTION, MAX_STEPS};
use thiserror::Error;

/// An animation that the motors cannot be told.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum MotionError {
    #[error(
        "the animation has {steps:.3e} steps, more than {MAX_STEPS:.0}: shorten it or lower controller.track_rate_hz"
    )]
    TooLong { steps: f64 },
    #[error("winch {winch:?} would have to go to {counts:.3e} counts, beyond the controller's {MAX_COUNTS:.0}")]
    TooFar { winch: String, counts: f64 },
    #[error(
        "between {from_s:.2} s and {to_s:.2} s winch {winch:?} winds {by_mm:.1} mm: the motor's speed and acceleration need {needs_s:.2} s for that"
    )]
    TooFast { winch: String, from_s: f64, to_s: f64, by_mm: f64, needs_s: f64 },
    #[error("{winches} winches are more than the {MAX_NODES} nodes of the controllers' network")]
    TooManyWinches { winches: usize },
    #[error("controller.encoder_lines: 4 x {lines} is more than the {MAX_RESOLUTION} the controllers take")]
    EncoderTooFine { lines: u32 },
    #[error("{winches} winches are more than the {most} {what}")]
    TooManyOfAKind { winches: usize, most: usize, what: &'static str },
    #[error(
        "winch {winch:?} winds {travel_mm:.1} mm, {degrees:.0} degrees of its spool, beyond the {most:.0} degrees of {motor}: a spool of {radius_mm:.1} mm \
         radius would do"
    )]
    BeyondTurn { winch: String, travel_mm: f64, degrees: f64, most: f64, motor: &'static str, radius_mm: f64 },
    #[error(
        "{what} has no room for this motion: with as many steps as it holds it would be up to {off_mm:.1} mm off; make the animation shorter or calmer, or take \
         controllers that a computer tells what to do"
    )]
    NoRoom { what: &'static str, off_mm: f64 },
    #[error(
        "the keyframe at {time_s:.2} s winds {winds_mm:.1} mm on winch {winch:?}, which has {cable_mm:.1} mm of cable: work the keyframe out again, or \
         lengthen the cable"
    )]
    NoCable { winch: String, time_s: f64, winds_mm: f64, cable_mm: f64 },
    #[error("there are no controllers {name:?}; there are {known}")]
    NoSuchFamily { name: String, known: String },
    #[error(
        "winch {winch:?} needs up to {needs_nmm:.0} N mm at its spool, more than the {has_nmm:.0} N mm of its motor (controller.torque_nmm): a smaller spool, \
         a stronger motor or less pull would do"
    )]
    TooWeak { winch: String, needs_nmm: f64, has_nmm: f64 },
    #[error("controller.drives: servo_low_us and servo_high_us are both {us}: a servo needs two different ends")]
    NoPulses { us: u32 },
}
