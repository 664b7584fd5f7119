//! The V3 family of motion controllers (Faulhaber MC 5004 / 5005 / 5010, MCS), told by a host in binary frames over RS-232.
//!
//! A frame is `53 length node command index(2) subindex data.. crc 45`: command 2 writes an object of CiA 402, 1 reads one; the answer repeats node, command,
//! index and subindex, or has command 3 and a code where it was refused. Numbers are little-endian. The CRC has 8 bits, starts with FF, shifts right with
//! D5 and covers all from the length on. Position mode (6060 = 1): target 607A, speed 6081, start with a rising bit 4 of the controlword 6040.

use super::Family;
use super::classic::{self, FOLLOWING};
use crate::motion::error::MotionError;
use crate::motion::framing::{Framing, bytes_of, hex};
use crate::motion::machine::Machine;
use crate::motion::stream::{Move, Stream};

pub(super) static FAMILY: Family = Family {
    name: "sdo",
    title: "Faulhaber controllers of the V3 family (MC 5004, 5005, 5010, MCS), told by a computer in binary frames",
    extension: "bin",
    stream: Some(|machine| Ok(Box::new(Sdo::new(machine)?))),
    sketches: None,
    unconfirmed: &[
        "that a new target may be set while a move runs (bit 5 of the controlword, as CiA 402 has it)",
        "the unit of 6083 and 6084, believed to be rev/s^2",
    ],
};

/// Writes and reads of objects, and a refusal.
pub const READ: u8 = 1;
pub const WRITE: u8 = 2;
pub const REFUSED: u8 = 3;
/// Messages that drives send on their own: statusword and emergency.
const STATUS: u8 = 5;
const EMERGENCY: u8 = 7;

/// Objects of CiA 402: index and subindex.
pub const CONTROL: (u16, u8) = (0x6040, 0);
pub const MODE: (u16, u8) = (0x6060, 0);
pub const POSITION: (u16, u8) = (0x6064, 0);
pub const TARGET: (u16, u8) = (0x607A, 0);
pub const LOWEST: (u16, u8) = (0x607D, 1);
pub const HIGHEST: (u16, u8) = (0x607D, 2);
pub const SPEED: (u16, u8) = (0x6081, 0);
pub const ACCELERATION: (u16, u8) = (0x6083, 0);
pub const DECELERATION: (u16, u8) = (0x6084, 0);
pub const HOMING: (u16, u8) = (0x6098, 0);

/// Controlwords: ready, switched on, running, a new target at once, homing.
const SHUTDOWN: i64 = 0x06;
const SWITCHED_ON: i64 = 0x07;
const RUNNING: i64 = 0x0F;
const NEW_TARGET: i64 = 0x3F;
const START_HOMING: i64 = 0x1F;
/// Motor off at once.
const OFF: i64 = 0x00;
/// Modes of operation, and the homing method that calls the present position zero.
const POSITIONING: i64 = 1;
const HOMING_MODE: i64 = 6;
const HERE: i64 = 37;

/// The commands for one machine.
#[derive(Clone, Debug)]
pub struct Sdo {
    machine: Machine,
}

/// A frame taken apart.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    pub node: u8,
    pub command: u8,
    pub object: (u16, u8),
    pub data: Vec<u8>,
}

impl Frame {
    /// The hexadecimal digits of the frame, with its length and CRC.
    pub fn digits(&self) -> String {
        let (index, subindex) = self.object;
        let [low, high] = index.to_le_bytes();
        let mut bytes = vec![0x53, 0, self.node, self.command, low, high, subindex];
        bytes.extend(&self.data);
        bytes[1] = bytes.len() as u8;
        bytes.push(crc(&bytes[1..]));
        bytes.push(0x45);
        hex(&bytes)
    }

    /// The frame of such digits; none where it is none, or damaged.
    pub fn parse(digits: &str) -> Option<Self> {
        let bytes = bytes_of(digits);
        let &[0x53, length, node, command, ref rest @ .., check, 0x45] = bytes.as_slice() else { return None };
        if usize::from(length) + 2 != bytes.len() || crc(&bytes[1..bytes.len() - 2]) != check {
            return None;
        }
        // Controlwords and statuswords have no object.
        let (object, data) = match rest {
            [low, high, subindex, data @ ..] => ((u16::from_le_bytes([*low, *high]), *subindex), data),
            data => ((0, 0), data),
        };
        Some(Self { node, command, object, data: data.to_vec() })
    }

    /// The data as a number with a sign, of at most four bytes.
    pub fn value(&self) -> i64 {
        let mut bytes = [0; 4];
        bytes.iter_mut().zip(&self.data).for_each(|(byte, data)| *byte = *data);
        i64::from(i32::from_le_bytes(bytes))
    }
}

/// CRC-8: start FF, shifted right, polynomial D5.
fn crc(bytes: &[u8]) -> u8 {
    let shifted = |crc: u8, _| if crc & 1 == 1 { (crc >> 1) ^ 0xD5 } else { crc >> 1 };
    bytes.iter().fold(0xFF, |crc, byte| (0..8).fold(crc ^ byte, shifted))
}

fn write(node: u8, object: (u16, u8), value: i64) -> String {
    let bytes = match object {
        MODE | HOMING => 1,
        CONTROL => 2,
        _ => 4,
    };
    let data = value.to_le_bytes()[..bytes].to_vec();
    Frame { node, command: WRITE, object, data }.digits()
}

impl Sdo {
    /// # Errors
    /// As for the classic family.
    pub fn new(machine: &Machine) -> Result<Self, MotionError> {
        classic::checked(machine)?;
        Ok(Self { machine: machine.clone() })
    }

