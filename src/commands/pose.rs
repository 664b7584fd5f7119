//! `pose`: pins of the design and targets of a named pose.

use super::document;
use super::error::CommandError;
use super::output::say;
use super::place::{parse_move, parse_point};
use crate::files::shown;
use crate::operations::Context;
use crate::operations::pose::{self, Error, Move, Options};
use crate::outline::Point;
use clap::Args;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Add pins to a design and targets to one of its poses
///
/// Places are in mm, y up, origin at the lower left corner of the rest silhouette's box, and mean points of the body at rest.
/// A pose that does not exist is created. A target or pin on a point that has one replaces it.
#[derive(Debug, Args)]
#[command(
    after_help = "Example: plushwright pose pig.plush --name wave --pin 60,5 --pin 180,5 --target 200,230=150,240 -o pig.plush"
)]
pub struct Pose {
    /// Design file to read
    pub design: PathBuf,
    /// Name of the pose
    #[arg(long, value_name = "P")]
    pub name: String,
    /// Hold this point of the body where it is at rest (mm; repeatable)
    #[arg(long = "pin", value_name = "X,Y", value_parser = parse_point, allow_hyphen_values = true)]
    pub pins: Vec<Point>,
    /// Pull the point X,Y of the body at rest to X2,Y2 (mm; repeatable)
    #[arg(long = "target", value_name = "X,Y=X2,Y2", value_parser = parse_move, allow_hyphen_values = true)]
    pub targets: Vec<Move>,
    #[command(flatten)]
    pub target: document::Target,
}

impl Pose {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let (mut design, edit) = self.target.open(&self.design, cancel)?;
        let options = Options { name: self.name.clone(), pins: self.pins.clone(), targets: self.targets.clone() };
        pose::run(&mut design, &options, &Context::new(cancel)).map_err(failed)?;
        edit.save(&design, cancel)?;
        let targets = design.poses.iter().find(|p| p.name == self.name).map_or(0, |p| p.targets.len());
        say(
            out,
            &format!(
                "{}: pose {} has {targets} targets; {} pins, {} poses",
                shown(&self.target.output),
                self.name,
                design.pins.len(),
                design.poses.len()
            ),
        )
    }
}

pub fn failed(error: Error) -> CommandError {
    match error {
        Error::Edit(_) => CommandError::Usage(error.to_string()),
        Error::Cancelled(_) => CommandError::Cancelled,
    }
}
