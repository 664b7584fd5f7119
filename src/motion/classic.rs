//! The dialect of the classic ASCII family of motion controllers (Faulhaber MCDC / MCBL 300x RS).
//!
//! A command is `[node]COMMAND[argument]` and a carriage return, nothing else: the protocol knows no comments and no
//! line feeds. Winch `i` (from 1) is node `i`. A program holds a prologue for each node, then for every step of the trajectory
//! a target position for each node (`LA`, only loaded) and the order to go there (`M`). The protocol has no clock that
//! all nodes share, so the sender keeps the pace: one step every `1 / track_rate_hz` seconds.

use super::error::MotionError;
use super::limits::{MAX_NODES, MAX_RESOLUTION};
use super::program::Program;
use super::trajectory::Trajectory;
use crate::design::Design;

/// Ends a command.
pub const TERMINATOR: &str = "\r";

/// The commands that play a trajectory.
///
/// # Errors
/// More winches than nodes, or an encoder finer than the controllers take.
pub fn program(design: &Design, trajectory: &Trajectory) -> Result<Program, MotionError> {
    let winches = trajectory.winches.len();
    if winches > MAX_NODES {
        return Err(MotionError::TooManyWinches { winches });
    }
    let resolution = design.controller.encoder_lines.saturating_mul(4);
    if resolution > MAX_RESOLUTION {
        return Err(MotionError::EncoderTooFine { lines: design.controller.encoder_lines });
    }
    let mut program = Program::new(TERMINATOR);
    for winch in 0..winches {
        for command in prologue(design, trajectory, winch, resolution) {
            program.push(format_args!("{}{command}", winch + 1));
        }
    }
    for (&time_s, row) in trajectory.times_s.iter().zip(&trajectory.counts) {
        program.begin_step(time_s);
        // All targets first: the nodes then start as nearly together as the line allows.
        for (winch, counts) in row.iter().enumerate() {
            program.push(format_args!("{}LA{counts}", winch + 1));
        }
        for winch in 0..winches {
            program.push(format_args!("{}M", winch + 1));
        }
    }
    Ok(program)
}

/// Motor off, replies on, settings, travel limits, this position is zero, motor on.
fn prologue(design: &Design, trajectory: &Trajectory, winch: usize, resolution: u32) -> Vec<String> {
    let motor = &design.controller;
    let (low, high) = trajectory.range(winch);
    vec![
        "DI".into(),
        "ANSW2".into(),
        format!("ENCRES{resolution}"),
        format!("SP{}", motor.speed_rpm),
        format!("AC{}", motor.acceleration),
        format!("DEC{}", motor.acceleration),
        // The sign of the argument says which limit is meant, so that neither can be zero.
        format!("LL{}", high.max(0) + 1),
        format!("LL{}", low.min(0) - 1),
        "APL1".into(),
        "HO0".into(),
        "EN".into(),
    ]
}
