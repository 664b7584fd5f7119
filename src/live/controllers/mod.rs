//! Controllers that answer as their manuals say, one family a file.

mod bus;
mod classic;
mod grbl;
mod sdo;
mod servo;

use crate::motion::families::{bus as bus_words, grbl as grbl_words};
use crate::motion::{Family, Framing};

/// A winch of a simulated controller.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Axis {
    /// In the units of the family: counts, steps, mm, microseconds.
    pub position: f64,
    /// The largest distance from zero that it ever had, in these units.
    pub farthest: f64,
    pub on: bool,
    pub moving: bool,
}

/// The controllers of all winches on one line.
pub trait Controller: Send {
    /// Carries out a command; what is answered, mostly one reply.
    fn obey(&mut self, command: &str) -> Vec<String>;

    /// Breaks down with a command: motors off; what is said of it.
    fn breaks_down(&mut self, command: &str) -> String;

    /// What is said where a drive is at its limit.
    fn refuses(&self, command: &str) -> String;

    /// The winch that a command is for, from 1; none where there is one controller for all.
    fn addressed(&self, command: &str) -> Option<usize>;

    /// Lets time pass.
    fn pass(&mut self, duration_s: f64);

    fn axes(&self) -> Vec<Axis>;
}

/// The controllers of a family, and how they are spoken to.
pub(super) fn of(family: &Family, winches: usize) -> (Box<dyn Controller>, Framing) {
    let lines = |end| Framing::Lines { end, at_once: &[] };
    match family.name {
        "sdo" => (Box::new(sdo::Drives::new(winches)), Framing::Sdo),
        "bus-servo" => (Box::new(bus::BusServos::new(winches)), Framing::Bus),
        "grbl" => (Box::new(grbl::Machine::new(winches)), Framing::Lines { end: "\n", at_once: grbl_words::AT_ONCE }),
        "servo" => (Box::new(servo::Sketch::new(winches)), lines("\n")),
        _ => (Box::new(classic::Drives::new(winches)), lines("\r")),
    }
}

/// Position of rest of a servo on a bus, steps.
const REST: f64 = bus_words::REST as f64;
