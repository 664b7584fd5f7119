//! Programs: commands to motors, each step at its time.

use super::framing::Framing;
use std::fmt::{self, Write};

/// Commands in the order in which they are sent: those of the setup, then those of every step.
#[derive(Clone, Debug, PartialEq)]
pub struct Program {
    /// How commands lie on the line and in a file.
    pub framing: Framing,
    /// All commands, each followed by [`SEPARATOR`]: a program may have millions.
    text: String,
    /// End of the setup in the text.
    setup: usize,
    steps: Vec<Step>,
}

#[derive(Clone, Debug, PartialEq)]
struct Step {
    time_s: f64,
    /// End of the step in the text.
    end: usize,
}

/// No family has it within a command.
const SEPARATOR: char = '\n';

impl Program {
    /// An empty program for motors that take such commands.
    pub fn new(framing: Framing) -> Self {
        Self { framing, text: String::new(), setup: 0, steps: Vec::new() }
    }

    /// Begins a step; what is pushed from now on is sent when its time has come.
    pub fn begin_step(&mut self, time_s: f64) {
        self.steps.push(Step { time_s, end: self.text.len() });
    }

    /// Adds a command, to the setup as long as no step has begun.
    pub fn push(&mut self, command: fmt::Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ = self.text.write_fmt(command);
        self.text.push(SEPARATOR);
        match self.steps.last_mut() {
            Some(step) => step.end = self.text.len(),
            None => self.setup = self.text.len(),
        }
    }

    /// Adds commands, as [`Program::push`] does.
    pub fn extend(&mut self, commands: impl IntoIterator<Item = String>) {
        commands.into_iter().for_each(|command| self.push(format_args!("{command}")));
    }

    /// Every command, first to last.
    pub fn commands(&self) -> impl Iterator<Item = &str> {
        split(&self.text)
    }

    /// Commands that are sent before the clock starts.
    pub fn setup(&self) -> impl Iterator<Item = &str> {
        split(&self.text[..self.setup])
    }

    /// Steps: when, s, and the commands.
    pub fn steps(&self) -> impl Iterator<Item = (f64, impl Iterator<Item = &str>)> {
        let starts = std::iter::once(self.setup).chain(self.steps.iter().map(|step| step.end));
        self.steps.iter().zip(starts).map(|(step, start)| (step.time_s, split(&self.text[start..step.end])))
    }

    /// All commands as they lie on the line: the content of a file.
    pub fn bytes(&self) -> Vec<u8> {
        self.commands().flat_map(|command| self.framing.encode(command)).collect()
    }
}

fn split(text: &str) -> impl Iterator<Item = &str> {
    text.split_terminator(SEPARATOR)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commands_are_kept_with_their_steps() {
        let mut program = Program::new(Framing::Lines { end: "\r", at_once: &[] });
        program.push(format_args!("{}EN", 1));
        for step in 0..2 {
            program.begin_step(0.5 * f64::from(step));
            program.push(format_args!("1LA{}", 10 * step));
            program.push(format_args!("1M"));
        }
        program.begin_step(2.0);
        assert_eq!(program.setup().collect::<Vec<_>>(), ["1EN"]);
        let steps: Vec<(f64, Vec<&str>)> = program.steps().map(|(time, commands)| (time, commands.collect())).collect();
        assert_eq!(steps, [(0.0, vec!["1LA0", "1M"]), (0.5, vec!["1LA10", "1M"]), (2.0, vec![])]);
        assert_eq!(program.commands().count(), 5);
        assert_eq!(program.bytes(), b"1EN\r1LA0\r1M\r1LA10\r1M\r");
    }
}
