//! The link to simulated drives of the classic ASCII family: trapezoids of speed, and the time that bytes take on the line.
//!
//! A drive moves towards its target with the acceleration AC up to the speed SP, and slows down with DEC so that it stands still
//! there. Nothing pulls at it.

use crate::motion::classic::{TERMINATOR, carried_s};
use crate::motion::link::{Link, LinkError, Reply};
use std::collections::VecDeque;

/// Drives with the nodes 1, 2, ... on one line, in virtual time.
#[derive(Clone, Debug)]
pub struct SimulatedLink {
    drives: Vec<Drive>,
    open: bool,
    now_s: f64,
    /// Replies that nobody has read, without their ends.
    replies: VecDeque<String>,
}

/// One drive. Positions in counts.
#[derive(Clone, Debug)]
struct Drive {
    enabled: bool,
    /// Whether commands are answered.
    answers: bool,
    /// Counts of a revolution.
    resolution: f64,
    /// rpm.
    speed: f64,
    /// rev/s^2.
    acceleration: f64,
    deceleration: f64,
    /// Limits of travel, and whether they are watched.
    limits: [f64; 2],
    limited: bool,
    /// Target that `M` starts for.
    loaded: f64,
    target: f64,
    position: f64,
    /// Counts/s.
    velocity: f64,
}

/// Step of the simulation, s: a drive is where it would be to within its way in one step.
const TICK_S: f64 = 1e-3;
/// Bytes that end a reply.
const REPLY_END: usize = 2;
/// A drive this near to its target is there, counts.
const THERE: f64 = 0.5;

impl SimulatedLink {
    /// Drives as from the factory, not enabled, at position zero; the line is closed.
    pub fn new(drives: usize) -> Self {
        Self { drives: vec![Drive::new(); drives], open: false, now_s: 0.0, replies: VecDeque::new() }
    }

    /// The position of a node, counts; `None` if there is no such node.
    pub fn position(&self, node: usize) -> Option<i64> {
        Some(self.drives.get(node.checked_sub(1)?)?.position.round() as i64)
    }

    /// Lets time pass until every drive that is on stands at its target, for `patience_s` at most; whether they do.
    pub fn settle(&mut self, patience_s: f64) -> bool {
        let end_s = self.now_s + patience_s;
        let moving = |drives: &[Drive]| drives.iter().any(|drive| !drive.is_there());
        while moving(&self.drives) && self.now_s < end_s {
            self.pass(TICK_S);
        }
        !moving(&self.drives)
    }

    fn pass(&mut self, duration_s: f64) {
        self.now_s += duration_s;
        let ticks = (duration_s / TICK_S).ceil().max(1.0);
        for drive in &mut self.drives {
            (0..ticks as u64).for_each(|_| drive.tick(duration_s / ticks));
        }
    }

    /// The time that so many bytes take on the line.
    fn carry(&mut self, bytes: usize) {
        self.pass(carried_s(bytes));
    }
}

impl Link for SimulatedLink {
    fn open(&mut self) -> Result<(), LinkError> {
        self.open = true;
        self.now_s = 0.0;
        Ok(())
    }

    fn send(&mut self, command: &str) -> Result<(), LinkError> {
        if !self.open {
            return Err(LinkError::Closed);
        }
        self.carry(command.len() + TERMINATOR.len());
        let digits = command.len() - command.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let (node, order) = command.split_at(digits);
        let node = node.parse::<usize>().ok().and_then(|node| node.checked_sub(1));
        // Nobody answers for a node that is not there.
        let Some(drive) = node.and_then(|node| self.drives.get_mut(node)) else { return Ok(()) };
        let reply = drive.obey(order);
        if drive.answers {
            self.replies.push_back(reply);
        }
        Ok(())
    }

