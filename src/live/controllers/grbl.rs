//! GRBL 1.1: G-code of straight moves, a queue, codes that are obeyed at once.

use super::controller::{Axis, Controller};
use crate::motion::families::grbl::AXES;
use std::collections::VecDeque;

/// One controller for all axes; lengths in mm.
pub(super) struct Machine {
    axes: Vec<f64>,
    /// Position of the machine where the work's zero is.
    zero: Vec<f64>,
    queue: VecDeque<Block>,
    /// Feeds are inverse times, not mm a minute.
    inverse: bool,
    feed: f64,
    state: State,
    held: bool,
    /// Motors hold: since the first move.
    holds: bool,
}

/// A move: from where it begins, to where, and how far it has come.
struct Block {
    from: Option<Vec<f64>>,
    to: Vec<f64>,
    duration_s: f64,
    passed_s: f64,
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    Ready,
    Alarm,
    Sleep,
}

/// Longest line that GRBL takes.
const LONGEST: usize = 80;

impl Machine {
    pub fn new(winches: usize) -> Self {
        Self {
            axes: vec![0.0; winches],
            zero: vec![0.0; winches],
            queue: VecDeque::new(),
            inverse: false,
            feed: 0.0,
            state: State::Ready,
            held: false,
            holds: false,
        }
    }

    fn line(&mut self, line: &str) -> String {
        let plain: String = line.split('(').next().unwrap_or_default().chars().filter(|c| !c.is_whitespace()).collect();
        if line.len() > LONGEST {
            return "error:14".into();
        }
        if let Some(setting) = plain.strip_prefix('$') {
            return self.setting(setting);
        }
        if self.state != State::Ready {
            return "error:9".into();
        }
        self.code(&plain).map_or_else(|error| format!("error:{error}"), |()| "ok".into())
    }

    fn setting(&mut self, setting: &str) -> String {
        match setting {
            "SLP" => {
                self.state = State::Sleep;
                self.holds = false;
                self.queue.clear();
            }
            "X" if self.state == State::Alarm => self.state = State::Ready,
            _ if setting.split_once('=').is_some_and(|(n, v)| n.parse::<u32>().is_ok() && v.parse::<f64>().is_ok()) => {
            }
            _ => return "error:3".into(),
        }
        "ok".into()
    }

    /// A block of words; the number of the error if one is not known.
    fn code(&mut self, text: &str) -> Result<(), u32> {
        let words = words(text).ok_or(1u32)?;
        let has = |letter: char, value: f64| words.contains(&(letter, value));
        let mut to = self.end();
        let mut moved = false;
        for &(letter, value) in &words {
            match (letter, AXES.iter().position(|axis| *axis == letter)) {
                ('G', _) if [0.0, 1.0, 4.0, 10.0, 21.0, 54.0, 90.0].contains(&value) => {}
                ('G', _) if value == 93.0 || value == 94.0 => self.inverse = value == 93.0,
                ('F', _) if value > 0.0 => self.feed = value,
                ('P' | 'L', _) => {}
                (_, Some(axis)) if axis < to.len() => {
                    to[axis] = value + self.zero[axis];
                    moved = true;
                }
                _ => return Err(20),
            }
        }
        if has('G', 10.0) {
            for (axis, letter) in AXES.iter().enumerate().take(self.axes.len()) {
                if let Some((_, value)) = words.iter().find(|(word, _)| word == letter) {
                    self.zero[axis] = self.axes[axis] - value;
                }
            }
        } else if has('G', 4.0) {
            let seconds = words.iter().find(|(letter, _)| *letter == 'P').map_or(0.0, |(_, value)| *value);
            self.queue.push_back(Block { from: None, to, duration_s: seconds, passed_s: 0.0 });
        } else if moved {
            let feed = words.iter().any(|(letter, _)| *letter == 'F');
            if self.inverse && !feed {
                return Err(22);
            }
            let way = self.end().iter().zip(&to).map(|(a, b)| (b - a).powi(2)).sum::<f64>().sqrt();
            let minutes = if self.inverse { 1.0 / self.feed } else { way / self.feed };
            self.holds = true;
            self.queue.push_back(Block { from: None, to, duration_s: 60.0 * minutes, passed_s: 0.0 });
        }
        Ok(())
    }

