//! The animation for motion controllers of the classic ASCII command family (Faulhaber MCDC / MCBL 300x RS).
//!
//! A command is `[node]COMMAND[argument]` and a carriage return, nothing else: the protocol knows no comments and no
//! line feeds. Winch `i` (from 1) is node `i`. The file holds a prologue for each node, then for every step of the track
//! a target position for each node (`LA`, only loaded) and the order to go there (`M`). The protocol has no clock that
//! all nodes share, so the sender keeps the pace: one step every `1 / track_rate_hz` seconds. The README beside the file
//! says how.

use super::ExportError;
use super::tracks::Track;
use crate::design::Design;

/// Nodes of the RS-232 network are numbered 1 to this (0 is the factory setting).
pub const MAX_NODES: usize = 255;
/// Largest encoder resolution, counts per revolution.
pub const MAX_RESOLUTION: u32 = 65535;

/// The command file: see the module.
pub fn ascii_program(design: &Design, track: &Track) -> Result<String, ExportError> {
    let winches = track.winches.len();
    if winches > MAX_NODES {
        return Err(ExportError::TooManyWinches { winches });
    }
    let resolution = design.controller.encoder_lines.saturating_mul(4);
    if resolution > MAX_RESOLUTION {
        return Err(ExportError::EncoderTooFine { lines: design.controller.encoder_lines });
    }
    let mut program = String::new();
    for winch in 0..winches {
        for command in prologue(design, track, winch, resolution) {
            program += &format!("{}{command}\r", winch + 1);
        }
    }
    for row in &track.counts {
        // All targets first: the nodes then start as nearly together as the line allows.
        for (winch, counts) in row.iter().enumerate() {
            program += &format!("{}LA{counts}\r", winch + 1);
        }
        for winch in 0..winches {
            program += &format!("{}M\r", winch + 1);
        }
    }
    Ok(program)
}

/// Motor off, replies on, settings, travel limits, this position is zero, motor on.
fn prologue(design: &Design, track: &Track, winch: usize, resolution: u32) -> Vec<String> {
    let motor = &design.controller;
    let (low, high) = track.range(winch);
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
