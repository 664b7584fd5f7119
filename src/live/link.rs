//! Lines to motors: what every kind of link can do.

use std::io;

/// A line to one or more controllers, with a clock of its own: that of the wall for a serial port, a virtual one for simulations, which never wait.
pub trait Link: Send {
    /// Puts bytes on the line.
    ///
    /// # Errors
    /// A line that is broken.
    fn send(&mut self, bytes: &[u8]) -> io::Result<()>;

    /// Takes what has come; waits for the first byte, for `patience_s` at most. Nothing where nothing came.
    ///
    /// # Errors
    /// A line that is broken.
    fn receive(&mut self, patience_s: f64) -> io::Result<Vec<u8>>;

    /// Time since the line was opened, s.
    fn now_s(&self) -> f64;

    /// Waits until the clock shows `time_s`; not at all if it is later.
    fn wait_until(&mut self, time_s: f64);
}
