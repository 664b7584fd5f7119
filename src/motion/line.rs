//! Serial lines: how long commands and their replies take.

use super::machine::Machine;
use super::stream::Stream;

/// Time from a command's end to its reply, s: what USB adapters add.
pub const LATENCY_S: f64 = 0.016;
/// Bytes of a command of the classic family and its reply, on average.
pub const COMMAND_BYTES: usize = 11;
/// Bits of a byte with its start and its stop.
const BITS_A_BYTE: f64 = 10.0;

/// Time that so many bytes take on the line of a design, s.
pub fn carried_s(machine: &Machine, bytes: usize) -> f64 {
    BITS_A_BYTE * bytes as f64 / f64::from(machine.controller.drives.baud)
}

/// Time of a command of a stream and its reply on the line of its design, s, as expected: a live drive measures it.
pub fn round_trip_s(machine: &Machine, stream: &dyn Stream) -> f64 {
    let command = stream.framing().encode(&stream.locate(0)).len();
    LATENCY_S + carried_s(machine, command.max(COMMAND_BYTES))
}
