//! The link into a file: what a sender would put on the line, to be sent later by other means.

use crate::motion::link::{Link, LinkError, Reply};
use crate::motion::program::Program;

/// Collects commands as bytes. It is always open, never answers, and its clock runs as fast as anybody waits.
#[derive(Clone, Debug, Default)]
pub struct FileLink {
    terminator: &'static str,
    bytes: Vec<u8>,
    now_s: f64,
}

impl FileLink {
    /// An empty file of commands that end with `terminator`.
    pub fn new(terminator: &'static str) -> Self {
        Self { terminator, ..Self::default() }
    }

    /// A whole program; the same as transmitting it.
    pub fn of(program: &Program) -> Self {
        let mut link = Self::new(program.terminator);
        program.commands().for_each(|command| link.record(command));
        link
    }

    /// The content of the file.
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    fn record(&mut self, command: &str) {
        self.bytes.extend(command.as_bytes());
        self.bytes.extend(self.terminator.as_bytes());
    }
}

impl Link for FileLink {
    fn open(&mut self) -> Result<(), LinkError> {
        self.now_s = 0.0;
        Ok(())
    }

    fn send(&mut self, command: &str) -> Result<(), LinkError> {
        self.record(command);
        Ok(())
    }

    fn read(&mut self, _patience_s: f64) -> Result<Reply, LinkError> {
        Ok(Reply::OneWay)
    }

    fn now_s(&self) -> f64 {
        self.now_s
    }

    fn wait_until(&mut self, time_s: f64) -> Result<(), LinkError> {
        self.now_s = self.now_s.max(time_s);
        Ok(())
    }
}
