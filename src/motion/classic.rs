//! The dialect of the classic ASCII family of motion controllers (Faulhaber MCDC / MCBL 300x RS).
//!
//! A command is `[node]COMMAND[argument]` and a carriage return, nothing else: the protocol knows no comments and no
//! line feeds. Winch `i` (from 1) is node `i`. Three programs:
//!
//! - *setup*, sent once with the plushie at rest: replies, encoder, travel limits, and that here is zero. `HO` takes the limits along, so it
//!   stands in no program that is sent again.
//! - *motion*, as often as one likes: motors on, then for every step one step ahead the next target (`LA`, only loaded), the speed that gets there
//!   when the step is over (`SP`), and the order to go (`M`). A drive trails a target that it is told late by `v^2 / (2 DEC)`; this one
//!   stays within tenths of a mm, with acceleration limits out of the way. The trajectory itself keeps speed and acceleration within the design's.
//! - *stop*: slowly to zero, time to get there, motors off.
//!
//! The protocol has no clock that all nodes share, so the sender keeps the pace: every step at its time.

use super::error::MotionError;
use super::limits::{Limits, MAX_NODES, MAX_RESOLUTION};
use super::profile::Trapezoid;
use super::program::Program;
use super::trajectory::Trajectory;
use crate::design::Design;

/// Ends a command.
pub const TERMINATOR: &str = "\r";
/// Acceleration limit while a trajectory is followed, rev/s^2: the controllers' largest (unconfirmed). The steps themselves are gentle.
const FOLLOWING: u32 = 30_000;
/// Speed on the way to zero, as a part of the design's.
const STOP_SPEED: f64 = 0.25;
/// Time beyond what the way to zero takes before motors are switched off, s: a motion that was broken off still has speed, a load slows the motor.
const STOP_MARGIN_S: f64 = 1.0;

/// The commands for the drives, in three parts: see the module.
#[derive(Clone, Debug, PartialEq)]
pub struct Programs {
    pub setup: Program,
    pub motion: Program,
    pub stop: Program,
}

/// The programs that play a trajectory.
///
/// # Errors
/// More winches than nodes, or an encoder finer than the controllers take.
pub fn programs(design: &Design, trajectory: &Trajectory) -> Result<Programs, MotionError> {
    let winches = trajectory.winches.len();
    if winches > MAX_NODES {
        return Err(MotionError::TooManyWinches { winches });
    }
    let resolution = design.controller.encoder_lines.saturating_mul(4);
    if resolution > MAX_RESOLUTION {
        return Err(MotionError::EncoderTooFine { lines: design.controller.encoder_lines });
    }
    Ok(Programs {
        setup: setup(trajectory, resolution),
        motion: motion(design, trajectory, resolution),
        stop: stop(design, trajectory),
    })
}

/// Motor off, replies on, settings, this position is zero, travel limits from there.
fn setup(trajectory: &Trajectory, resolution: u32) -> Program {
    let mut program = Program::new(TERMINATOR);
    for winch in 0..trajectory.winches.len() {
        let (node, (low, high)) = (winch + 1, trajectory.range(winch));
        for command in ["DI", "ANSW2"] {
            program.push(format_args!("{node}{command}"));
        }
        program.push(format_args!("{node}ENCRES{resolution}"));
        program.push(format_args!("{node}HO0"));
        // The sign of the argument says which limit is meant, so that neither can be zero.
        program.push(format_args!("{node}LL{}", high.max(0) + 1));
        program.push(format_args!("{node}LL{}", low.min(0) - 1));
        program.push(format_args!("{node}APL1"));
    }
    program
}

/// Motors on; then in every step the target of its end, at the speed that takes the whole step. All nodes in every step, moving or not.
fn motion(design: &Design, trajectory: &Trajectory, resolution: u32) -> Program {
    let nodes = 1..=trajectory.winches.len();
    let mut program = Program::new(TERMINATOR);
    for node in nodes.clone() {
        for command in ["AC", "DEC"] {
            program.push(format_args!("{node}{command}{FOLLOWING}"));
        }
        program.push(format_args!("{node}EN"));
    }
    let (times, counts) = (&trajectory.times_s, &trajectory.counts);
    // Without a motion, a single step to where the toy is.
    for k in 0..times.len().saturating_sub(1).max(1) {
        let next = (k + 1).min(times.len() - 1);
        program.begin_step(times[k]);
        // All targets first: the nodes then start as nearly together as the line allows.
        for node in nodes.clone() {
            let (from, to) = (counts[k][node - 1], counts[next][node - 1]);
            let revolutions = (to - from).abs() as f64 / f64::from(resolution);
            // Rounded up: a drive that comes early waits, one that comes late falls back more and more.
            let speed = (60.0 * revolutions / (times[next] - times[k])).ceil();
            let speed = if speed.is_finite() { speed.clamp(1.0, f64::from(design.controller.speed_rpm)) } else { 1.0 };
            program.push(format_args!("{node}SP{speed}"));
            program.push(format_args!("{node}LA{to}"));
        }
        for node in nodes.clone() {
            program.push(format_args!("{node}M"));
        }
    }
    program
}

/// Seconds until the farthest winch is back at zero when [`Programs::stop`] is sent.
pub fn stopping_s(design: &Design, trajectory: &Trajectory) -> f64 {
    let motor = &design.controller;
    let revolutions = |counts: i64| counts as f64 / (4.0 * f64::from(motor.encoder_lines));
    let slowly = Limits { speed: f64::from(stop_speed(design)) / 60.0, acceleration: f64::from(motor.acceleration) };
    let farthest = (0..trajectory.winches.len()).map(|w| trajectory.range(w).1).max().unwrap_or(0);
    let starts_s: f64 = (1..=trajectory.winches.len()).map(|node| line_s(&format!("{node}M"))).sum();
    (Trapezoid::shortest(revolutions(farthest), slowly) + starts_s + STOP_MARGIN_S).ceil()
}

/// Time on the line of a command and its reply `OK` with its end, s.
pub fn line_s(command: &str) -> f64 {
    const REPLY_BYTES: usize = 4;
    carried_s(command.len() + TERMINATOR.len() + REPLY_BYTES)
}

/// Time that so many bytes take on the line at the factory's setting, s: 9600 baud; a start bit, eight bits and a stop bit each.
pub fn carried_s(bytes: usize) -> f64 {
    const BAUD: f64 = 9600.0;
    const BITS_A_BYTE: f64 = 10.0;
    BITS_A_BYTE * bytes as f64 / BAUD
}

/// Speed on the way to zero, rpm.
fn stop_speed(design: &Design) -> u32 {
    ((STOP_SPEED * f64::from(design.controller.speed_rpm)) as u32).max(1)
}

/// Slowly to zero; when all are there, motors off.
fn stop(design: &Design, trajectory: &Trajectory) -> Program {
    let (motor, speed, nodes) = (&design.controller, stop_speed(design), 1..=trajectory.winches.len());
    let mut program = Program::new(TERMINATOR);
    for node in nodes.clone() {
        for (command, value) in [("SP", speed), ("AC", motor.acceleration), ("DEC", motor.acceleration)] {
            program.push(format_args!("{node}{command}{value}"));
        }
        program.push(format_args!("{node}LA0"));
    }
    // The clock starts with the first of them that moves.
    program.begin_step(0.0);
    for node in nodes.clone() {
        program.push(format_args!("{node}M"));
    }
    program.begin_step(stopping_s(design, trajectory));
    for node in nodes {
        program.push(format_args!("{node}DI"));
    }
    program
}
