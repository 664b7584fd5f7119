//! `simulate-controller`: controllers behind a port that is none, for tests and demonstrations.

use super::error::CommandError;
use super::output::say;
use super::play::seconds;
use crate::live::{Axis, Fault, Simulation};
use crate::motion::families;
use clap::Args;
use std::io::Write;
use std::sync::atomic::AtomicBool;

/// Answer on a pseudo-terminal as motor controllers do
///
/// Prints the path of the port, then answers until it is interrupted, then says where the winches are. Faults come on request.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright simulate-controller --winches 3 --fault garbage@120")]
pub struct SimulateController {
    /// Family: ascii, sdo, servo, bus-servo, grbl
    #[arg(long, value_name = "NAME", default_value = "ascii")]
    pub controllers: String,
    /// How many winches it has
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u16).range(1..=255))]
    pub winches: u16,
    /// Time from a command to its reply, ms
    #[arg(long, value_name = "MS", default_value_t = 16.0, value_parser = latency)]
    pub latency: f64,
    /// Speed of the line that is simulated, baud
    #[arg(long, value_name = "BAUD", default_value_t = 115_200, value_parser = clap::value_parser!(u32).range(300..=10_000_000))]
    pub baud: u32,
    /// Fault: no-reply, garbage, error, limit, gone or missing:WINCH, with @COMMAND (from 1); may be repeated
    #[arg(long, value_name = "FAULT")]
    pub fault: Vec<Fault>,
    /// End by itself after so long, s
    #[arg(long, value_name = "S", value_parser = seconds)]
    pub seconds: Option<f64>,
}

impl SimulateController {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let family = families::streams().find(|family| family.name == self.controllers).ok_or_else(|| {
            CommandError::Usage(format!("there are no controllers {:?} to simulate", self.controllers))
        })?;
        let simulation = Simulation::of(family, usize::from(self.winches));
        let mut simulation =
            simulation.on_line(self.latency / 1e3, f64::from(self.baud)).with_faults(self.fault.clone());
        self.serve(out, &mut simulation, cancel)?;
        // Drives that lost their line go on to where they were told to.
        let settled_s = simulation.now_s() + SETTLING_S;
        simulation.pass_to(settled_s);
        for (winch, (axis, farthest)) in simulation.axes().into_iter().zip(simulation.farthest()).enumerate() {
            let Axis { position, on, moving } = axis;
            let state = if !on {
                "off"
            } else if moving {
                "moving"
            } else {
                "on"
            };
            say(out, &format!("winch {}: at {position:.1}, farthest {farthest:.1}, {state}", winch + 1))?;
        }
        Ok(())
    }

    #[cfg(unix)]
    fn serve(&self, out: &mut dyn Write, simulation: &mut Simulation, cancel: &AtomicBool) -> Result<(), CommandError> {
        use crate::live::PseudoTerminal;
        let failed = |e: std::io::Error| CommandError::Failed(format!("the pseudo-terminal: {e}"));
        let terminal = PseudoTerminal::open().map_err(failed)?;
        say(out, &format!("port: {}", terminal.path()))?;
        out.flush().map_err(CommandError::Print)?;
        terminal.serve(simulation, cancel, self.seconds).map_err(failed)
    }

    #[cfg(not(unix))]
    fn serve(
        &self,
        _out: &mut dyn Write,
        _simulation: &mut Simulation,
        _cancel: &AtomicBool,
    ) -> Result<(), CommandError> {
        Err(CommandError::Environment("this system has no pseudo-terminals; `play --port simulated` needs none".into()))
    }
}

/// Time in which drives come to their last target, s.
const SETTLING_S: f64 = 5.0;

fn latency(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(ms) if (0.0..=10_000.0).contains(&ms) => Ok(ms),
        _ => Err(format!("expected a time in ms, at most 10000, found `{text}`")),
    }
}
