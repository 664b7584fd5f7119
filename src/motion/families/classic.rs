//! The classic ASCII family of motion controllers (Faulhaber MCDC / MCBL 300x RS), told by a host.
//!
//! A command is `[node]COMMAND[argument]` and a carriage return, nothing else: the protocol knows no comments and no line feeds. Winch `i` (from 1) is
//! node `i`. `LA` only loads a target, `M` starts. A drive trails a target that it is told late by `v^2 / (2 DEC)`; told one step ahead, with the speed
//! (`SP`) that gets there when the step is over and acceleration limits out of the way, it stays within tenths of a mm. The trajectory itself keeps
//! speed and acceleration within the design's. `HO` takes the limits of travel along, so it stands in no program that is sent again.

use super::Family;
use crate::motion::error::MotionError;
use crate::motion::framing::Framing;
use crate::motion::limits::{MAX_COUNTS, MAX_NODES, MAX_RESOLUTION};
use crate::motion::machine::Machine;
use crate::motion::stream::{Move, Stream};

pub(super) static FAMILY: Family = Family {
    name: "ascii",
    title: "Faulhaber controllers of the classic ASCII family (MCDC, MCBL 300x RS), told by a computer",
    extension: "txt",
    stream: Some(|machine| Ok(Box::new(Classic::new(machine)?))),
    sketches: None,
    unconfirmed: &["the largest AC and DEC, believed to be 30000", "the largest position, believed to be 1.8e9 counts"],
};

/// Ends a command.
pub(in crate::motion) const END: &str = "\r";
/// Acceleration limit while a trajectory is followed, rev/s^2: the controllers' largest (unconfirmed). The steps themselves are gentle.
pub(in crate::motion) const FOLLOWING: u32 = 30_000;
/// The answer of motors to a command that they have taken.
const TAKEN: &str = "OK";

/// The commands for one machine.
#[derive(Clone, Debug)]
pub struct Classic {
    machine: Machine,
}

impl Classic {
    /// # Errors
    /// More winches than nodes, an encoder finer than the controllers take, or a position beyond theirs.
    pub fn new(machine: &Machine) -> Result<Self, MotionError> {
        checked(machine)?;
        Ok(Self { machine: machine.clone() })
    }

    fn nodes(&self) -> std::ops::RangeInclusive<usize> {
        1..=self.machine.winches.len()
    }
}

/// What controllers of the family cannot be told.
pub(super) fn checked(machine: &Machine) -> Result<(), MotionError> {
    let winches = machine.winches.len();
    if winches > MAX_NODES {
        return Err(MotionError::TooManyWinches { winches });
    }
    if machine.resolution() > MAX_RESOLUTION {
        return Err(MotionError::EncoderTooFine { lines: machine.controller.encoder_lines });
    }
    for (winch, &travel) in machine.winches.iter().zip(&machine.travel_mm) {
        let counts = machine.counts_per_mm * travel;
        if counts.is_nan() || counts > MAX_COUNTS {
            return Err(MotionError::TooFar { winch: winch.clone(), counts });
        }
    }
    Ok(())
}

impl Stream for Classic {
    fn machine(&self) -> &Machine {
        &self.machine
    }

    fn framing(&self) -> Framing {
        Framing::Lines { end: END, at_once: &[] }
    }

    /// Motor off, replies on, settings, this position is zero, travel limits from there, current limits.
    fn setup(&self) -> Vec<String> {
        let mut commands = Vec::new();
        for (winch, node) in self.nodes().enumerate() {
            commands.extend(own_setup(&self.machine, winch).into_iter().map(|command| format!("{node}{command}")));
        }
        commands
    }

    fn ready(&self) -> Vec<String> {
        let on = |node| [format!("{node}AC{FOLLOWING}"), format!("{node}DEC{FOLLOWING}"), format!("{node}EN")];
        self.nodes().flat_map(on).collect()
    }

    fn load(&self, &Move { winch, from_mm, to_mm, duration_s }: &Move) -> Vec<String> {
        let (from, to) = (self.machine.counts(from_mm), self.machine.counts(to_mm));
        let node = winch + 1;
        vec![format!("{node}SP{}", self.machine.rpm(to - from, duration_s)), format!("{node}LA{to}")]
    }

    fn go(&self, steps: &[Move]) -> Vec<String> {
        steps.iter().map(|step| format!("{}M", step.winch + 1)).collect()
    }

    fn load_home(&self) -> Vec<String> {
        let (speed, acceleration) = (self.machine.gentle_rpm(), self.machine.controller.acceleration);
        let home = [format!("SP{speed}"), format!("AC{acceleration}"), format!("DEC{acceleration}"), "LA0".into()];
        self.nodes().flat_map(|node| home.clone().map(|command| format!("{node}{command}"))).collect()
    }

    fn go_home(&self) -> Vec<String> {
        self.nodes().map(|node| format!("{node}M")).collect()
    }

    fn off(&self) -> Vec<String> {
        self.nodes().map(|node| format!("{node}DI")).collect()
    }

    fn locate(&self, winch: usize) -> String {
        format!("{}POS", winch + 1)
    }

    fn place_mm(&self, _winch: usize, reply: &str) -> Option<f64> {
        Some(reply.trim().parse::<i64>().ok()? as f64 / self.machine.counts_per_mm)
    }

    fn taken(&self, _command: &str, reply: &str) -> Result<(), String> {
        if reply.eq_ignore_ascii_case(TAKEN) { Ok(()) } else { Err(format!("{reply:?}")) }
    }

    fn addressed(&self, command: &str) -> Option<usize> {
        let digits = command.split(|c: char| !c.is_ascii_digit()).next()?;
        digits.parse::<usize>().ok()?.checked_sub(1)
    }

    /// `ANSW2` also tells on its own that a position (`p`) or a speed (`v`) was reached.
    fn is_aside(&self, reply: &str) -> bool {
        matches!(reply, "p" | "v")
    }
}

/// Setup of one drive, without its node.
pub(super) fn own_setup(machine: &Machine, winch: usize) -> Vec<String> {
    let high = machine.counts(machine.travel_mm[winch]);
    let mut commands = vec!["DI".to_owned(), "ANSW2".into(), format!("ENCRES{}", machine.resolution()), "HO0".into()];
    // The sign of the argument says which limit is meant, so that neither can be zero.
    commands.extend([format!("LL{}", high + 1), "LL-1".into(), "APL1".into()]);
    let current = machine.controller.drives.current_ma;
    if current > 0 {
        commands.extend([format!("LPC{current}"), format!("LCC{current}")]);
    }
    commands
}
