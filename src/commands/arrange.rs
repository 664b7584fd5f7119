//! `arrange`: targets of a pose, and pins, moved, turned, scaled, weighed or mirrored together.

use super::error::CommandError;
use super::output::{say, say_json};
use super::place::parse_point;
use super::{document, words};
use crate::files::shown;
use crate::operations::Context;
use crate::operations::arrange::{self, Error, Handle, Motion, Options};
use crate::outline::Point;
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Move, turn, scale, weigh, mirror or remove several targets and pins together
///
/// Targets and pins are named by their numbers from 1, in the order of the design. Turning and scaling leave the middle of what is arranged where
/// it is, or the place that is given. A mirror image is about the axis of the body's symmetry.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright arrange pig.plush --pose wave --targets 1,2 --move 10,0 --turn 15")]
pub struct Arrange {
    /// Design file to read
    pub design: PathBuf,
    /// Pose whose targets are meant
    #[arg(long, value_name = "P")]
    pub pose: Option<String>,
    /// Targets by their numbers [default: all of the pose]
    #[arg(long, value_name = "N,N", value_delimiter = ',')]
    pub targets: Vec<usize>,
    /// Pins by their numbers
    #[arg(long, value_name = "N,N", value_delimiter = ',')]
    pub pins: Vec<usize>,
    /// Move by so many mm
    #[arg(long = "move", value_name = "X,Y", value_parser = parse_point, allow_hyphen_values = true)]
    pub by: Option<Point>,
    /// Turn by so many degrees, counter-clockwise
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, default_value_t = 0.0)]
    pub turn: f64,
    /// Scale by this factor
    #[arg(long, value_name = "F", default_value_t = 1.0)]
    pub scale: f64,
    /// Place that turning and scaling leave where it is, mm
    #[arg(long, value_name = "X,Y", value_parser = parse_point, allow_hyphen_values = true)]
    pub about: Option<Point>,
    /// Give the targets this weight
    #[arg(long, value_name = "W")]
    pub weight: Option<f64>,
    /// Add the mirror images
    #[arg(long)]
    pub mirror: bool,
    /// Take them away
    #[arg(long)]
    pub remove: bool,
    #[command(flatten)]
    pub target: document::Target,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Format of what `arrange --json` prints.
const FORMAT: &str = "plushwright-arrange/1";

/// What `arrange --json` prints.
#[derive(Serialize)]
struct Summary {
    design: String,
    arranged: usize,
}

impl Arrange {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let options = self.options()?;
        let (mut design, edit) = self.target.open(&self.design, cancel)?;
        let arranged = arrange::run(&mut design, &options, &Context::new(cancel)).map_err(failed)?;
        edit.save(&design, cancel)?;
        let design = shown(self.target.path(&self.design));
        if self.json {
            return say_json(out, FORMAT, &Summary { design, arranged });
        }
        say(out, &format!("{design}: {arranged} targets and pins arranged"))
    }

    fn options(&self) -> Result<Options, CommandError> {
        let motion = Motion {
            by: self.by.unwrap_or_default(),
            turn_degrees: finite("--turn", self.turn)?,
            scale: finite("--scale", self.scale)?,
            about: self.about,
        };
        if motion == (Motion { about: self.about, ..Motion::default() })
            && self.weight.is_none()
            && !self.mirror
            && !self.remove
        {
            let ways = "--move, --turn, --scale, --weight, --mirror or --remove";
            return Err(CommandError::Usage(format!("nothing to do: give at least one of {ways}")));
        }
        let number = |what: &str, n: &usize| match n.checked_sub(1) {
            Some(index) => Ok(index),
            None => Err(CommandError::Usage(format!("{what} are numbered from 1, found 0"))),
        };
        let targets = self.targets.iter().map(|n| number("targets", n).map(Handle::Target));
        let pins = self.pins.iter().map(|n| number("pins", n).map(Handle::Pin));
        Ok(Options {
            pose: self.pose.clone(),
            handles: targets.chain(pins).collect::<Result<_, _>>()?,
            motion,
            weight: self.weight,
            mirror: self.mirror,
            remove: self.remove,
        })
    }
}

fn finite(option: &str, value: f64) -> Result<f64, CommandError> {
    let wrong = || CommandError::Usage(format!("{option} takes a finite number, found {value}"));
    value.is_finite().then_some(value).ok_or_else(wrong)
}

fn failed(error: Error) -> CommandError {
    match error {
        Error::NoSuchPose(error) => words::no_such_pose(&error),
        Error::NoPose => CommandError::Usage(format!("{error} with --pose")),
        Error::Nothing => CommandError::Usage(format!("{error}; give --pins, or a --pose with targets")),
        Error::Edit(_) | Error::NoAxis => CommandError::Usage(error.to_string()),
        Error::Cancelled(_) => CommandError::Cancelled,
    }
}
