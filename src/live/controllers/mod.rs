//! Controllers that answer as their manuals say, one family a file.

mod bus;
mod classic;
mod controller;
mod grbl;
mod sdo;
mod servo;

pub use controller::{Axis, Controller};

use crate::motion::families::grbl::AT_ONCE;
use crate::motion::{Family, Framing};

/// The controllers of a family, and how they are spoken to.
pub(super) fn of(family: &Family, winches: usize) -> (Box<dyn Controller>, Framing) {
    let lines = |end| Framing::Lines { end, at_once: &[] };
    match family.name {
        "sdo" => (Box::new(sdo::Drives::new(winches)), Framing::Sdo),
        "bus-servo" => (Box::new(bus::BusServos::new(winches)), Framing::Bus),
        "grbl" => (Box::new(grbl::Machine::new(winches)), Framing::Lines { end: "\n", at_once: AT_ONCE }),
        "servo" => (Box::new(servo::Sketch::new(winches)), lines("\n")),
        _ => (Box::new(classic::Drives::new(winches)), lines("\r")),
    }
}
