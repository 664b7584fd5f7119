//! `export`: the blueprint, a folder that appears whole or not at all.

use super::error::CommandError;
use super::output::{json, say, say_lines};
use super::{document, words};
use crate::motion::TooFast;
use crate::operations::{Context, export};
use clap::Args;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Write the blueprint: patterns, routings, winch tracks, controller programs
///
/// Sheets are SVG in mm with a 100 mm reference line; tracks are in s, mm and encoder counts.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright export pig.plush -o pig-blueprint")]
pub struct Export {
    /// Design file to read; it needs winches (see `plushwright rig`)
    pub design: PathBuf,
    /// Folder to write; an earlier export is replaced, any other folder refused
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// Give the animation more time where its motors are too slow for it; otherwise such an animation is refused
    #[arg(long)]
    pub stretch: bool,
    /// Families of controllers to write programs for, separated by commas; all that can play the motion by default
    #[arg(long, value_name = "FAMILIES", value_delimiter = ',')]
    pub controllers: Vec<String>,
    /// Print the manifest: files with sizes in bytes and SHA-256, and remarks
    #[arg(long)]
    pub json: bool,
}

impl Export {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let design = document::load(&self.design)?;
        let too_fast = if self.stretch { TooFast::Stretch } else { TooFast::Refuse };
        let options = export::Options { too_fast, controllers: self.controllers.clone() };
        let manifest =
            export::run(&design, &self.output, &options, &Context::new(cancel)).map_err(|error| match error {
                export::Error::Export(error) => words::unexported(&self.design, error),
                export::Error::Cancelled(_) => CommandError::Cancelled,
            })?;
        if self.json {
            return say_lines(out, &json(&manifest)?);
        }
        for file in &manifest.files {
            say(out, &format!("{:8} bytes  {}", file.bytes, self.output.join(&file.name).display()))?;
        }
        for remark in &manifest.remarks {
            say(out, &format!("note: {remark}"))?;
        }
        Ok(())
    }
}
