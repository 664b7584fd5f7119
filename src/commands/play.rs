//! `play`: the animation on motors, live.

use super::error::CommandError;
use super::output::{say, say_json};
use super::{document, words};
use crate::files::shown;
use crate::live::{Played, Stage};
use crate::motion::TooFast;
use crate::operations::Context;
use crate::operations::play::{self, Action, Error, Options};
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Play the animation on motors over a serial port
///
/// Reads every reply, keeps the time, winds back to zero first and at the end, and switches all motors off on any fault or
/// interrupt. It refuses to begin where a winch stands beyond its travel. `--port simulated` plays on simulated controllers in virtual time.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright play pig.plush --port /dev/ttyUSB0 --set-zero")]
pub struct Play {
    /// Design file to read; it needs winches (see `plushwright rig`)
    pub design: PathBuf,
    /// Serial port (/dev/ttyUSB0, COM3), or `simulated`
    #[arg(long, value_name = "PATH")]
    pub port: String,
    /// Family of the controllers: ascii, sdo, servo, bus-servo, grbl
    #[arg(long, value_name = "NAME", default_value = "ascii")]
    pub controllers: String,
    /// Speed of the line, baud; that of the design for ascii, 1000000 for bus-servo, 115200 for others
    #[arg(long, value_name = "BAUD")]
    pub baud: Option<u32>,
    /// First tell the controllers that here is zero, and their limits: only at rest, with all cables just slack
    #[arg(long)]
    pub set_zero: bool,
    /// Give the animation more time where its motors are too slow for it; otherwise such an animation is refused
    #[arg(long)]
    pub stretch: bool,
    /// Play it so many times
    #[arg(long, value_name = "N", default_value_t = 1, conflicts_with_all = ["home", "wind"])]
    pub times: u32,
    /// Only wind back to zero and switch the motors off
    #[arg(long, conflicts_with = "wind")]
    pub home: bool,
    /// Wind by hand to these lengths in mm, one a winch, instead of playing
    #[arg(long, value_name = "MM,..", value_delimiter = ',', allow_hyphen_values = true)]
    pub wind: Vec<f64>,
    /// How long to hold what --wind has wound, s
    #[arg(long, value_name = "S", default_value_t = 5.0, value_parser = seconds)]
    pub hold: f64,
    /// Fault of simulated controllers: no-reply, garbage, error, limit, gone or missing:WINCH, with @COMMAND (from 1); may be repeated
    #[arg(long, value_name = "FAULT")]
    pub fault: Vec<String>,
    /// Print the timing as JSON
    #[arg(long)]
    pub json: bool,
}

/// Format of what `play --json` prints.
const FORMAT: &str = "plushwright-play/1";

/// What `play --json` prints.
#[derive(Serialize)]
struct Summary<'a> {
    plays: &'a [Timing<'a>],
}

/// How a motion kept the time, as it is printed.
#[derive(Serialize)]
struct Timing<'a> {
    #[serde(flatten)]
    played: &'a Played,
    starts: usize,
    late_p95_s: f64,
    late_worst_s: f64,
}

impl Play {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let design = document::load(&self.design)?;
        let played = play::run(&design, &self.options(), &Context::new(cancel), &mut |_: Stage| ())
            .map_err(|error| self.failed(error))?;
        let timings: Vec<Timing> = played.iter().map(timing).collect();
        if self.json {
            return say_json(out, FORMAT, &Summary { plays: &timings });
        }
        for Timing { played, starts, late_p95_s, late_worst_s } in &timings {
            say(
                out,
                &format!(
                    "{}: {:.1} s in slots of {:.3} s, {starts} starts, 95 % at most {:.1} ms late, the worst {:.1} ms; motors off",
                    shown(&self.design),
                    played.lasted_s,
                    played.slot_s,
                    1e3 * late_p95_s,
                    1e3 * late_worst_s
                ),
            )?;
        }
        if timings.is_empty() {
            say(out, &format!("{}: winches at zero, motors off", shown(&self.design)))?;
        }
        Ok(())
    }

    fn options(&self) -> Options {
        let action = if self.home {
            Action::Home
        } else if self.wind.is_empty() {
            Action::Play(self.times)
        } else {
            Action::Wind { lengths_mm: self.wind.clone(), hold_s: self.hold }
        };
        Options {
            port: self.port.clone(),
            family: self.controllers.clone(),
            baud: self.baud,
            too_fast: if self.stretch { TooFast::Stretch } else { TooFast::Refuse },
            set_zero: self.set_zero,
            action,
            faults: self.fault.clone(),
        }
    }

    fn failed(&self, error: Error) -> CommandError {
        match error {
            Error::NoNetworks => CommandError::input(&self.design, format!("{error}; run `plushwright rig` first")),
            Error::AllOff => {
                CommandError::input(&self.design, format!("{error}; `plushwright network unmute` switches one on"))
            }
            Error::NoSuchFamily { .. } | Error::NoSuchFault(_) | Error::WrongCount { .. } => {
                CommandError::Usage(error.to_string())
            }
            Error::Motion(error) => words::unplanned(&self.design, &error),
            Error::Live(error) => CommandError::Failed(format!("{}: {error}", self.port)),
            Error::Cancelled(_) => CommandError::Cancelled,
        }
    }
}

fn timing(played: &Played) -> Timing<'_> {
    Timing { played, starts: played.late.len(), late_p95_s: played.late_s(0.95), late_worst_s: played.late_s(1.0) }
}

pub(super) fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(time) if time.is_finite() && (0.0..=86_400.0).contains(&time) => Ok(time),
        _ => Err(format!("expected a time in s, at most a day, found `{text}`")),
    }
}
