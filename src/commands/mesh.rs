//! `mesh`: how good the mesh of a design is, as figures and as a picture.

use super::error::CommandError;
use super::output::{say, say_json, write_file};
use super::{document, render};
use crate::design::MeshFigures;
use crate::mesh::quality::HISTOGRAM_STEP_DEG;
use crate::picture::palette::{Palette, Theme};
use crate::picture::{quality, raster};
use clap::Args;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Characters of the longest bar of the histogram.
const BAR: usize = 40;

/// Print the figures of the mesh: angles, sizes, fit to the outline; and draw it
///
/// The picture shows the triangles twice: left by their smallest angle (red 20 degrees and less, yellow 35, green 60), right by
/// their size (blue small, pale large).
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright mesh pig.plush -o pig-mesh.png")]
pub struct MeshCommand {
    /// Design file to read
    pub design: PathBuf,
    /// Picture to write (PNG)
    #[arg(short, long, value_name = "OUT.png")]
    pub output: Option<PathBuf>,
    /// Width and height of the picture in pixels, each 16 to 8192
    #[arg(long, value_name = "WxH", default_value = "1600x900", value_parser = render::parse_size)]
    pub size: (u32, u32),
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

impl MeshCommand {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let design = document::load(&self.design)?;
        let figures = MeshFigures::of(&design);
        if let Some(path) = &self.output {
            let [left, right] = quality::scenes(&design.mesh, Theme::Light);
            let background = Palette::of(Theme::Light).background;
            let bytes =
                raster::png(&left, &right, self.size, background).map_err(|e| CommandError::Failed(e.to_string()))?;
            write_file(path, &bytes, cancel)?;
        }
        if self.json { say_json(out, &figures) } else { print(&figures, out) }
    }
}

fn print(figures: &MeshFigures, out: &mut dyn Write) -> Result<(), CommandError> {
    for (name, value) in figures.rows() {
        say(out, &format!("{name:<24} {value}"))?;
    }
    say(out, "smallest angles")?;
    let histogram = &figures.quality.histogram;
    let most = histogram.iter().copied().max().unwrap_or(0).max(1);
    for (k, &count) in histogram.iter().enumerate() {
        let from = k as f64 * HISTOGRAM_STEP_DEG;
        let bar = "#".repeat((count * BAR).div_ceil(most));
        say(out, format!("{from:>4.0} to {:<3.0} {count:>6} {bar}", from + HISTOGRAM_STEP_DEG).trim_end())?;
    }
    Ok(())
}
