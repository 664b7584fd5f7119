//! `key`: a pose on the timeline, as the winch activations that reach it.

use super::error::CommandError;
use super::output::{say, say_json};
use super::{document, words};
use crate::design::Easing;
use crate::files::shown;
use crate::operations::Context;
use crate::operations::key::{self, Error, Keyed, Note, Options};
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
    #[arg(long, value_name = "P")]
    pub pose: String,
    /// Time of the keyframe in s
    #[arg(long, value_name = "S", value_parser = parse_time, allow_hyphen_values = true)]
    pub time: f64,
    /// How the animation moves on to the next keyframe
    #[arg(long, value_enum, default_value_t = Ease::Smooth)]
    pub ease: Ease,
    #[command(flatten)]
    pub target: document::Target,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Format of what `key --json` prints.
const FORMAT: &str = "plushwright-key/1";

/// What `key --json` prints.
#[derive(Serialize)]
struct Summary<'a> {
    design: String,
    pose: &'a str,
    time_s: f64,
    activations_mm: &'a [f64],
}

#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Ease {
    /// At constant speed
    Linear,
    /// Starting and ending at rest
    Smooth,
    /// Stay until the next keyframe
    Hold,
}

impl Key {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let (mut design, edit) = self.target.open(&self.design, cancel)?;
        let known = design.poses.iter().any(|p| p.name == self.pose);
        let options = Options {
            pose: (known || self.pose != "rest").then(|| self.pose.clone()),
            time_s: self.time,
            easing: match self.ease {
                Ease::Linear => Easing::Linear,
                Ease::Smooth => Easing::Smooth,
                Ease::Hold => Easing::Hold,
            },
        };
        let Keyed { keyframe, notes } =
            key::run(&mut design, &options, &Context::new(cancel)).map_err(|error| self.failed(error))?;
        let text = keyframe.activations_mm.iter().map(|a| format!("{a:.2}")).collect::<Vec<_>>().join(" ");
        edit.save(&design, cancel)?;
        if self.json {
            let (design, activations_mm) = (shown(self.target.path(&self.design)), &keyframe.activations_mm[..]);
            say_json(out, FORMAT, &Summary { design, pose: &self.pose, time_s: self.time, activations_mm })?;
            return words::balanced(notes.iter().map(|Note::Unbalanced(unbalanced)| unbalanced));
        }
        say(
            out,
            &format!(
                "{}: {} at {} s, winches at {text} mm",
                shown(self.target.path(&self.design)),
                self.pose,
                self.time
            ),
        )?;
        words::balanced(notes.iter().map(|Note::Unbalanced(unbalanced)| unbalanced))
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
