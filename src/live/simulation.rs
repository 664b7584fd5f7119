//! Simulated controllers at the other end of a line: what they get, when they answer, and what goes wrong.

use super::controllers::{self, Axis, Controller};
use super::fault::{Fault, FaultKind};
use crate::motion::{Family, Framing, bytes_of};
use std::collections::VecDeque;

/// Controllers on a line with a clock.
pub struct Simulation {
    controller: Box<dyn Controller>,
    framing: Framing,
    /// Time from a command's last byte to the first of its reply, s.
    latency_s: f64,
    /// Time of a byte on the line, s.
    byte_s: f64,
    faults: Vec<Fault>,
    /// Winches that hear nothing any more.
    missing: Vec<usize>,
    /// What has come of a command that is not whole.
    received: Vec<u8>,
    /// Replies on their way.
    replies: VecDeque<(f64, Vec<u8>)>,
    commands: usize,
    gone: bool,
    now_s: f64,
    /// When the line is free again.
    free_s: f64,
    /// The largest distance from zero that every winch ever had.
    farthest: Vec<f64>,
}

/// The winches are looked at this often while time passes, s: a turn back between two looks is hardly missed.
const LOOK_S: f64 = 0.005;

/// Noise instead of a reply, and its end.
const NOISE: &[u8] = b"\x00#\x7F~";
/// The same where replies are frames.
const BINARY_NOISE: &[u8] = &[0x13, 0x37, 0x00];
const BITS_A_BYTE: f64 = 10.0;

impl Simulation {
    /// Controllers of a family that is told by a host, for so many winches: at rest at zero, motors off, as from the factory. Replies come after 16 ms
    /// on a line of 115 200 baud.
    pub fn of(family: &Family, winches: usize) -> Self {
        let (controller, framing) = controllers::of(family, winches);
        Self {
            controller,
            framing,
            latency_s: 0.016,
            byte_s: BITS_A_BYTE / 115_200.0,
            faults: Vec::new(),
            missing: Vec::new(),
            received: Vec::new(),
            replies: VecDeque::new(),
            commands: 0,
            gone: false,
            now_s: 0.0,
            free_s: 0.0,
            farthest: vec![0.0; winches],
        }
    }

    /// With another time until replies, s, and another speed of the line, baud.
    pub fn on_line(self, latency_s: f64, baud: f64) -> Self {
        Self { latency_s, byte_s: BITS_A_BYTE / baud, ..self }
    }

    /// With these faults.
    pub fn with_faults(self, faults: Vec<Fault>) -> Self {
        Self { faults, ..self }
    }

    /// The winches.
    pub fn axes(&self) -> Vec<Axis> {
        self.controller.axes()
    }

    /// The largest distance from zero that every winch ever had, in the units of the family.
    pub fn farthest(&self) -> &[f64] {
        &self.farthest
    }

    /// Commands that have come.
    pub fn commands(&self) -> usize {
        self.commands
    }

    /// Whether the line broke.
    pub fn is_gone(&self) -> bool {
        self.gone
    }

    pub fn now_s(&self) -> f64 {
        self.now_s
    }

    /// When the next reply is there, s.
    pub fn next_reply_s(&self) -> Option<f64> {
        self.replies.front().map(|(due_s, _)| *due_s)
    }

    /// Lets time pass; none where it is later.
    pub fn pass_to(&mut self, time_s: f64) {
        while time_s > self.now_s {
            let next_s = time_s.min(self.now_s + LOOK_S);
            self.controller.pass(next_s - self.now_s);
            self.now_s = next_s;
            for (farthest, axis) in self.farthest.iter_mut().zip(self.controller.axes()) {
                *farthest = farthest.max(axis.position.abs());
            }
        }
    }

    /// Takes the replies that are there.
    pub fn take(&mut self) -> Vec<u8> {
        let mut bytes = Vec::new();
        while let Some((_, reply)) = self.replies.pop_front_if(|(due_s, _)| *due_s <= self.now_s) {
            bytes.extend(reply);
        }
        bytes
    }

    /// Bytes arrive; whole commands are obeyed when their last byte has.
    pub fn put(&mut self, bytes: &[u8]) {
        self.free_s = self.free_s.max(self.now_s) + self.byte_s * bytes.len() as f64;
        self.received.extend(bytes);
        while let Some(command) = self.framing.take_command(&mut self.received) {
            self.pass_to(self.free_s);
            self.commands += 1;
            self.obey(&command);
        }
    }

    fn obey(&mut self, command: &str) {
        let fault = self.faults.iter().find(|fault| fault.at == self.commands).map(|fault| fault.kind);
        match fault {
            Some(FaultKind::Gone) => {
                self.gone = true;
                return self.replies.clear();
            }
            Some(FaultKind::Missing(winch)) => self.missing.push(winch),
            _ => {}
        }
        let addressed = self.controller.addressed(command);
        if addressed.is_some_and(|winch| self.missing.contains(&winch))
            || (addressed.is_none() && !self.missing.is_empty())
        {
            // A single controller for all winches is missing as a whole; nobody answers for a drive that is not there.
            return;
        }
        let replies = match fault {
            Some(FaultKind::Error) => vec![self.controller.breaks_down(command)],
            Some(FaultKind::Limit) => vec![self.controller.refuses(command)],
            _ => self.controller.obey(command),
        };
        for reply in replies {
            let bytes = match (fault, self.framing) {
                (Some(FaultKind::NoReply), _) => continue,
                (Some(FaultKind::Garbage), Framing::Lines { .. }) => [NOISE, b"\r\n"].concat(),
                (Some(FaultKind::Garbage), _) => BINARY_NOISE.to_vec(),
                (_, Framing::Lines { .. }) => [reply.as_bytes(), b"\r\n"].concat(),
                _ => bytes_of(&reply),
            };
            self.free_s = self.free_s.max(self.now_s) + self.latency_s + self.byte_s * bytes.len() as f64;
            self.replies.push_back((self.free_s, bytes));
        }
    }
}
