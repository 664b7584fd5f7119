//! `mesh`: how good the mesh of a design is, as figures and as a picture.

use super::error::CommandError;
use super::output::{say, say_json, write_file};
use super::{document, render};
use crate::mesh::quality::{Fit, HISTOGRAM_STEP_DEG, Quality};
use crate::picture::palette::{Palette, Theme};
use crate::picture::{quality, raster};
use clap::Args;
use serde::Serialize;
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

/// What `--json` prints.
#[derive(Serialize)]
struct Figures {
    fibers: usize,
    quality: Quality,
    fit: Fit,
    /// Whether outline and mesh are their own mirror images.
    symmetric_outline: bool,
    symmetric_mesh: bool,
}

impl MeshCommand {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let design = document::load(&self.design)?;
        let mesh = &design.mesh;
        let axis = crate::mesh::axis(&design.outline);
        let figures = Figures {
            fibers: design.fiber_routings().len(),
            quality: Quality::of(mesh),
            fit: Fit::of(mesh, &design.outline),
            symmetric_outline: axis.is_some(),
            symmetric_mesh: axis.is_some_and(|(axis, _)| crate::mesh::is_mirrored(mesh, axis)),
        };
        if let Some(path) = &self.output {
            let [left, right] = quality::scenes(mesh, Theme::Light);
            let background = Palette::of(Theme::Light).background;
            let bytes =
                raster::png(&left, &right, self.size, background).map_err(|e| CommandError::Failed(e.to_string()))?;
            write_file(path, &bytes, cancel)?;
        }
        if self.json { say_json(out, &figures) } else { print(&figures, out) }
    }
}

fn print(figures: &Figures, out: &mut dyn Write) -> Result<(), CommandError> {
    let Figures { fibers, quality: q, fit, .. } = figures;
    let percent = |part: usize| 100.0 * part as f64 / q.triangles.max(1) as f64;
    let symmetry = match (figures.symmetric_outline, figures.symmetric_mesh) {
        (true, true) => "outline and mesh are mirror images of themselves",
        (true, false) => "the outline is its own mirror image, the mesh is not",
        (false, _) => "none",
    };
    for (name, value) in [
        ("fibers", format!("{fibers}")),
        ("nodes, edges, triangles", format!("{}, {}, {}", q.nodes, q.edges, q.triangles)),
        (
            "smallest angle",
            format!("{:.1} degrees; mean over the triangles {:.1}", q.min_angle_deg, q.mean_min_angle_deg),
        ),
        ("below 20 degrees", format!("{} triangles ({:.2} %)", q.below_20_deg, percent(q.below_20_deg))),
        ("edges", format!("{:.2} to {:.2} mm, mean {:.2}", q.min_edge, q.max_edge, q.mean_edge)),
        ("triangles", format!("{:.2} to {:.2} mm^2", q.min_area, q.max_area)),
        ("one triangle across", format!("{} places", q.bridges)),
        ("area", format!("{:+.2} % of the outline's", 100.0 * fit.area_error)),
        (
            "boundary",
            format!(
                "within {:.2} mm of the outline, {:.2} % of its height",
                fit.boundary_mm,
                100.0 * fit.boundary_fraction
            ),
        ),
        ("symmetry", symmetry.to_owned()),
    ] {
        say(out, &format!("{name:<24} {value}"))?;
    }
    say(out, "smallest angles")?;
    let most = q.histogram.iter().copied().max().unwrap_or(0).max(1);
    for (k, &count) in q.histogram.iter().enumerate() {
        let from = k as f64 * HISTOGRAM_STEP_DEG;
        let bar = "#".repeat((count * BAR).div_ceil(most));
        say(out, format!("{from:>4.0} to {:<3.0} {count:>6} {bar}", from + HISTOGRAM_STEP_DEG).trim_end())?;
    }
    Ok(())
}
