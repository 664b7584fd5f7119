//! Scripts for Faulhaber controllers of the V3 family (MC 5004 / 5005 / 5010, MCS): BASIC, loaded into each drive by Motion Manager.
//!
//! A drive plays its own winch. The motion is a function that is called for every step: speed and target are set, a move is started, `DELAY` waits for
//! its end. Times are rounded to its unit (`controller.drives.script_delay_unit_s`) from the beginning, so that nothing adds up.

use super::classic;
use super::family::{Family, Sketch};
use super::stored;
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
        "the unit of DELAY, believed to be 1 ms (controller.drives.script_delay_unit_s)",
        "how much a script may hold: at most 200 steps are written",
        "that a parameter of a FUNCTION is declared with AS and no type",
    ],
};

/// Time that a drive is given to call its place zero, s.
const HOMING_S: f64 = 0.1;

fn sketches(machine: &Machine, trajectory: &Trajectory) -> Result<Vec<Sketch>, MotionError> {
    classic::checked(machine)?;
    let of = |winch: usize| {
        let parts = [
            ("setup", setup(machine, winch)),
            ("motion", motion(machine, trajectory, winch)?),
            ("stop", stop(machine, winch)),
        ];
        Ok(parts.map(|(part, text)| Sketch {
            part: if machine.winches.len() == 1 { part.into() } else { format!("{}-{part}", winch + 1) },
            extension: FAMILY.extension,
            text,
        }))
    };
    let sketches: Vec<[Sketch; 3]> = (0..machine.winches.len()).map(of).collect::<Result<_, _>>()?;
    Ok(sketches.into_iter().flatten().collect())
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
    let wait = (HOMING_S / machine.controller.drives.script_delay_unit_s).ceil() as u64;
    head(machine, winch, "once, with the plushie at rest and its cables just slack. It makes this position zero.")
        + &format!(
            "SETOBJ $6040.00 = $06
SETOBJ $6060.00 = 6
SETOBJ $6098.00 = 37
SETOBJ $6040.00 = $07
SETOBJ $6040.00 = $0F
SETOBJ $6040.00 = $1F
DELAY {wait}
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

fn motion(machine: &Machine, trajectory: &Trajectory, winch: usize) -> Result<String, MotionError> {
    let mut text = head(machine, winch, "as often as you like, from the rest position.") + STEP;
    let following = machine.controller.drives.following_acceleration;
    let _ =
        write!(text, "SETOBJ $6060.00 = 1\nSETOBJ $6083.00 = {following}\nSETOBJ $6084.00 = {following}\nEnable()\n");
    let (times, lengths) = (&trajectory.times_s, &trajectory.lengths_mm);
    let unit_s = machine.controller.drives.script_delay_unit_s;
    let units = |k: usize| ((times[k] - times[0]) / unit_s).round() as u64;
    for pair in stored::steps(machine, trajectory, winch, "a script")?.windows(2) {
        let (from, to) = (machine.counts(lengths[pair[0]][winch]), machine.counts(lengths[pair[1]][winch]));
        let speed = machine.rpm(to - from, times[pair[1]] - times[pair[0]]);
        // Writing to a string cannot fail.
        let _ = writeln!(text, "Wind({to}, {speed}, {})", units(pair[1]) - units(pair[0]));
    }
    Ok(text + "END\n")
}

fn stop(machine: &Machine, winch: usize) -> String {
    let delay = (machine.stopping_s() / machine.controller.drives.script_delay_unit_s).ceil() as u64;
    let (speed, acceleration) = (machine.gentle_rpm(), machine.controller.acceleration);
    head(machine, winch, "slowly back to zero, motor off.")
        + STEP
        + &format!(
            "SETOBJ $6060.00 = 1\nSETOBJ $6083.00 = {acceleration}\nSETOBJ $6084.00 = {acceleration}\nEnable()\nWind(0, {speed}, {delay})\nSETOBJ \
             $6040.00 = $06\nEND\n"
        )
}
