//! `reshape`: another silhouette for a design that is already posed and rigged.

use super::error::CommandError;
use super::output::{refuse_input, say, say_json};
use super::reading::Reading;
use super::words::CleanUp;
use super::{document, meant, remesh, words};
use crate::operations::reshape::{self, Options, Report, Reshaped, Source};
use crate::operations::{Context, FiberCount};
use crate::outline;
use clap::Args;
use serde::Serialize;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Give a design another silhouette; keep its pins, poses, networks and keyframes
///
/// A drawing (RON, see `drawing`) is in the design's own coordinates. Any other outline is laid with its lower left corner on
/// that of the old one. Everything is carried over by where it lies at rest, and how far each part moved is reported.
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright reshape pig.plush pig.ron -o pig2.plush")]
pub struct Reshape {
    /// Design file to read
    pub design: PathBuf,
    /// Outline to read: any that `new` reads
    pub outline: PathBuf,
    #[command(flatten)]
    pub target: document::Target,
    /// Muscle fibres (mesh edges) to aim for [default: as many as the design has, or the fewest that the outline allows if that is more]
    #[arg(long, value_name = "N", alias = "fibres")]
    pub fibers: Option<usize>,
    /// Simulate on a mesh this many times finer than the fibres' own
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..=16))]
    pub finer: u16,
    #[command(flatten)]
    pub reading: Reading,
    /// Print the report as JSON
    #[arg(long)]
    pub json: bool,
}

/// Format of what `reshape --json` prints.
const FORMAT: &str = "plushwright-reshape/1";

/// What `reshape --json` prints.
#[derive(Serialize)]
struct Summary<'a> {
    clean_up: CleanUp<'a>,
    #[serde(flatten)]
    report: &'a Report,
}

impl Reshape {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        refuse_input(self.target.path(&self.design), &self.outline)?;
        if let Some(advice) = meant::instead_of_outline(&self.outline) {
            return Err(CommandError::input(&self.outline, advice));
        }
        let (mut design, edit) = self.target.open(&self.design, cancel)?;
        let options = Options {
            import: self.reading.import(),
            fibers: FiberCount::asked(self.fibers),
            finer: usize::from(self.finer),
        };
        let failed = |error| words::unshaped(&self.design, &self.outline, error);
        let file = outline::read_file(&self.outline).map_err(|error| failed(error.into()))?;
        let (Reshaped { changes, notes, .. }, report) =
            reshape::run(&mut design, Source::File(&file), &options, &Context::new(cancel)).map_err(failed)?;
        edit.save(&design, cancel)?;
        let clean_up = CleanUp::new(&changes, &notes);
        if self.json {
            return say_json(out, FORMAT, &Summary { clean_up, report: &report });
        }
        remesh::print(self.target.path(&self.design), &report, out)?;
        clean_up.lines().try_for_each(|line| say(out, &format!("note: {line}")))
    }
}
