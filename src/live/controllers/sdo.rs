//! Drives of the V3 family: objects of CiA 402 in binary frames.

use super::controller::{Axis, Controller};
use crate::motion::Drive;
use crate::motion::families::sdo::{
    ACCELERATION, CONTROL, DECELERATION, Frame, HIGHEST, HOMING, LOWEST, MODE, POSITION, READ, REFUSED, SPEED, TARGET,
    WRITE,
};

/// All drives.
pub(super) struct Drives {
    drives: Vec<Own>,
}

#[derive(Clone)]
struct Own {
    drive: Drive,
    control: i64,
    mode: i64,
    limits: [f64; 2],
    target: f64,
}

/// Counts of a revolution.
const RESOLUTION: f64 = 2048.0;
/// Bits of the controlword: on, running, start.
const RUNNING: i64 = 0x0F;
const START: i64 = 0x10;
/// Mode of operation that finds zero.
const HOMING_MODE: i64 = 6;
/// Codes of refusals (CiA 301): no such object, a value out of range, not now.
const NO_OBJECT: i64 = 0x0602_0000;
const OUT_OF_RANGE: i64 = 0x0609_0030;
const NOT_NOW: i64 = 0x0800_0022;

impl Drives {
    pub fn new(winches: usize) -> Self {
        let own = Own {
            drive: Drive::new(5000.0 / 60.0 * RESOLUTION, 100.0 * RESOLUTION),
            control: 0,
            mode: 1,
            limits: [f64::NEG_INFINITY, f64::INFINITY],
            target: 0.0,
        };
        Self { drives: vec![own; winches] }
    }
}

fn refusal(command: &str, code: i64) -> String {
    let Some(frame) = Frame::parse(command) else { return String::new() };
    Frame { command: REFUSED, data: code.to_le_bytes()[..4].to_vec(), ..frame }.digits()
}

impl Controller for Drives {
    fn obey(&mut self, command: &str) -> Vec<String> {
        let Some(frame) = Frame::parse(command) else { return Vec::new() };
        let node = usize::from(frame.node);
        let Some(own) = node.checked_sub(1).and_then(|winch| self.drives.get_mut(winch)) else { return Vec::new() };
        let answer = match (frame.command, frame.object) {
            (READ, POSITION) => Ok((own.drive.position.round() as i64).to_le_bytes()[..4].to_vec()),
            (WRITE, object) => own.write(object, frame.value()).map(|()| Vec::new()),
            _ => Err(NO_OBJECT),
        };
        vec![match answer {
            Ok(data) => Frame { data, ..frame }.digits(),
            Err(code) => refusal(command, code),
        }]
    }

    fn breaks_down(&mut self, command: &str) -> String {
        if let Some(own) = self.addressed(command).and_then(|node| self.drives.get_mut(node.wrapping_sub(1))) {
            own.control = 0;
            own.drive.halt();
        }
        refusal(command, NOT_NOW)
    }

    fn refuses(&self, command: &str) -> String {
        refusal(command, OUT_OF_RANGE)
    }

    fn addressed(&self, command: &str) -> Option<usize> {
        Some(Frame::parse(command).map_or(0, |frame| usize::from(frame.node)))
    }

    fn pass(&mut self, duration_s: f64) {
        for own in self.drives.iter_mut().filter(|own| own.is_on()) {
            own.drive.pass(duration_s);
        }
    }

    fn axes(&self) -> Vec<Axis> {
        let axis = |own: &Own| Axis {
            position: own.drive.position,
            on: own.is_on(),
            moving: own.is_on() && !own.drive.is_there(),
        };
        self.drives.iter().map(axis).collect()
    }
}

impl Own {
    fn is_on(&self) -> bool {
        self.control & RUNNING == RUNNING
    }

    fn write(&mut self, object: (u16, u8), value: i64) -> Result<(), i64> {
        let figure = value as f64;
        match object {
            CONTROL => self.control_by(value)?,
            MODE => self.mode = value,
            HOMING if value == 37 => {}
            SPEED if value > 0 => self.drive.speed = figure / 60.0 * RESOLUTION,
            ACCELERATION if value > 0 => self.drive.acceleration = figure * RESOLUTION,
            DECELERATION if value > 0 => self.drive.deceleration = figure * RESOLUTION,
            LOWEST => self.limits[0] = figure,
            HIGHEST => self.limits[1] = figure,
            TARGET if (self.limits[0]..=self.limits[1]).contains(&figure) => self.target = figure,
            HOMING | SPEED | ACCELERATION | DECELERATION | TARGET => return Err(OUT_OF_RANGE),
            _ => return Err(NO_OBJECT),
        }
        Ok(())
    }

    /// A rising start bit homes or moves, as the mode is.
    fn control_by(&mut self, word: i64) -> Result<(), i64> {
        let rises = word & START != 0 && self.control & START == 0;
        let was_on = self.is_on();
        if rises && !was_on {
            return Err(NOT_NOW);
        }
        self.control = word & 0xFFFF;
        if !self.is_on() {
            self.drive.halt();
        } else if rises && self.mode == HOMING_MODE {
            (self.drive.position, self.target) = (0.0, 0.0);
            self.drive.halt();
        } else if rises {
            self.drive.target = self.target;
        } else if !was_on {
            self.drive.halt();
        }
        Ok(())
    }
}
