//! The link to simulated controllers, in virtual time: ten minutes pass in a moment.

use super::link::Link;
use super::simulation::Simulation;
use std::io::{self, ErrorKind};
use std::time::Duration;

/// A line to simulated controllers.
pub struct SimulatedLink {
    simulation: Simulation,
    /// Virtual time lasts as long as that of the wall.
    paced: bool,
}

impl SimulatedLink {
    pub fn new(simulation: Simulation) -> Self {
        Self { simulation, paced: false }
    }

    /// Whose time lasts as long as that of the wall, for somebody to look at.
    pub fn paced(simulation: Simulation) -> Self {
        Self { simulation, paced: true }
    }

    /// The controllers.
    pub fn simulation(&self) -> &Simulation {
        &self.simulation
    }

    /// Lets time pass, as if nobody sent anything.
    pub fn pass(&mut self, duration_s: f64) {
        self.pass_to(self.simulation.now_s() + duration_s);
    }

    fn pass_to(&mut self, time_s: f64) {
        let rest_s = time_s - self.simulation.now_s();
        if self.paced && rest_s > 0.0 {
            std::thread::sleep(Duration::from_secs_f64(rest_s));
        }
        self.simulation.pass_to(time_s);
    }

    fn carries(&self) -> io::Result<()> {
        if self.simulation.is_gone() { Err(ErrorKind::BrokenPipe.into()) } else { Ok(()) }
    }
}

impl Link for SimulatedLink {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.carries()?;
        self.simulation.put(bytes);
        Ok(())
    }

    fn receive(&mut self, patience_s: f64) -> io::Result<Vec<u8>> {
        self.carries()?;
        let end_s = self.simulation.now_s() + patience_s;
        if let Some(due_s) = self.simulation.next_reply_s().filter(|due_s| *due_s <= end_s) {
            self.pass_to(due_s);
            return Ok(self.simulation.take());
        }
        self.pass_to(end_s);
        Ok(Vec::new())
    }

    fn now_s(&self) -> f64 {
        self.simulation.now_s()
    }

    fn wait_until(&mut self, time_s: f64) {
        self.pass_to(time_s);
    }
}
