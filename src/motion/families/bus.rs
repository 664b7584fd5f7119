//! Serial bus servos (Feetech / Waveshare ST3215 and their like), told by a host.
//!
//! A packet is `FF FF id length instruction data.. sum`; the sum is the complement of all from the id on. Winch `i` (from 1) is id `i`. A servo has 4096
//! steps a turn and its gear within, so that its spool turns as it does. Register 29 holds acceleration, target, time and speed of a move; 28 switches
//! the motor, and 80 there calls the present position 2048. Rest is 2048, so that half a turn can be watched by the servo's own limits; beyond, it
//! turns on with its limits off.

use super::Family;
use crate::motion::error::MotionError;
use crate::motion::framing::{Framing, bytes_of, hex};
use crate::motion::limits::MAX_BUS_NODES;
use crate::motion::machine::Machine;
use crate::motion::stream::{Move, Stream};

pub(super) static FAMILY: Family = Family {
    name: "bus-servo",
    title: "serial bus servos (Feetech, Waveshare ST3215), told by a computer",
    extension: "bin",
    stream: Some(|machine| Ok(Box::new(Bus::new(machine)?))),
    sketches: None,
    unconfirmed: &[
        "that limits of 0 and 0 let a servo turn on, up to 28672 steps from rest",
        "that acceleration 0 is the largest",
        "that 80 (hexadecimal) in register 28 calls the present position 2048",
    ],
};

/// Instructions.
pub const READ: u8 = 2;
pub const WRITE: u8 = 3;
/// The id that all servos obey and none answers.
pub const ALL: u8 = 0xFE;
/// Registers.
pub const LIMITS: u8 = 0x09;
pub const TORQUE: u8 = 0x28;
pub const MOVE: u8 = 0x29;
pub const LOCK: u8 = 0x37;
pub const PLACE: u8 = 0x38;
/// Steps of a turn.
pub const TURN: f64 = 4096.0;
/// Position of rest.
pub const REST: i64 = 2048;
/// Largest position that the servo's own limits can watch.
const WATCHED: i64 = 4095;
/// Largest distance from rest: seven turns.
const FARTHEST: i64 = 28_672;
/// Speed of the way to zero, steps/s: a sixth of a turn a second.
const GENTLE: i64 = 680;
/// Fastest speed that the register holds as asked, steps/s.
const FASTEST: i64 = 3400;
/// Calls the present position [`REST`].
pub const HERE: u8 = 0x80;

/// The commands for one machine.
#[derive(Clone, Debug)]
pub struct Bus {
    machine: Machine,
    steps_per_mm: f64,
}

/// A packet taken apart; `code` is an instruction, or the state of a servo that answers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Packet {
    pub id: u8,
    pub code: u8,
    pub data: Vec<u8>,
}

impl Packet {
    pub fn digits(&self) -> String {
        let mut bytes = vec![0xFF, 0xFF, self.id, self.data.len() as u8 + 2, self.code];
        bytes.extend(&self.data);
        bytes.push(sum(&bytes[2..]));
        hex(&bytes)
    }

    /// The packet of such digits; none where it is none, or damaged.
    pub fn parse(digits: &str) -> Option<Self> {
        let bytes = bytes_of(digits);
        let &[0xFF, 0xFF, id, length, code, ref data @ .., check] = bytes.as_slice() else { return None };
        let sound = usize::from(length) == data.len() + 2 && sum(&bytes[2..bytes.len() - 1]) == check;
        sound.then(|| Self { id, code, data: data.to_vec() })
    }
}

fn sum(bytes: &[u8]) -> u8 {
    !bytes.iter().fold(0u8, |sum, byte| sum.wrapping_add(*byte))
}

/// Two bytes, the low one first; a negative number has its size and bit 15.
fn word(value: i64) -> [u8; 2] {
    let size = value.unsigned_abs().min(0x7FFF) as u16;
    (if value < 0 { size | 0x8000 } else { size }).to_le_bytes()
}

/// The number of such two bytes.
pub fn value(low: u8, high: u8) -> i64 {
    let word = u16::from_le_bytes([low, high]);
    let size = i64::from(word & 0x7FFF);
    if word & 0x8000 == 0 { size } else { -size }
}

fn write(id: u8, register: u8, values: &[u8]) -> String {
    Packet { id, code: WRITE, data: [&[register], values].concat() }.digits()
}

impl Bus {
    /// # Errors
    /// More winches than ids, or a travel beyond the servo's turns.
    pub fn new(machine: &Machine) -> Result<Self, MotionError> {
        let winches = machine.winches.len();
        if winches > MAX_BUS_NODES {
            return Err(MotionError::TooManyOfAKind { winches, most: MAX_BUS_NODES, what: "ids of servos on a bus" });
        }
        let most = 360.0 * FARTHEST as f64 / TURN;
        machine.within_degrees(most, "a serial bus servo")?;
        Ok(Self { machine: machine.clone(), steps_per_mm: TURN / machine.turn_mm() })
    }