    /// Where the queue ends.
    fn end(&self) -> Vec<f64> {
        self.queue.back().map_or_else(|| self.axes.clone(), |block| block.to.clone())
    }

    fn at_once(&mut self, code: char) -> Vec<String> {
        match code {
            '?' => vec![self.report()],
            '!' => {
                self.held = true;
                Vec::new()
            }
            '~' => {
                self.held = false;
                Vec::new()
            }
            _ => {
                // A reset in the middle of a move loses the position; after a hold it does not. Sleep ends in an alarm, and that stays.
                let is_still = self.queue.is_empty() || self.held;
                self.state = if self.state == State::Ready && is_still { State::Ready } else { State::Alarm };
                self.queue.clear();
                self.held = false;
                vec!["Grbl 1.1h ['$' for help]".into()]
            }
        }
    }

    fn report(&self) -> String {
        let state = match self.state {
            State::Alarm => "Alarm",
            State::Sleep => "Sleep",
            State::Ready if self.held => "Hold:0",
            State::Ready if self.queue.is_empty() => "Idle",
            State::Ready => "Run",
        };
        let place = |(axis, zero): (&f64, &f64)| format!("{:.3}", axis - zero);
        let places: Vec<String> = self.axes.iter().zip(&self.zero).map(place).collect();
        format!("<{state}|WPos:{}|FS:0,0>", places.join(","))
    }
}

/// The words of a block: a letter and a number each.
fn words(text: &str) -> Option<Vec<(char, f64)>> {
    let mut words = Vec::new();
    let mut rest = text;
    while let Some(letter) = rest.chars().next() {
        let tail = &rest[letter.len_utf8()..];
        let end = tail.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(tail.len());
        words.push((letter.to_ascii_uppercase(), tail[..end].parse().ok()?));
        rest = &tail[end..];
    }
    Some(words)
}

impl Controller for Machine {
    fn obey(&mut self, command: &str) -> Vec<String> {
        let mut letters = command.chars();
        match (letters.next(), letters.next()) {
            (Some(code @ ('?' | '!' | '~' | '\u{18}')), None) => self.at_once(code),
            _ => vec![self.line(command)],
        }
    }

    fn breaks_down(&mut self, _command: &str) -> String {
        self.state = State::Alarm;
        self.queue.clear();
        "ALARM:1".into()
    }

    fn refuses(&self, _command: &str) -> String {
        "error:15".into()
    }

    fn addressed(&self, _command: &str) -> Option<usize> {
        None
    }

    fn pass(&mut self, duration_s: f64) {
        let mut rest = duration_s;
        while rest > 0.0 && !self.held {
            let here = self.axes.clone();
            let Some(block) = self.queue.front_mut() else { return };
            let from = block.from.get_or_insert(here);
            let step = rest.min(block.duration_s - block.passed_s);
            block.passed_s += step;
            rest -= step;
            let over = block.passed_s >= block.duration_s - 1e-12;
            let part = if over { 1.0 } else { block.passed_s / block.duration_s };
            for ((axis, from), to) in self.axes.iter_mut().zip(&*from).zip(&block.to) {
                *axis = from + (to - from) * part;
            }
            if over {
                self.queue.pop_front();
            }
        }
    }

    fn axes(&self) -> Vec<Axis> {
        let moving = self.state == State::Ready && !self.held && !self.queue.is_empty();
        let axis = |(axis, zero): (&f64, &f64)| Axis { position: axis - zero, on: self.holds, moving };
        self.axes.iter().zip(&self.zero).map(axis).collect()
    }
}
