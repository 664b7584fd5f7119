//! `retime`: keyframes moved, stretched, copied, eased, taken away, or given the time that their motors need.

use super::error::CommandError;
use super::key::Ease;
use super::output::{say, say_json};
use super::{document, words};
use crate::files::shown;
use crate::motion::{Doubt, Why, doubted};
use crate::operations::Context;
use crate::operations::retime::{self, Error, Options};
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Move, stretch, copy, ease or remove keyframes, or give the animation the time that its motors need
///
/// Keyframes are named by their numbers from 1, in the order of their times. What is left that the motors do not play as it is, is told.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright retime pig.plush --keys 2,3 --stretch 1.5 --fit")]
pub struct Retime {
    /// Design file to read
    pub design: PathBuf,
    /// Keyframes by their numbers [default: all]
    #[arg(long, value_name = "N,N", value_delimiter = ',')]
    pub keys: Vec<usize>,
    /// How the animation moves on from them
    #[arg(long, value_enum)]
    pub ease: Option<Ease>,
    /// How slowly `--ease slow` begins, as a part of the time, 0.05 to 0.9
    #[arg(long, value_name = "PART", default_value_t = 0.5)]
    pub out: f64,
    /// How slowly `--ease slow` ends
    #[arg(long, value_name = "PART", default_value_t = 0.5)]
    pub into: f64,
    /// Copy them, the first to this time in s
    #[arg(long, value_name = "S")]
    pub copy_to: Option<f64>,
    /// Multiply the time between them by this factor; the first stays where it is
    #[arg(long, value_name = "F")]
    pub stretch: Option<f64>,
    /// Move them by so many s
    #[arg(long, value_name = "S", allow_hyphen_values = true, default_value_t = 0.0)]
    pub by: f64,
    /// Take them away
    #[arg(long)]
    pub remove: bool,
    /// Give the whole animation the time that its motors need
    #[arg(long)]
    pub fit: bool,
    #[command(flatten)]
    pub target: document::Target,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Format of what `retime --json` prints.
const FORMAT: &str = "plushwright-retime/1";

/// What `retime --json` prints.
#[derive(Serialize)]
struct Summary {
    design: String,
    times_s: Vec<f64>,
    /// What the motors do not play as it is.
    doubts: Vec<String>,
}

impl Retime {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let options = self.options()?;
        let (mut design, edit) = self.target.open(&self.design, cancel)?;
        retime::run(&mut design, &options, &Context::new(cancel)).map_err(|error| self.failed(error))?;
        edit.save(&design, cancel)?;
        let doubts = doubted(&design).unwrap_or_default().iter().map(told).collect();
        let times_s = design.keyframes.iter().map(|k| k.time_s).collect();
        let summary = Summary { design: shown(self.target.path(&self.design)), times_s, doubts };
        if self.json {
            return say_json(out, FORMAT, &summary);
        }
        let times = summary.times_s.iter().map(|t| format!("{t:.3}")).collect::<Vec<_>>().join(" ");
        say(out, &format!("{}: keyframes at {times} s", summary.design))?;
        summary.doubts.iter().try_for_each(|doubt| say(out, &format!("note: {doubt}")))
    }

    fn options(&self) -> Result<Options, CommandError> {
        let nothing = self.ease.is_none() && self.copy_to.is_none() && self.stretch.is_none();
        if nothing && self.by == 0.0 && !self.remove && !self.fit {
            let ways = "--by, --stretch, --copy-to, --ease, --remove or --fit";
            return Err(CommandError::Usage(format!("nothing to do: give at least one of {ways}")));
        }
        let zero = || CommandError::Usage("keyframes are numbered from 1, found 0".into());
        Ok(Options {
            keys: self.keys.iter().map(|n| n.checked_sub(1).ok_or_else(zero)).collect::<Result<_, _>>()?,
            easing: self.ease.map(|ease| ease.easing(self.out, self.into)),
            copy_to_s: self.copy_to,
            stretch: self.stretch,
            by_s: self.by,
            remove: self.remove,
            fit: self.fit,
        })
    }

    fn failed(&self, error: Error) -> CommandError {
        match error {
            Error::NoKeyframes => {
                let way = "`plushwright rig` lays poses on the timeline, `plushwright key` adds one";
                CommandError::input(&self.design, format!("{error}; {way}"))
            }
            Error::NoFactor | Error::Edit(_) => CommandError::Usage(error.to_string()),
            Error::Motion(error) => words::unplanned(&self.design, &error),
            Error::Cancelled(_) => CommandError::Cancelled,
        }
    }
}

/// What the motors do not play as it is.
fn told(doubt: &Doubt) -> String {
    let Doubt { from_s, to_s, why } = doubt;
    let place = format!("{from_s:.3} to {to_s:.3} s");
    match why {
        Why::TooFast { needs_s } => {
            format!("{place} is too fast for the motors, it takes {needs_s:.3} s: --fit gives it that")
        }
        Why::TooFar { winch, reach_mm } => format!("{place}: {winch} can wind {reach_mm:.1} mm and no more"),
        Why::Rounded { winch } => format!("{place}: {winch} is rounded off to keep its limits"),
        Why::Jump { winch } => format!(
            "{place}: {winch} is on its way where the keyframe before is held, as no motor jumps; a copy of that keyframe would end the hold"
        ),
    }
}