    fn ids(&self) -> impl Iterator<Item = u8> + use<> {
        (1..=self.machine.winches.len()).map(|id| id as u8)
    }

    fn steps(&self, length_mm: f64) -> i64 {
        REST + (self.steps_per_mm * length_mm).round() as i64
    }

    /// To a position at a speed; acceleration and time as the servo likes.
    fn to(&self, id: u8, position: i64, speed: i64) -> String {
        let ([a, b], [c, d]) = (word(position), word(speed.clamp(1, FASTEST)));
        write(id, MOVE, &[0, a, b, 0, 0, c, d])
    }
}

impl Stream for Bus {
    fn machine(&self) -> &Machine {
        &self.machine
    }

    fn framing(&self) -> Framing {
        Framing::Bus
    }

    /// Motor off, limits, this position is that of rest.
    fn setup(&self) -> Vec<String> {
        let own = |(winch, id): (usize, u8)| {
            let high = self.steps(self.machine.travel_mm[winch]) + 1;
            let limits = if high <= WATCHED { [word(REST - 1), word(high)].concat() } else { vec![0; 4] };
            [
                write(id, TORQUE, &[0]),
                write(id, LOCK, &[0]),
                write(id, LIMITS, &limits),
                write(id, TORQUE, &[HERE]),
                write(id, LOCK, &[1]),
            ]
        };
        self.ids().enumerate().flat_map(own).collect()
    }

    fn ready(&self) -> Vec<String> {
        self.ids().map(|id| write(id, TORQUE, &[1])).collect()
    }

    fn load(&self, _step: &Move) -> Vec<String> {
        Vec::new()
    }

    fn go(&self, steps: &[Move]) -> Vec<String> {
        let one = |&Move { winch, from_mm, to_mm, duration_s }: &Move| {
            let (from, to) = (self.steps(from_mm), self.steps(to_mm));
            let speed = (to - from).abs() as f64 / duration_s;
            self.to((winch + 1) as u8, to, if speed.is_finite() { speed.ceil() as i64 } else { 1 })
        };
        steps.iter().map(one).collect()
    }

    fn load_home(&self) -> Vec<String> {
        Vec::new()
    }

    fn go_home(&self) -> Vec<String> {
        self.ids().map(|id| self.to(id, REST, GENTLE)).collect()
    }

    fn off(&self) -> Vec<String> {
        self.ids().map(|id| write(id, TORQUE, &[0])).collect()
    }

    fn halt(&self) -> Vec<String> {
        vec![write(ALL, TORQUE, &[0])]
    }

    fn locate(&self, winch: usize) -> String {
        Packet { id: (winch + 1) as u8, code: READ, data: vec![PLACE, 2] }.digits()
    }

    fn place_mm(&self, winch: usize, reply: &str) -> Option<f64> {
        let Packet { id, data, .. } = Packet::parse(reply)?;
        let &[low, high] = data.as_slice() else { return None };
        (usize::from(id) == winch + 1).then(|| (value(low, high) - REST) as f64 / self.steps_per_mm)
    }

    fn taken(&self, command: &str, reply: &str) -> Result<(), String> {
        match (Packet::parse(command), Packet::parse(reply)) {
            (Some(asked), Some(told)) if asked.id == told.id && told.code == 0 => Ok(()),
            (Some(asked), Some(told)) if asked.id == told.id => Err(format!("state {:02X}", told.code)),
            _ => Err(format!("packet {reply}")),
        }
    }

    fn addressed(&self, command: &str) -> Option<usize> {
        usize::from(Packet::parse(command)?.id).checked_sub(1)
    }

    fn home_s(&self) -> f64 {
        let farthest = self.machine.travel_mm.iter().copied().fold(0.0, f64::max);
        self.steps_per_mm * farthest / GENTLE as f64
    }

    fn address(&self, winch: usize) -> String {
        format!("servo {}", winch + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packets_are_those_of_the_servos_manual() {
        // Ping of servo 1, and a write of 0800 and speed 03E8 from register 2A on.
        assert_eq!(Packet { id: 1, code: 1, data: vec![] }.digits(), "FFFF010201FB");
        assert_eq!(write(1, 0x2A, &[0x00, 0x08, 0, 0, 0xE8, 0x03]), "FFFF0109032A00080000E803D5");
        for position in [0, 2048, 30719, -5] {
            let [low, high] = word(position);
            assert_eq!(value(low, high), position);
        }
        assert_eq!(Packet::parse("FFFF010201FC"), None);
    }
}