    fn read(&mut self, patience_s: f64) -> Result<Reply, LinkError> {
        match self.replies.pop_front() {
            Some(reply) => {
                self.carry(reply.len() + REPLY_END);
                Ok(Reply::Line(reply))
            }
            None => {
                self.pass(patience_s);
                Ok(Reply::Nothing)
            }
        }
    }

    fn now_s(&self) -> f64 {
        self.now_s
    }

    fn wait_until(&mut self, time_s: f64) -> Result<(), LinkError> {
        if time_s > self.now_s {
            self.pass(time_s - self.now_s);
            self.now_s = time_s;
        }
        Ok(())
    }
}

impl Drive {
    fn new() -> Self {
        Self {
            enabled: false,
            answers: true,
            resolution: 2048.0,
            speed: 5000.0,
            acceleration: 100.0,
            deceleration: 100.0,
            limits: [f64::NEG_INFINITY, f64::INFINITY],
            limited: false,
            loaded: 0.0,
            target: 0.0,
            position: 0.0,
            velocity: 0.0,
        }
    }

    /// Carries out a command without its node; what the drive answers.
    fn obey(&mut self, order: &str) -> String {
        let split = order.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(order.len());
        let (name, argument) = order.split_at(split);
        let value = argument.parse::<f64>().ok();
        match (name.to_ascii_uppercase().as_str(), value) {
            ("POS", None) => return format!("{:.0}", self.position),
            ("EN", None) => self.enabled = true,
            ("DI", None) => self.enabled = false,
            ("M", None) if !self.enabled => return "Command not available".into(),
            ("M", None) => self.target = self.loaded,
            ("ANSW", Some(mode)) => self.answers = mode != 0.0,
            ("ENCRES", Some(counts)) if counts > 0.0 => self.resolution = counts,
            ("SP", Some(rpm)) if rpm >= 0.0 => self.speed = rpm,
            ("AC", Some(rate)) if rate > 0.0 => self.acceleration = rate,
            ("DEC", Some(rate)) if rate > 0.0 => self.deceleration = rate,
            ("LL", Some(limit)) if limit < 0.0 => self.limits[0] = limit,
            ("LL", Some(limit)) if limit > 0.0 => self.limits[1] = limit,
            ("APL", Some(on)) => self.limited = on != 0.0,
            ("HO", Some(here)) => (self.position, self.target, self.loaded) = (here, here, here),
            ("LA", Some(to)) if self.allows(to) => self.loaded = to,
            ("LR", Some(by)) if self.allows(self.target + by) => self.loaded = self.target + by,
            ("ENCRES" | "SP" | "AC" | "DEC" | "LL" | "LA" | "LR", _) => return "Invalid parameter".into(),
            _ => return "Unknown command".into(),
        }
        "OK".into()
    }

    fn allows(&self, to: f64) -> bool {
        !self.limited || (self.limits[0]..=self.limits[1]).contains(&to)
    }

    fn is_there(&self) -> bool {
        !self.enabled || (self.position == self.target && self.velocity == 0.0)
    }

    /// Moves for `dt` s.
    fn tick(&mut self, dt: f64) {
        if self.is_there() {
            return;
        }
        let distance = self.target - self.position;
        let (rise, fall) = (self.acceleration * self.resolution, self.deceleration * self.resolution);
        if distance.abs() < THERE && self.velocity.abs() <= 2.0 * fall * dt {
            (self.position, self.velocity) = (self.target, 0.0);
            return;
        }
        // The speed from which the way that is left after this tick is just enough to stop: v dt + v^2 / (2 fall) = distance.
        let stopping = (fall * dt).hypot((2.0 * fall * distance.abs()).sqrt()) - fall * dt;
        let wanted = distance.signum() * stopping.min(self.speed * self.resolution / 60.0);
        let speeding_up = wanted.abs() > self.velocity.abs() && wanted * self.velocity >= 0.0;
        let most = dt * if speeding_up { rise } else { fall };
        self.velocity += (wanted - self.velocity).clamp(-most, most);
        self.position += self.velocity * dt;
    }
}
