//! Steppers behind GRBL 1.1 or grblHAL, told by a host in G-code.
//!
//! Winch 1 is X, 2 Y, 3 Z, then A, B, C (grblHAL). A unit is a mm of cable. `G93` says with each line how long it takes (F is its inverse in
//! minutes), so that all winches end a step together. GRBL stands still at the end of a move unless the next one waits in its queue: a host is some
//! lines ahead. Zero is kept in `G54` (`G10 L20`), which holds through resets. GRBL's own soft limits need homing switches, so they stay off.

use super::family::Family;
use crate::motion::error::MotionError;
use crate::motion::framing::Framing;
use crate::motion::machine::Machine;
use crate::motion::stream::{Move, Stream};
use std::fmt::Write;

pub(super) static FAMILY: Family = Family {
    name: "grbl",
    title: "steppers behind GRBL 1.1 (three winches) or grblHAL (six), told by a computer in G-code",
    extension: "gcode",
    stream: Some(|machine| Ok(Box::new(Grbl::new(machine)?))),
    sketches: None,
    unconfirmed: &["that drivers with more than three axes call them A, B, C"],
};

/// Axes in the order of the winches.
pub const AXES: [char; 6] = ['X', 'Y', 'Z', 'A', 'B', 'C'];
/// Moves that wait in the queue before the first one begins.
const QUEUED: usize = 3;
/// Codes that GRBL obeys wherever they stand: state, hold, go on, reset.
pub const AT_ONCE: &[char] = &['?', '!', '~', '\u{18}'];
/// Motors stay on between moves / are switched off with the sleep.
const ALWAYS_ON: u32 = 255;

/// The commands for one machine.
#[derive(Clone, Debug)]
pub struct Grbl {
    machine: Machine,
}

impl Grbl {
    /// # Errors
    /// More winches than axes.
    pub fn new(machine: &Machine) -> Result<Self, MotionError> {
        let winches = machine.winches.len();
        if winches > AXES.len() {
            return Err(MotionError::TooManyOfAKind { winches, most: AXES.len(), what: "axes of the firmware" });
        }
        Ok(Self { machine: machine.clone() })
    }

    fn axes(&self) -> impl Iterator<Item = char> {
        AXES.into_iter().take(self.machine.winches.len())
    }
}

impl Stream for Grbl {
    fn machine(&self) -> &Machine {
        &self.machine
    }

    fn framing(&self) -> Framing {
        Framing::Lines { end: "\n", at_once: AT_ONCE }
    }

    fn moves_together(&self) -> bool {
        true
    }

    fn queued(&self) -> usize {
        QUEUED
    }

    fn comment(&self, text: &str) -> Option<String> {
        let plain = |c: char| if c == '(' || c == ')' || !c.is_ascii() || c.is_control() { '_' } else { c };
        Some(format!("({})", text.chars().map(plain).collect::<String>()))
    }

    /// Steps, speeds and accelerations of the axes; this position is zero.
    fn setup(&self) -> Vec<String> {
        let steps = self.machine.controller.drives.steps_per_turn / self.machine.turn_mm();
        let limits = self.machine.limits;
        let mut commands = vec!["$10=0".to_owned(), "$20=0".into(), format!("$1={ALWAYS_ON}")];
        for axis in 0..self.machine.winches.len() {
            let settings = [(100, steps), (110, 60.0 * limits.speed), (120, limits.acceleration)];
            commands.extend(settings.map(|(first, value)| format!("${}={value:.3}", first + axis)));
        }
        let zeros: String = self.axes().map(|axis| format!(" {axis}0")).collect();
        commands.push(format!("G10 L20 P1{zeros}"));
        commands
    }

    fn ready(&self) -> Vec<String> {
        vec!["G21 G90 G54 G94".into()]
    }

    fn load(&self, _step: &Move) -> Vec<String> {
        Vec::new()
    }

    fn go(&self, steps: &[Move]) -> Vec<String> {
        let mut line = String::from("G93 G1");
        for step in steps {
            // Writing to a string cannot fail.
            let _ = write!(line, " {}{:.3}", AXES[step.winch], step.to_mm + 0.0);
        }
        let duration = steps.iter().map(|step| step.duration_s).fold(0.0, f64::max);
        // Without a motion there is no duration: any will do.
        let inverse = if duration > 0.0 { 60.0 / duration } else { 60.0 };
        let _ = write!(line, " F{inverse:.3}");
        vec![line]
    }

    fn load_home(&self) -> Vec<String> {
        self.ready()
    }

    fn go_home(&self) -> Vec<String> {
        let zeros: String = self.axes().map(|axis| format!(" {axis}0")).collect();
        vec![format!("G94 G1{zeros} F{:.3}", 60.0 * self.machine.gently().speed)]
    }

    /// `G4` comes after all moves.
    fn off(&self) -> Vec<String> {
        vec!["G4 P0.1".into(), "$SLP".into()]
    }

    /// A reset ends the sleep; zero stays.
    fn wake(&self) -> Vec<String> {
        vec!["\u{18}".into()]
    }

    fn sleeps(&self, reply: &str) -> bool {
        reply.starts_with("<Sleep")
    }

    /// GRBL wakes in its alarm. Other alarms stay: after a reset in the middle of a move nobody knows where winches are.
    fn unlock(&self) -> Vec<String> {
        vec!["$X".into()]
    }

    fn halt(&self) -> Vec<String> {
        vec!["!".into(), "\u{18}".into()]
    }

    fn confirm_halt(&self) -> Vec<String> {
        vec!["$SLP".into()]
    }

    fn locate(&self, _winch: usize) -> String {
        "?".into()
    }

    /// `<Idle|WPos:1.000,2.000,3.000|...>`.
    fn place_mm(&self, winch: usize, reply: &str) -> Option<f64> {
        let state = reply.strip_prefix('<')?.strip_suffix('>')?;
        if state.starts_with("Alarm") || self.sleeps(reply) {
            return None;
        }
        let places = state.split('|').find_map(|field| field.strip_prefix("WPos:"))?;
        places.split(',').nth(winch)?.parse().ok().filter(|place: &f64| place.is_finite())
    }

    fn taken(&self, _command: &str, reply: &str) -> Result<(), String> {
        match reply {
            "ok" => Ok(()),
            reply => Err(format!("{reply:?}")),
        }
    }

    fn is_aside(&self, reply: &str) -> bool {
        reply.starts_with("Grbl ") || reply.starts_with('[')
    }

    fn address(&self, winch: usize) -> String {
        format!("axis {}", AXES[winch])
    }
}
