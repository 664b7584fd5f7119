//! `pose`: pins of the design and targets of a named pose.

use super::document;
use super::error::CommandError;
use super::output::{say, say_json};
use super::place::{parse_line, parse_move, parse_point, parse_region};
use crate::design::Design;
use crate::files::shown;
use crate::operations::Context;
use crate::operations::pose::{self, Error, Held, Move, Options};
use crate::outline::Point;
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Add pins to a design and targets to one of its poses
///
/// Places are in mm, y up, origin at the lower left corner of the rest silhouette's box, and mean points of the body at rest.
/// A pose that does not exist is created. A target or pin on a point that has one replaces it.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: plushwright pose pig.plush --name wave --pin 60,5 --pin 180,5 --target 200,230=150,240"
)]
pub struct Pose {
    /// Design file to read
    pub design: PathBuf,
    /// Name of the pose [default with --begin: Wave]
    #[arg(long, value_name = "P", required_unless_present = "begin")]
    pub name: Option<String>,
    /// Hold this point of the body where it is at rest (mm; repeatable)
    #[arg(long = "pin", value_name = "X,Y", value_parser = parse_point, allow_hyphen_values = true)]
    pub pins: Vec<Point>,
    /// Let this point of the body slide along a line at this angle from the x axis (mm and degrees; repeatable)
    #[arg(long = "pin-line", value_name = "X,Y=DEG", value_parser = parse_line, allow_hyphen_values = true)]
    pub lines: Vec<Held>,
    /// Hold all of the body within a radius of this point, so that it cannot turn there (mm; repeatable)
    #[arg(long = "pin-region", value_name = "X,Y=R", value_parser = parse_region, allow_hyphen_values = true)]
    pub regions: Vec<Held>,
    /// Hold the middle of the body, so that it can neither move nor turn
    #[arg(long)]
    pub pin_middle: bool,
    /// Begin with a body that was just made: hold its middle where nothing is pinned, and let a limb wave in this pose
    #[arg(long)]
    pub begin: bool,
    /// Pull the point X,Y of the body at rest to X2,Y2 (mm; repeatable)
    #[arg(long = "target", value_name = "X,Y=X2,Y2", value_parser = parse_move, allow_hyphen_values = true)]
    pub targets: Vec<Move>,
    #[command(flatten)]
    pub target: document::Target,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Format of what `pose --json` prints.
const FORMAT: &str = "plushwright-pose/1";

/// What `pose --json` prints.
#[derive(Serialize)]
struct Summary<'a> {
    design: String,
    pose: &'a str,
    targets: usize,
    pins: usize,
    poses: usize,
}

impl Pose {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let (mut design, edit) = self.target.open(&self.design, cancel)?;
        let options = Options {
            name: self.name.clone().unwrap_or_default(),
            pins: self.pins.clone(),
            held: self.lines.iter().chain(&self.regions).copied().collect(),
            targets: self.targets.clone(),
            middle: self.pin_middle,
            begin: self.begin,
        };
        let pose = pose::run(&mut design, &options, &Context::new(cancel)).map_err(failed)?;
        let name = design.poses[pose].name.as_str();
        let targets = design.poses[pose].targets.len();
        if targets == 0 && self.pins.is_empty() && options.held.is_empty() && !self.pin_middle {
            return Err(without_targets(&design, name));
        }
        edit.save(&design, cancel)?;
        if self.json {
            let (design, pins, poses) = (shown(self.target.path(&self.design)), design.pins.len(), design.poses.len());
            return say_json(out, FORMAT, &Summary { design, pose: name, targets, pins, poses });
        }
        say(
            out,
            &format!(
                "{}: pose {} has {targets} targets; {} pins, {} poses",
                shown(self.target.path(&self.design)),
                name,
                design.pins.len(),
                design.poses.len()
            ),
        )
    }
}

/// A pose that asks nothing of the body: what is missing, and where its points are.
fn without_targets(design: &Design, name: &str) -> CommandError {
    let (low, high) = design.outline.bounding_box();
    CommandError::Usage(format!(
        "the pose `{name}` has no targets: give at least one --target X,Y=X2,Y2, from a point of the body (X {:.0} to {:.0}, Y {:.0} to {:.0} mm)",
        low[0], high[0], low[1], high[1]
    ))
}

pub fn failed(error: Error) -> CommandError {
    match error {
        Error::Edit(_) => CommandError::Usage(error.to_string()),
        Error::Cancelled(_) => CommandError::Cancelled,
    }
}
