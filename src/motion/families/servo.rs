//! Hobby servos on a microcontroller that runs one of our sketches (`servo_sketch`), told by a host.
//!
//! A line is a word and numbers: `on`, `go MS US US ...` (all servos to these pulses within so many milliseconds), `off`, `setup`, `?` (where they are).
//! The answer is `ok`, `error ...`, or the pulses after `?`. Pulses are whole microseconds. A servo has no encoder that anybody could ask: the sketch tells what
//! it has last asked for, and zero is where the horn stands at the first pulse.

use super::family::Family;
use crate::motion::error::MotionError;
use crate::motion::framing::Framing;
use crate::motion::limits::MAX_SERVOS;
use crate::motion::machine::Machine;
use crate::motion::stream::{Move, Stream};
use std::fmt::Write;

pub(super) static FAMILY: Family = Family {
    name: "servo",
    title: "hobby servos on a microcontroller with one of the sketches, told by a computer",
    extension: "txt",
    stream: Some(|machine| Ok(Box::new(Servos::new(machine)?))),
    sketches: None,
    unconfirmed: UNCONFIRMED,
};

/// Of the servos, whoever tells them.
pub(super) const UNCONFIRMED: &[&str] = &[
    "the range of your servos and their pulses (controller.drives.servo_degrees, servo_low_us, servo_high_us)",
    "how fast they turn under load: most take 0.1 to 0.2 s for 60 degrees without one",
];
/// The way to zero, mm/s: nobody knows how fast a servo that is switched on gets there.
const GENTLE_MM_S: f64 = 20.0;
/// Shortest time of it, s.
const LEAST_HOME_S: f64 = 1.0;

/// Pulses of the servos of one machine.
#[derive(Clone, Debug)]
pub struct Servos {
    machine: Machine,
}

impl Servos {
    /// # Errors
    /// More winches than a PCA9685 has channels, equal pulses at both ends, or a travel beyond the servos' range.
    pub fn new(machine: &Machine) -> Result<Self, MotionError> {
        let winches = machine.winches.len();
        if winches > MAX_SERVOS {
            return Err(MotionError::TooManyOfAKind { winches, most: MAX_SERVOS, what: "channels of a PCA9685" });
        }
        let drives = &machine.controller.drives;
        if drives.servo_low_us == drives.servo_high_us {
            return Err(MotionError::NoPulses { us: drives.servo_low_us });
        }
        machine.within_degrees(drives.servo_degrees, "a hobby servo")?;
        Ok(Self { machine: machine.clone() })
    }

    /// Microseconds for a mm of cable.
    fn us_per_mm(&self) -> f64 {
        let drives = &self.machine.controller.drives;
        let range = f64::from(drives.servo_high_us) - f64::from(drives.servo_low_us);
        range * self.machine.degrees(1.0) / drives.servo_degrees
    }

    /// The pulse of a length, microseconds.
    pub(super) fn pulse(&self, length_mm: f64) -> i64 {
        i64::from(self.machine.controller.drives.servo_low_us) + (self.us_per_mm() * length_mm).round() as i64
    }

    /// Duration of the way to zero, ms.
    pub(super) fn home_ms(&self) -> u64 {
        let farthest = self.machine.travel_mm.iter().copied().fold(0.0, f64::max);
        (1e3 * (farthest / GENTLE_MM_S).max(LEAST_HOME_S)).round() as u64
    }

    fn go_within(&self, ms: u64, pulses: impl Iterator<Item = i64>) -> String {
        let mut line = format!("go {ms}");
        for pulse in pulses {
            // Writing to a string cannot fail.
            let _ = write!(line, " {pulse}");
        }
        line
    }
}

impl Stream for Servos {
    fn machine(&self) -> &Machine {
        &self.machine
    }

    fn framing(&self) -> Framing {
        Framing::Lines { end: "\n", at_once: &[] }
    }

    fn moves_together(&self) -> bool {
        true
    }

    fn comment(&self, text: &str) -> Option<String> {
        Some(format!("# {}", text.replace(|c: char| c.is_control() || !c.is_ascii(), "_")))
    }

    fn setup(&self) -> Vec<String> {
        vec!["setup".into()]
    }

    fn ready(&self) -> Vec<String> {
        vec!["on".into()]
    }

    fn load(&self, _step: &Move) -> Vec<String> {
        Vec::new()
    }

    fn go(&self, steps: &[Move]) -> Vec<String> {
        let duration = steps.iter().map(|step| step.duration_s).fold(0.0, f64::max);
        vec![self.go_within((1e3 * duration).round() as u64, steps.iter().map(|step| self.pulse(step.to_mm)))]
    }

    fn load_home(&self) -> Vec<String> {
        Vec::new()
    }

    fn go_home(&self) -> Vec<String> {
        vec![self.go_within(self.home_ms(), self.machine.winches.iter().map(|_| self.pulse(0.0)))]
    }

    fn off(&self) -> Vec<String> {
        vec!["off".into()]
    }

    fn locate(&self, _winch: usize) -> String {
        "?".into()
    }

    fn place_mm(&self, winch: usize, reply: &str) -> Option<f64> {
        let pulse: i64 = reply.split(' ').nth(winch)?.parse().ok()?;
        Some((pulse - self.pulse(0.0)) as f64 / self.us_per_mm() + 0.0)
    }

    fn taken(&self, _command: &str, reply: &str) -> Result<(), String> {
        if reply == "ok" { Ok(()) } else { Err(format!("{reply:?}")) }
    }

    /// What the sketch says when it starts.
    fn is_aside(&self, reply: &str) -> bool {
        reply.starts_with("plushwright ")
    }

    fn home_s(&self) -> f64 {
        self.home_ms() as f64 / 1e3
    }

    fn address(&self, winch: usize) -> String {
        format!("channel {winch}")
    }
}
