//! `drawing`: the parts that a design's outline is drawn from, as text to be edited.

use super::document;
use super::error::CommandError;
use super::output::{Kind, Output, Replace, say_lines};
use crate::outline::Drawing;
use clap::Args;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Print the drawing of a design's outline: circles, capsules and paths, to be edited and given to `reshape` or `new`
///
/// A design that was not drawn from parts gets a drawing of its outline, with few points.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright drawing pig.plush -o pig.ron")]
pub struct DrawingCommand {
    /// Design file to read
    pub design: PathBuf,
    /// File to write [default: standard output]
    #[arg(short, long, value_name = "DRAWING")]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    pub replace: Replace,
}

impl DrawingCommand {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let inputs = || [self.design.clone()];
        let output =
            self.output.as_deref().map(|path| Output::new(path, Kind::Drawing, self.replace, inputs())).transpose()?;
        let design = document::load(&self.design)?;
        let drawing = design.drawing.unwrap_or_else(|| Drawing::of(&design.outline));
        let text = drawing.to_text().map_err(|e| CommandError::Failed(e.to_string()))?;
        match output {
            Some(output) => output.write(text.as_bytes(), cancel),
            None => say_lines(out, text.trim_end()),
        }
    }
}
