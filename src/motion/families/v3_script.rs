//! Scripts for Faulhaber controllers of the V3 family (MC 5004 / 5005 / 5010, MCS): BASIC, loaded into each drive by Motion Manager.
//!
//! A drive plays its own winch. The motion is a function that is called for every step: speed and target are set, a move is started, `DELAY` waits for
//! its end. Times are rounded to milliseconds from the beginning, so that nothing adds up.

use super::classic::{self, FOLLOWING};
use super::stored::thinned;
use super::{Family, Sketch};
use crate::motion::error::MotionError;
use crate::motion::machine::Machine;
use crate::motion::trajectory::Trajectory;
use std::fmt::Write;

pub(super) static FAMILY: Family = Family {
    name: "v3-script",
    title: "Faulhaber controllers of the V3 family (MC 5004, 5005, 5010, MCS), scripts in them",
    extension: "bas",
    stream: None,
    sketches: Some(sketches),
    unconfirmed: &[
        "the unit of DELAY, believed to be 1 ms",
        "how much a script may hold: at most 200 steps are written",
        "that a parameter of a FUNCTION is declared with AS and no type",
    ],
};

/// Unit of `DELAY`, s.
const DELAY_S: f64 = 1e-3;

fn sketches(machine: &Machine, trajectory: &Trajectory) -> Result<Vec<Sketch>, MotionError> {
    classic::checked(machine)?;
    let of = |winch: usize| {
        let parts = [
            ("setup", setup(machine, winch)),
            ("motion", motion(machine, trajectory, winch)),
            ("stop", stop(machine, winch)),
        ];
        parts.map(|(part, text)| Sketch {
            part: if machine.winches.len() == 1 { part.into() } else { format!("{}-{part}", winch + 1) },
            extension: FAMILY.extension,
            text,
        })
    };
    Ok((0..machine.winches.len()).flat_map(of).collect())
}

/// Comments and the manual's macros.
fn head(machine: &Machine, winch: usize, what: &str) -> String {
    let mut text = format!("' Winch {}, {}: {what}\n", winch + 1, machine.winches[winch]);
    for line in FAMILY.unconfirmed {
        text += &format!("' Unconfirmed: {line}.\n");
    }
    text + "#INCLUDE \"MotionMacros.bi\"\n\n"
}

fn setup(machine: &Machine, winch: usize) -> String {
    let high = machine.counts(machine.travel_mm[winch]) + 1;
    head(machine, winch, "once, with the plushie at rest and its cables just slack. It makes this position zero.")
        + &format!(
            "SETOBJ $6040.00 = $06
SETOBJ $6060.00 = 6
SETOBJ $6098.00 = 37
SETOBJ $6040.00 = $07
SETOBJ $6040.00 = $0F
SETOBJ $6040.00 = $1F
DELAY 100
SETOBJ $6040.00 = $06
SETOBJ $6060.00 = 1
SETOBJ $607D.01 = -1
SETOBJ $607D.02 = {high}
END
"
        )
}

/// One move of `units` of time.
const STEP: &str = "FUNCTION Wind(target, speed, units)
    SETOBJ $6081.00 = speed
    SETOBJ $607A.00 = target
    SETOBJ $6040.00 = $0F
    SETOBJ $6040.00 = $3F
    DELAY units
END FUNCTION

";

fn motion(machine: &Machine, trajectory: &Trajectory, winch: usize) -> String {
    let mut text = head(machine, winch, "as often as you like, from the rest position.") + STEP;
    let _ =
        write!(text, "SETOBJ $6060.00 = 1\nSETOBJ $6083.00 = {FOLLOWING}\nSETOBJ $6084.00 = {FOLLOWING}\nEnable()\n");
    let (times, lengths) = (&trajectory.times_s, &trajectory.lengths_mm);
    let units = |k: usize| ((times[k] - times[0]) / DELAY_S).round() as u64;
    for pair in thinned(times.len()).windows(2) {
        let (from, to) = (machine.counts(lengths[pair[0]][winch]), machine.counts(lengths[pair[1]][winch]));
        let speed = machine.rpm(to - from, times[pair[1]] - times[pair[0]]);
        // Writing to a string cannot fail.
        let _ = writeln!(text, "Wind({to}, {speed}, {})", units(pair[1]) - units(pair[0]));
    }
    text + "END\n"
}

fn stop(machine: &Machine, winch: usize) -> String {
    let delay = (machine.stopping_s() / DELAY_S) as u64;
    let (speed, acceleration) = (machine.gentle_rpm(), machine.controller.acceleration);
    head(machine, winch, "slowly back to zero, motor off.")
        + STEP
        + &format!(
            "SETOBJ $6060.00 = 1\nSETOBJ $6083.00 = {acceleration}\nSETOBJ $6084.00 = {acceleration}\nEnable()\nWind(0, {speed}, {delay})\nSETOBJ \
             $6040.00 = $06\nEND\n"
        )
}
