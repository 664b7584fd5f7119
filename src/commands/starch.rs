//! `starch`: parts of a body that are stiffer or softer than the rest.

use super::document;
use super::error::CommandError;
use super::output::{say, say_json};
use super::place::parse_point;
use crate::files::shown;
use crate::operations::Context;
use crate::operations::starch::{self, Error, Options};
use crate::outline::Point;
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Make a patch of the body stiffer or softer than the rest
///
/// A factor of 1 takes the starch away there. What is starched holds its shape: stuff it harder, or sew felt behind it.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright starch pig.plush --at 120,80 --radius 25 --factor 6")]
pub struct Starch {
    /// Design file to read
    pub design: PathBuf,
    /// A place of the body at rest, mm
    #[arg(long, value_name = "X,Y", value_parser = parse_point, allow_hyphen_values = true, required_unless_present = "clear")]
    pub at: Option<Point>,
    /// Radius of the patch, mm
    #[arg(long, value_name = "MM", default_value_t = 20.0)]
    pub radius: f64,
    /// Stiffness of the patch as a multiple of the material's, 1e-4 to 1e4
    #[arg(long, value_name = "F", default_value_t = 4.0)]
    pub factor: f64,
    /// Take all starch of the body away first
    #[arg(long)]
    pub clear: bool,
    #[command(flatten)]
    pub target: document::Target,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

/// Format of what `starch --json` prints.
const FORMAT: &str = "plushwright-starch/1";

/// What `starch --json` prints.
#[derive(Serialize)]
struct Summary {
    design: String,
    /// Triangles whose stiffness is not the material's.
    triangles: usize,
}

impl Starch {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let (mut design, edit) = self.target.open(&self.design, cancel)?;
        let triangles = match self.at {
            Some(at) => {
                let options = Options { at, radius_mm: self.radius, factor: self.factor, clear: self.clear };
                starch::run(&mut design, &options, &Context::new(cancel)).map_err(failed)?
            }
            None => starch::clear(&mut design).map(|()| 0).map_err(|error| failed(error.into()))?,
        };
        edit.save(&design, cancel)?;
        let design = shown(self.target.path(&self.design));
        if self.json {
            return say_json(out, FORMAT, &Summary { design, triangles });
        }
        say(out, &format!("{design}: {triangles} triangles are starched"))
    }
}

fn failed(error: Error) -> CommandError {
    match error {
        Error::Edit(_) | Error::NoRadius => CommandError::Usage(error.to_string()),
        Error::Cancelled(_) => CommandError::Cancelled,
    }
}
