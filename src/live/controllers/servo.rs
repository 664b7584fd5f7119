//! A microcontroller with one of our sketches and its hobby servos.

use super::controller::{Axis, Controller};

/// The sketch; pulses in microseconds.
pub(super) struct Sketch {
    at: Vec<f64>,
    from: Vec<f64>,
    to: Vec<f64>,
    passed_s: f64,
    lasts_s: f64,
    on: bool,
}

/// Pulses at rest and at the other end: those of servos as they are usually sold.
const ENDS_US: [f64; 2] = [500.0, 2500.0];

impl Sketch {
    pub fn new(winches: usize) -> Self {
        let rest = vec![ENDS_US[0]; winches];
        Self { at: rest.clone(), from: rest.clone(), to: rest, passed_s: 0.0, lasts_s: 0.0, on: false }
    }

    fn go(&mut self, to: Vec<f64>, lasts_s: f64) {
        (self.from, self.to) = (self.at.clone(), to);
        (self.passed_s, self.lasts_s) = (0.0, lasts_s);
    }

    fn off(&mut self) {
        self.on = false;
        self.to = self.at.clone();
        self.go(self.at.clone(), 0.0);
    }

    fn go_line(&mut self, words: &[&str]) -> &'static str {
        let figures: Vec<f64> = words.iter().filter_map(|word| word.parse::<i64>().ok()).map(|v| v as f64).collect();
        let [ms, pulses @ ..] = figures.as_slice() else { return "error pulses" };
        if pulses.len() != self.at.len() || figures.len() != words.len() || *ms < 0.0 {
            return "error pulses";
        }
        if pulses.iter().any(|us| !(ENDS_US[0]..=ENDS_US[1]).contains(us)) {
            return "error limit";
        }
        if !self.on {
            return "error off";
        }
        self.go(pulses.to_vec(), ms / 1e3);
        "ok"
    }
}

impl Controller for Sketch {
    fn obey(&mut self, command: &str) -> Vec<String> {
        let words: Vec<&str> = command.split_whitespace().collect();
        let reply = match words.as_slice() {
            ["setup"] => {
                self.at = vec![ENDS_US[0]; self.at.len()];
                self.on = true;
                self.go(self.at.clone(), 0.0);
                "ok"
            }
            ["on"] => {
                self.on = true;
                self.go(self.at.clone(), 0.0);
                "ok"
            }
            ["off"] => {
                self.off();
                "ok"
            }
            ["go", figures @ ..] => self.go_line(figures),
            ["?"] => return vec![self.at.iter().map(|us| format!("{us:.0}")).collect::<Vec<_>>().join(" ")],
            _ => "error unknown",
        };
        vec![reply.into()]
    }

    fn breaks_down(&mut self, _command: &str) -> String {
        self.off();
        "error supply".into()
    }

    fn refuses(&self, _command: &str) -> String {
        "error limit".into()
    }

    fn addressed(&self, _command: &str) -> Option<usize> {
        None
    }

    fn pass(&mut self, duration_s: f64) {
        self.passed_s += duration_s;
        let part = if self.lasts_s > 0.0 { (self.passed_s / self.lasts_s).min(1.0) } else { 1.0 };
        for (k, at) in self.at.iter_mut().enumerate() {
            *at = self.from[k] + (self.to[k] - self.from[k]) * part;
        }
    }

    fn axes(&self) -> Vec<Axis> {
        let axis = |k: usize| Axis {
            position: self.at[k] - ENDS_US[0],
            on: self.on,
            moving: self.on && self.at[k] != self.to[k],
        };
        (0..self.at.len()).map(axis).collect()
    }
}
