//! Servos on a serial bus (ST3215 class), with the ids 1, 2, ....

use super::controller::{Axis, Controller};
use crate::motion::Drive;
use crate::motion::families::bus::{self, ALL, HERE, LIMITS, LOCK, MOVE, PLACE, Packet, READ, TORQUE, WRITE, value};

/// All servos.
pub(super) struct BusServos {
    servos: Vec<Own>,
}

#[derive(Clone)]
struct Own {
    drive: Drive,
    on: bool,
    limits: [i64; 2],
}

/// Position of rest, steps.
const REST: f64 = bus::REST as f64;
/// Speed and acceleration that a servo has by itself, steps/s and steps/s^2.
const SPEED: f64 = 3400.0;
const ACCELERATION: f64 = 25_400.0;
/// States that a servo reports: an angle beyond its limits, too hot.
const ANGLE: u8 = 0x02;
const HOT: u8 = 0x04;
/// An instruction to look for a servo.
const PING: u8 = 1;

impl BusServos {
    pub fn new(winches: usize) -> Self {
        let mut drive = Drive::new(SPEED, ACCELERATION);
        drive.position = REST;
        drive.halt();
        Self { servos: vec![Own { drive, on: false, limits: [0, 4095] }; winches] }
    }

    fn answer(id: u8, code: u8, data: Vec<u8>) -> String {
        Packet { id, code, data }.digits()
    }
}

impl Controller for BusServos {
    fn obey(&mut self, command: &str) -> Vec<String> {
        let Some(packet) = Packet::parse(command) else { return Vec::new() };
        if packet.id == ALL {
            self.servos.iter_mut().for_each(|own| drop(own.obey(&packet)));
            return Vec::new();
        }
        let winch = usize::from(packet.id).wrapping_sub(1);
        let Some(own) = self.servos.get_mut(winch) else { return Vec::new() };
        let (code, data) = own.obey(&packet);
        vec![Self::answer(packet.id, code, data)]
    }

    fn breaks_down(&mut self, command: &str) -> String {
        let id = Packet::parse(command).map_or(ALL, |packet| packet.id);
        if let Some(own) = self.servos.get_mut(usize::from(id).wrapping_sub(1)) {
            own.off();
        }
        Self::answer(id, HOT, Vec::new())
    }

    fn refuses(&self, command: &str) -> String {
        Self::answer(Packet::parse(command).map_or(ALL, |packet| packet.id), ANGLE, Vec::new())
    }

    fn addressed(&self, command: &str) -> Option<usize> {
        Some(Packet::parse(command).map_or(0, |packet| usize::from(packet.id)))
    }

    fn pass(&mut self, duration_s: f64) {
        for own in self.servos.iter_mut().filter(|own| own.on) {
            own.drive.pass(duration_s);
        }
    }

    fn axes(&self) -> Vec<Axis> {
        let axis = |own: &Own| Axis {
            position: own.drive.position - REST,
            on: own.on,
            moving: own.on && !own.drive.is_there(),
        };
        self.servos.iter().map(axis).collect()
    }
}

impl Own {
    fn off(&mut self) {
        self.on = false;
        self.drive.halt();
    }

    /// State and data of the answer.
    fn obey(&mut self, packet: &Packet) -> (u8, Vec<u8>) {
        match (packet.code, packet.data.as_slice()) {
            (PING, []) => {}
            (READ, [PLACE, 2]) => {
                let place = self.drive.position.round() as i64;
                let word = place.unsigned_abs() as u16 | if place < 0 { 0x8000 } else { 0 };
                return (0, word.to_le_bytes().to_vec());
            }
            (WRITE, [TORQUE, 0]) => self.off(),
            (WRITE, [TORQUE, 1]) => self.on = true,
            (WRITE, [TORQUE, HERE]) => {
                self.drive.position = REST;
                self.drive.halt();
            }
            (WRITE, [LOCK, _]) => {}
            (WRITE, [LIMITS, a, b, c, d]) => self.limits = [value(*a, *b), value(*c, *d)],
            (WRITE, [MOVE, _, a, b, _, _, c, d]) => {
                let (to, speed) = (value(*a, *b), value(*c, *d));
                if self.limits != [0, 0] && !(self.limits[0]..=self.limits[1]).contains(&to) {
                    return (ANGLE, Vec::new());
                }
                self.on = true;
                (self.drive.target, self.drive.speed) = (to as f64, if speed == 0 { SPEED } else { speed as f64 });
            }
            _ => return (ANGLE, Vec::new()),
        }
        (0, Vec::new())
    }
}
