//! `key`: a pose on the timeline, as the winch activations that reach it.

use super::error::CommandError;
use super::output::{say, say_json};
use super::{document, words};
use crate::design::{Design, Easing};
use crate::files::shown;
use crate::numbers;
use crate::operations::Context;
use crate::operations::key::{self, Error, Note, Options};
use clap::{Args, ValueEnum};
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Put a pose on the timeline (as winch activations; a keyframe at the same time is replaced)
///
/// Where the plushie does not come to equilibrium in that pose, the best activations found are written all the same, and
/// the exit code is 3.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright key pig.plush --pose wave --time 1.5 --ease smooth")]
pub struct Key {
    /// Design file to read; it needs winches (see `plushwright rig`)
    pub design: PathBuf,
    /// Name of the pose; `rest` means no activation unless the design has a pose of that name
    #[arg(long, value_name = "P", required_unless_present = "again")]
    pub pose: Option<String>,
    /// Time of the keyframe in s
    #[arg(long, value_name = "S", value_parser = parse_time, allow_hyphen_values = true, required_unless_present = "again")]
    pub time: Option<f64>,
    /// Work out the keyframes of all poses again, for the winches and targets that there are by now
    #[arg(long, conflicts_with_all = ["pose", "time", "ease"])]
    pub again: bool,
    /// How the animation moves on to the next keyframe
    #[arg(long, value_enum, default_value_t = Ease::Smooth)]
    pub ease: Ease,
    /// How slowly `--ease slow` begins, as a part of the time, 0.05 to 0.9
    #[arg(long, value_name = "PART", default_value_t = 0.5)]
    pub out: f64,
    /// How slowly `--ease slow` ends
    #[arg(long, value_name = "PART", default_value_t = 0.5)]
    pub into: f64,
    #[command(flatten)]
    pub target: document::Target,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// The name for no activation, unless a pose has it.
const REST: &str = "rest";
/// Format of what `key --json` prints.
const FORMAT: &str = "plushwright-key/1";

/// What `key --json` prints.
#[derive(Serialize)]
struct Summary {
    design: String,
    keyframes: Vec<Keyed>,
}

/// A keyframe as it is told.
#[derive(Serialize)]
struct Keyed {
    pose: String,
    time_s: f64,
    activations_mm: Vec<f64>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Ease {
    /// At constant speed
    Linear,
    /// Starting and ending at rest
    Smooth,
    /// Stay until the next keyframe
    Hold,
    /// Starting and ending at rest, as slowly as --out and --into say
    Slow,
}

impl Ease {
    /// The easing, with these handles where it has any.
    pub fn easing(self, out: f64, into: f64) -> Easing {
        match self {
            Self::Linear => Easing::Linear,
            Self::Smooth => Easing::Smooth,
            Self::Hold => Easing::Hold,
            Self::Slow => Easing::Slow { out, into },
        }
    }
}

impl Key {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let (mut design, edit) = self.target.open(&self.design, cancel)?;
        let keyed = self.keyed(&mut design, &mut Context::new(cancel)).map_err(|error| self.failed(error))?;
        edit.save(&design, cancel)?;
        let told = |key::Keyed { keyframe, .. }: &key::Keyed| Keyed {
            pose: keyframe.pose.clone().unwrap_or_else(|| REST.into()),
            time_s: keyframe.time_s,
            activations_mm: keyframe.activations_mm.clone(),
        };
        let keyframes: Vec<Keyed> = keyed.iter().map(told).collect();
        let path = shown(self.target.path(&self.design));
        if self.json {
            say_json(out, FORMAT, &Summary { design: path, keyframes })?;
        } else if keyframes.is_empty() {
            say(out, &format!("{path}: no keyframe is of a pose"))?;
        } else {
            for Keyed { pose, time_s, activations_mm } in &keyframes {
                let wound = activations_mm.iter().map(|a| numbers::plain(*a, 2)).collect::<Vec<_>>().join(" ");
                say(out, &format!("{path}: {pose} at {time_s} s, winches at {wound} mm"))?;
            }
        }
        words::balanced(keyed.iter().flat_map(|keyed| &keyed.notes).map(|Note::Unbalanced(unbalanced)| unbalanced))
    }

    /// The keyframes, put into the design.
    fn keyed(&self, design: &mut Design, context: &mut Context) -> Result<Vec<key::Keyed>, Error> {
        if self.again {
            if design.networks.is_empty() {
                return Err(Error::NoNetworks);
            }
            let keyed = key::again(design, &key::on_timeline(design), context)?;
            return Ok(keyed.into_iter().map(|keyed| keyed.put(design)).collect::<Result<_, _>>()?);
        }
        let name = self.pose.as_deref().unwrap_or(REST);
        let known = design.poses.iter().any(|p| p.name == name);
        let options = Options {
            pose: (known || name != REST).then(|| name.to_owned()),
            time_s: self.time.unwrap_or_default(),
            easing: self.ease.easing(self.out, self.into),
        };
        Ok(vec![key::run(design, &options, context)?])
    }

    fn failed(&self, error: Error) -> CommandError {
        match error {
            Error::NoNetworks => CommandError::input(&self.design, format!("{error}; run `plushwright rig` first")),
            Error::NoSuchPose(error) => words::no_such_pose(&error),
            Error::Unsolved | Error::Edit(_) => CommandError::Failed(error.to_string()),
            Error::Cancelled(_) => CommandError::Cancelled,
        }
    }
}

fn parse_time(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(time) if time.is_finite() && time >= 0.0 => Ok(time),
        _ => Err(format!("expected a time in s, 0 or later, found `{text}`")),
    }
}
