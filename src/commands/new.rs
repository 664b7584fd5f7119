//! `new`: an outline becomes a meshed design.

use super::document;
use super::error::CommandError;
use super::output::{read_file, say};
use crate::defaults;
use crate::design::Design;
use crate::mesh;
use crate::outline::svg;
use clap::Args;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

/// Make a meshed design from an outline (SVG)
#[derive(Debug, Args)]
#[command(after_help = "Example: plushwright new assets/pig.svg -o pig.plush --height 250 --fibers 571")]
pub struct New {
    /// Outline to read: an SVG file; its filled shapes are joined to one silhouette
    pub outline: PathBuf,
    /// Design file to write (*.plush)
    #[arg(short, long, value_name = "DESIGN")]
    pub output: PathBuf,
    /// Height of the plushie in mm [default: the drawing's own size if it has one, else 250]
    #[arg(long, value_name = "MM", value_parser = parse_height, allow_hyphen_values = true)]
    pub height: Option<f64>,
    /// Muscle fibres (mesh edges) to aim for
    #[arg(long, value_name = "N", default_value_t = defaults::FIBERS)]
    pub fibers: usize,
}

impl New {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let bytes = read_file(&self.outline)?;
        let design = design(&bytes, self.height, self.fibers, &stem(&self.output))
            .map_err(|reason| CommandError::input(&self.outline, reason))?;
        document::save(&self.output, &design, cancel)?;
        say(
            out,
            &format!(
                "{}: {} fibers, {} nodes, {} triangles, {:.1} mm long",
                self.output.display(),
                design.fiber_routings().len(),
                design.mesh.nodes.len(),
                design.mesh.triangles.len(),
                design.body_length_mm()
            ),
        )
    }
}

/// A design with default settings around an outline.
pub fn design(svg: &[u8], height_mm: Option<f64>, fibers: usize, name: &str) -> Result<Design, String> {
    let outline = svg::read(svg, height_mm).map_err(|e| e.to_string())?;
    let mesh = mesh::generate(&outline, fibers).map_err(|e| e.to_string())?;
    Ok(Design::new(name, outline, mesh))
}

fn stem(path: &Path) -> String {
    path.file_stem().map_or_else(|| "plushie".to_owned(), |s| s.to_string_lossy().into_owned())
}

fn parse_height(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(height) if height.is_finite() && height > 0.0 => Ok(height),
        _ => Err(format!("expected a height in mm above 0, found `{text}`")),
    }
}
