//! Drives of the classic ASCII family, with the nodes 1, 2, ... on one line.

use super::controller::{Axis, Controller};
use crate::motion::Drive;

/// All drives.
pub(super) struct Drives {
    drives: Vec<Own>,
}

/// One drive; rates in counts and s.
#[derive(Clone)]
struct Own {
    drive: Drive,
    enabled: bool,
    /// Whether commands are answered.
    answers: bool,
    /// Counts of a revolution.
    resolution: f64,
    /// Limits of travel, and whether they are watched.
    limits: [f64; 2],
    limited: bool,
    /// Target that `M` starts for, and the limits that it plans with: speed, acceleration, deceleration.
    loaded: f64,
    planned: [f64; 3],
}

/// From the factory: counts of a revolution, rpm, rev/s^2.
const RESOLUTION: f64 = 2048.0;
const SPEED: f64 = 5000.0;
const ACCELERATION: f64 = 100.0;

impl Drives {
    pub fn new(winches: usize) -> Self {
        let drive = Drive::new(SPEED / 60.0 * RESOLUTION, ACCELERATION * RESOLUTION);
        let own = Own {
            drive,
            enabled: false,
            answers: true,
            resolution: RESOLUTION,
            limits: [f64::NEG_INFINITY, f64::INFINITY],
            limited: false,
            loaded: 0.0,
            planned: [drive.speed, drive.acceleration, drive.deceleration],
        };
        Self { drives: vec![own; winches] }
    }

    fn split<'a>(&self, command: &'a str) -> (Option<usize>, &'a str) {
        let digits = command.len() - command.trim_start_matches(|c: char| c.is_ascii_digit()).len();
        let (node, order) = command.split_at(digits);
        (node.parse().ok().filter(|node| (1..=self.drives.len()).contains(node)), order)
    }
}

impl Controller for Drives {
    fn obey(&mut self, command: &str) -> Vec<String> {
        // Nobody answers for a node that is not there.
        let (Some(node), order) = self.split(command) else { return Vec::new() };
        let own = &mut self.drives[node - 1];
        let reply = own.obey(order);
        if own.answers { vec![reply] } else { Vec::new() }
    }

    fn breaks_down(&mut self, command: &str) -> String {
        if let (Some(node), _) = self.split(command) {
            self.drives[node - 1].off();
        }
        "Overtemperature - drive disabled".into()
    }

    fn refuses(&self, _command: &str) -> String {
        "Invalid parameter".into()
    }

    fn addressed(&self, command: &str) -> Option<usize> {
        Some(self.split(command).0.unwrap_or(0))
    }

    fn pass(&mut self, duration_s: f64) {
        for own in self.drives.iter_mut().filter(|own| own.enabled) {
            own.drive.pass(duration_s);
        }
    }

    fn axes(&self) -> Vec<Axis> {
        let axis = |own: &Own| Axis {
            position: own.drive.position,
            on: own.enabled,
            moving: own.enabled && !own.drive.is_there(),
        };
        self.drives.iter().map(axis).collect()
    }
}

impl Own {
    /// Carries out a command without its node; what the drive answers.
    fn obey(&mut self, order: &str) -> String {
        let split = order.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(order.len());
        let (name, argument) = order.split_at(split);
        let value = argument.parse::<f64>().ok().filter(|value| value.is_finite());
        match (name.to_ascii_uppercase().as_str(), value) {
            ("POS", None) => return format!("{:.0}", self.drive.position),
            ("EN", None) => self.enabled = true,
            ("DI", None) => self.off(),
            ("M", None) if !self.enabled => return "Command not available".into(),
            ("M", None) => {
                self.drive.target = self.loaded;
                [self.drive.speed, self.drive.acceleration, self.drive.deceleration] = self.planned;
            }
            ("ANSW", Some(mode)) => self.answers = mode != 0.0,
            ("ENCRES", Some(counts)) if counts > 0.0 => self.resolution = counts,
            ("SP", Some(rpm)) if rpm >= 0.0 => self.planned[0] = rpm / 60.0 * self.resolution,
            ("AC", Some(rate)) if rate > 0.0 => self.planned[1] = rate * self.resolution,
            ("DEC", Some(rate)) if rate > 0.0 => self.planned[2] = rate * self.resolution,
            ("LL", Some(limit)) if limit < 0.0 => self.limits[0] = limit,
            ("LL", Some(limit)) if limit > 0.0 => self.limits[1] = limit,
            ("LPC" | "LCC", Some(current)) if current > 0.0 => {}
            ("APL", Some(on)) => self.limited = on != 0.0,
            ("HO", Some(here)) => {
                (self.drive.position, self.loaded) = (here, here);
                self.drive.halt();
            }
            ("LA", Some(to)) if self.allows(to) => self.loaded = to,
            ("LR", Some(by)) if self.allows(self.drive.target + by) => self.loaded = self.drive.target + by,
            ("ENCRES" | "SP" | "AC" | "DEC" | "LL" | "LA" | "LR" | "LPC" | "LCC", _) => {
                return "Invalid parameter".into();
            }
            _ => return "Unknown command".into(),
        }
        "OK".into()
    }

    fn allows(&self, to: f64) -> bool {
        !self.limited || (self.limits[0]..=self.limits[1]).contains(&to)
    }

    fn off(&mut self) {
        self.enabled = false;
        self.drive.halt();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answers(drives: &mut Drives, commands: &[&str]) -> Vec<String> {
        commands.iter().flat_map(|command| drives.obey(command)).collect()
    }

    #[test]
    fn drives_obey_only_what_they_know_and_may() {
        let mut drives = Drives::new(2);
        assert_eq!(
            answers(&mut drives, &["1FLY", "1SP-4", "1M"]),
            ["Unknown command", "Invalid parameter", "Command not available"]
        );
        assert_eq!(answers(&mut drives, &["3EN", "EN", "0EN"]), [""; 0], "nobody is there");
        let setup = ["1HO0", "1LL100", "1LL-1", "1APL1", "1EN", "1la101", "1LA90", "1M"];
        assert_eq!(answers(&mut drives, &setup), ["OK", "OK", "OK", "OK", "OK", "Invalid parameter", "OK", "OK"]);
        drives.pass(1.0);
        assert_eq!(answers(&mut drives, &["1POS", "2POS", "1DI"]), ["90", "0", "OK"]);
        assert_eq!(drives.axes()[0], Axis { position: 90.0, on: false, moving: false });
    }
}
