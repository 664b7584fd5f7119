//! A pseudo-terminal: a port that other programs can open, with simulated controllers behind it.

use super::simulation::Simulation;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::{Mode, OFlags, open};
use rustix::io::{Errno, read, write};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};
use std::io;
use std::os::fd::OwnedFd;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Both ends of the terminal.
pub struct PseudoTerminal {
    controller: OwnedFd,
    /// Kept open, so that nothing ends when a program closes its own.
    _port: OwnedFd,
    path: String,
}

/// Longest time until what is due is looked at, s: far below the latency of replies.
const LOOK_S: f64 = 1e-3;

impl PseudoTerminal {
    /// # Errors
    /// What the system says.
    pub fn open() -> io::Result<Self> {
        let controller = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY)?;
        grantpt(&controller)?;
        unlockpt(&controller)?;
        let path = ptsname(&controller, Vec::new())?.to_string_lossy().into_owned();
        let port = open(path.as_str(), OFlags::RDWR | OFlags::NOCTTY, Mode::empty())?;
        // Bytes as they are: no echo, no lines.
        let mut settings = tcgetattr(&port)?;
        settings.make_raw();
        tcsetattr(&port, OptionalActions::Now, &settings)?;
        Ok(Self { controller, _port: port, path })
    }

    /// Where other programs open it.
    pub fn path(&self) -> &str {
        &self.path
    }

    /// Lets controllers answer until `stop` is raised, its time is over or a fault breaks the line, in the time of the wall.
    ///
    /// # Errors
    /// What the system says.
    pub fn serve(self, simulation: &mut Simulation, stop: &AtomicBool, within_s: Option<f64>) -> io::Result<()> {
        let began = Instant::now();
        let mut bytes = [0; 512];
        let is_time = |began: Instant| within_s.is_none_or(|within_s| began.elapsed().as_secs_f64() < within_s);
        while !stop.load(Ordering::SeqCst) && !simulation.is_gone() && is_time(began) {
            let mut waiting = [PollFd::new(&self.controller, PollFlags::IN)];
            let patience = Timespec { tv_sec: 0, tv_nsec: (1e9 * LOOK_S) as _ };
            let came = match poll(&mut waiting, Some(&patience)) {
                Ok(ready) => ready > 0,
                Err(Errno::INTR) => false,
                Err(e) => return Err(e.into()),
            };
            simulation.pass_to(began.elapsed().as_secs_f64());
            if came {
                let count = read(&self.controller, &mut bytes)?;
                simulation.put(&bytes[..count]);
            }
            let replies = simulation.take();
            if !replies.is_empty() {
                write(&self.controller, &replies)?;
            }
        }
        Ok(())
    }
}
