//! `reshape`: another silhouette for a design that is already posed and rigged.

use super::document;
use super::error::CommandError;
use super::new::Reading;
use super::output::{refuse_input, say, say_json};
use super::remesh;
use super::words::{self, CleanUp};
use crate::design::edit::EditError;
use crate::design::history::History;
use crate::design::remesh::Report;
use crate::design::reshape::{Body, keep_tracks, reshape};
use crate::mesh::Request;
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
    /// Muscle fibres (mesh edges) to aim for [default: as many as the design has]
    #[arg(long, value_name = "N")]
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

/// What `reshape --json` prints.
#[derive(Serialize)]
struct Summary<'a> {
    clean_up: CleanUp<'a>,
    #[serde(flatten)]
    report: &'a Report,
}

impl Reshape {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        refuse_input(&self.target.output, &self.outline)?;
        let (design, edit) = self.target.open(&self.design, cancel)?;
        let mut history = History::new(design);
        let import = self.reading.import();
        let refuse = |reason: String| CommandError::input(&self.outline, reason);
        let mut imported =
            outline::import_file(&self.outline, &import).map_err(|e| refuse(words::outline_error(&e)))?;
        // Where a height is asked for the drawing's own coordinates do not count.
        let own_place = imported.drawing.is_some() && import.height_mm.is_none();
        let corner = if own_place { imported.drawn_box[0] } else { [0.0; 2] };
        keep_tracks(history.current(), &mut imported);
        let changes = imported.changes.clone();
        let fibers = self.fibers.unwrap_or_else(|| history.current().fiber_routings().len());
        let body = Body::new(imported, &Request::fibers(fibers), usize::from(self.finer), corner);
        let body = body.map_err(|e| refuse(e.to_string()))?;
        let report = history
            .edit("Reshape", |design| Ok::<_, EditError>(reshape(design, body)))
            .map_err(|e| CommandError::input(&self.design, e))?;
        edit.save(history.current(), cancel)?;
        if self.json {
            return say_json(out, &Summary { clean_up: CleanUp::of(&changes), report: &report });
        }
        remesh::print(&self.target.output, &report, out)?;
        changes.lines(words::note).into_iter().try_for_each(|line| say(out, &format!("note: {line}")))
    }
}
