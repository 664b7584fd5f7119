//! Serial ports.

use super::link::Link;
use serialport::SerialPort;
use std::io::{self, ErrorKind, Read, Write};
use std::time::{Duration, Instant};

/// An open serial port, 8N1, that nobody else can open meanwhile.
pub struct SerialLink {
    port: Box<dyn SerialPort>,
    opened: Instant,
}

/// Longest wait for the port to take what is sent, s: far beyond what any command needs, and short enough that a stuck line is noticed.
const WRITE_PATIENCE: Duration = Duration::from_millis(500);
/// Most bytes that are taken at once.
const CHUNK: usize = 512;

impl SerialLink {
    /// Opens a port by its path (`/dev/ttyUSB0`, `COM3`).
    ///
    /// # Errors
    /// A port that is not there, is in use, may not be opened, or does not know the speed.
    pub fn open(path: &str, baud: u32) -> io::Result<Self> {
        let port = serialport::new(path, baud).timeout(WRITE_PATIENCE).open().map_err(io::Error::from)?;
        Ok(Self { port, opened: Instant::now() })
    }
}

/// The serial ports that there are, by their paths, in order.
pub fn ports() -> Vec<String> {
    let mut ports: Vec<String> =
        serialport::available_ports().unwrap_or_default().into_iter().map(|port| port.port_name).collect();
    ports.sort();
    ports
}

impl Link for SerialLink {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.port.set_timeout(WRITE_PATIENCE)?;
        self.port.write_all(bytes)
    }

    fn receive(&mut self, patience_s: f64) -> io::Result<Vec<u8>> {
        // A timeout of zero would not even look.
        self.port.set_timeout(Duration::from_secs_f64(patience_s.clamp(1e-3, 60.0)))?;
        let mut bytes = vec![0; CHUNK];
        match self.port.read(&mut bytes) {
            Ok(0) => Err(ErrorKind::UnexpectedEof.into()),
            Ok(count) => {
                bytes.truncate(count);
                Ok(bytes)
            }
            Err(e) if matches!(e.kind(), ErrorKind::TimedOut | ErrorKind::WouldBlock | ErrorKind::Interrupted) => {
                Ok(Vec::new())
            }
            Err(e) => Err(e),
        }
    }

    fn now_s(&self) -> f64 {
        self.opened.elapsed().as_secs_f64()
    }

    fn wait_until(&mut self, time_s: f64) {
        let rest = time_s - self.now_s();
        if rest > 0.0 {
            std::thread::sleep(Duration::from_secs_f64(rest));
        }
    }
}
