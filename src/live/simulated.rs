//! The link to simulated controllers, in virtual time: ten minutes pass in a moment.

use super::link::Link;
use super::simulation::Simulation;
use std::io::{self, ErrorKind};
use std::time::{Duration, Instant};

/// A line to simulated controllers.
pub struct SimulatedLink {
    simulation: Simulation,
    /// When it began, where virtual time is that of the wall.
    paced: Option<Instant>,
}

impl SimulatedLink {
    pub fn new(simulation: Simulation) -> Self {
        Self { simulation, paced: None }
    }

    /// Whose time is that of the wall, also while nobody tells it anything, for somebody to look at.
    pub fn paced(simulation: Simulation) -> Self {
        Self { simulation, paced: Some(Instant::now()) }
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
        let rest_s = time_s - self.now_s();
        if self.paced.is_some() && rest_s > 0.0 {
            std::thread::sleep(Duration::from_secs_f64(rest_s));
        }
        self.simulation.pass_to(time_s);
    }

    /// What the wall's clock is ahead, passes here as well.
    fn catch_up(&mut self) {
        let now_s = self.now_s();
        self.simulation.pass_to(now_s);
    }

    fn carries(&self) -> io::Result<()> {
        if self.simulation.is_gone() { Err(ErrorKind::BrokenPipe.into()) } else { Ok(()) }
    }
}

impl Link for SimulatedLink {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.carries()?;
        self.catch_up();
        self.simulation.put(bytes);
        Ok(())
    }

    fn receive(&mut self, patience_s: f64) -> io::Result<Vec<u8>> {
        self.carries()?;
        self.catch_up();
        let end_s = self.simulation.now_s() + patience_s;
        if let Some(due_s) = self.simulation.next_reply_s().filter(|due_s| *due_s <= end_s) {
            self.pass_to(due_s);
            return Ok(self.simulation.take());
        }
        self.pass_to(end_s);
        Ok(Vec::new())
    }

    fn now_s(&self) -> f64 {
        let now_s = self.simulation.now_s();
        self.paced.map_or(now_s, |began| now_s.max(began.elapsed().as_secs_f64()))
    }

    fn wait_until(&mut self, time_s: f64) {
        self.pass_to(time_s);
    }
}
