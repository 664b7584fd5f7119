//! What a simulated controller is.

/// A winch of a simulated controller.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Axis {
    /// In the units of the family: counts, steps, mm, microseconds.
    pub position: f64,
    pub on: bool,
    pub moving: bool,
}

/// The controllers of all winches on one line.
pub trait Controller: Send {
    /// Carries out a command; what is answered, mostly one reply.
    fn obey(&mut self, command: &str) -> Vec<String>;

    /// Breaks down with a command: motors off; what is said of it.
    fn breaks_down(&mut self, command: &str) -> String;

    /// What is said where a drive is at its limit.
    fn refuses(&self, command: &str) -> String;

    /// The winch that a command is for, from 1; none where there is one controller for all.
    fn addressed(&self, command: &str) -> Option<usize>;

    /// Lets time pass.
    fn pass(&mut self, duration_s: f64);

    fn axes(&self) -> Vec<Axis>;
}