    fn nodes(&self) -> impl Iterator<Item = u8> + use<> {
        // At most 255, which was checked.
        (1..=self.machine.winches.len()).map(|node| node as u8)
    }
}

impl Stream for Sdo {
    fn machine(&self) -> &Machine {
        &self.machine
    }

    fn framing(&self) -> Framing {
        Framing::Sdo
    }

    /// Homing where it stands, then limits of travel.
    fn setup(&self) -> Vec<String> {
        let own = |(winch, node): (usize, u8)| {
            let high = self.machine.counts(self.machine.travel_mm[winch]);
            [
                (CONTROL, SHUTDOWN),
                (MODE, HOMING_MODE),
                (HOMING, HERE),
                (CONTROL, SWITCHED_ON),
                (CONTROL, RUNNING),
                (CONTROL, START_HOMING),
                (CONTROL, SHUTDOWN),
                (MODE, POSITIONING),
                (LOWEST, -1),
                (HIGHEST, high + 1),
            ]
            .map(|(object, value)| write(node, object, value))
        };
        self.nodes().enumerate().flat_map(own).collect()
    }

    fn ready(&self) -> Vec<String> {
        let following = i64::from(FOLLOWING);
        let on = |node| {
            [
                (MODE, POSITIONING),
                (ACCELERATION, following),
                (DECELERATION, following),
                (CONTROL, SHUTDOWN),
                (CONTROL, SWITCHED_ON),
                (CONTROL, RUNNING),
            ]
            .map(|(object, value)| write(node, object, value))
        };
        self.nodes().flat_map(on).collect()
    }

    fn load(&self, &Move { winch, from_mm, to_mm, duration_s }: &Move) -> Vec<String> {
        let (from, to) = (self.machine.counts(from_mm), self.machine.counts(to_mm));
        let node = (winch + 1) as u8;
        let speed = i64::from(self.machine.rpm(to - from, duration_s));
        // The bit that starts a move falls here, so that it can rise.
        vec![write(node, SPEED, speed), write(node, TARGET, to), write(node, CONTROL, RUNNING)]
    }

    fn go(&self, steps: &[Move]) -> Vec<String> {
        steps.iter().map(|step| write((step.winch + 1) as u8, CONTROL, NEW_TARGET)).collect()
    }

    fn load_home(&self) -> Vec<String> {
        let (speed, acceleration) = (self.machine.gentle_rpm(), self.machine.controller.acceleration);
        let home = |node| {
            [
                (SPEED, i64::from(speed)),
                (ACCELERATION, i64::from(acceleration)),
                (DECELERATION, i64::from(acceleration)),
                (TARGET, 0),
                (CONTROL, RUNNING),
            ]
            .map(|(object, value)| write(node, object, value))
        };
        self.nodes().flat_map(home).collect()
    }

    fn go_home(&self) -> Vec<String> {
        self.nodes().map(|node| write(node, CONTROL, NEW_TARGET)).collect()
    }

    fn off(&self) -> Vec<String> {
        self.nodes().map(|node| write(node, CONTROL, SHUTDOWN)).collect()
    }

    fn confirm_halt(&self) -> Vec<String> {
        self.nodes().map(|node| write(node, CONTROL, OFF)).collect()
    }

    fn locate(&self, winch: usize) -> String {
        Frame { node: (winch + 1) as u8, command: READ, object: POSITION, data: Vec::new() }.digits()
    }

    fn place_mm(&self, winch: usize, reply: &str) -> Option<f64> {
        let frame = Frame::parse(reply)?;
        let asked = (usize::from(frame.node), frame.command, frame.object) == (winch + 1, READ, POSITION);
        (asked && frame.data.len() == 4).then(|| frame.value() as f64 / self.machine.counts_per_mm)
    }

    fn taken(&self, command: &str, reply: &str) -> Result<(), String> {
        let (asked, told) = (Frame::parse(command), Frame::parse(reply));
        match (asked, told) {
            (Some(asked), Some(told)) if told.command == REFUSED && told.node == asked.node => {
                Err(format!("SDO error {:08X}", told.value() as u32))
            }
            (Some(asked), Some(told))
                if (told.node, told.command, told.object) == (asked.node, asked.command, asked.object) =>
            {
                Ok(())
            }
            _ => Err(format!("frame {reply}")),
        }
    }

    fn addressed(&self, command: &str) -> Option<usize> {
        usize::from(Frame::parse(command)?.node).checked_sub(1)
    }

    fn is_aside(&self, reply: &str) -> bool {
        Frame::parse(reply).is_some_and(|frame| matches!(frame.command, STATUS | EMERGENCY | 0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_carry_their_length_and_check() {
        let frame = Frame { node: 1, command: WRITE, object: TARGET, data: vec![0x10, 0x27, 0, 0] };
        let digits = frame.digits();
        assert!(digits.starts_with("530B01027A600010270000") && digits.ends_with("45"), "{digits}");
        assert_eq!((Frame::parse(&digits), frame.value()), (Some(frame), 10_000));
        // The check is that of a polynomial division: appended, it leaves nothing.
        let bytes = bytes_of(&digits);
        assert_eq!(crc(&bytes[1..bytes.len() - 1]), 0);
        for at in 0..bytes.len() {
            let mut damaged = bytes.clone();
            damaged[at] ^= 4;
            assert_eq!(Frame::parse(&hex(&damaged)), None, "byte {at}");
        }
        assert_eq!(Frame::parse(""), None);
    }
}
