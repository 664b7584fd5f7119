//! `mesh`: how good the mesh of a design is, as figures and as a picture.

use super::error::CommandError;
use super::output::{Kind, Output, Replace, say, say_json};
use super::picture::PictureFormat;
use super::{document, render};
use crate::design::MeshFigures;
use crate::mesh::quality::HISTOGRAM_STEP_DEG;
use crate::picture::palette::{Palette, Theme};
use crate::picture::{element_quality, raster};
use clap::Args;
use std::io::Write;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

/// Format of what is printed for other programs.
const FORMAT: &str = "plushwright-mesh/1";
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
    /// Picture to write: PNG, or JPEG where it is called *.jpg
    #[arg(short, long, value_name = "OUT.png")]
    pub output: Option<PathBuf>,
    #[command(flatten)]
    pub replace: Replace,
    /// Width and height of the picture in pixels, each 16 to 8192
    #[arg(long, value_name = "WxH", default_value = "1600x900", value_parser = render::parse_size)]
    pub size: (u32, u32),
    /// Print JSON
    #[arg(long)]
    pub json: bool,
}

impl MeshCommand {
    pub fn run(&self, out: &mut dyn Write, cancel: &AtomicBool) -> Result<(), CommandError> {
        let format = self.output.as_deref().map_or(Ok(PictureFormat::Png), PictureFormat::of)?;
        let inputs = || [self.design.clone()];
        let output =
            self.output.as_deref().map(|path| Output::new(path, Kind::Picture, self.replace, inputs())).transpose()?;
        let design = document::load(&self.design)?;
        let figures = MeshFigures::of(&design);
        if let Some(output) = output {
            let [left, right] = element_quality::scenes(&design.mesh, Theme::Light);
            let background = Palette::of(Theme::Light).background;
            let bytes =
                raster::png(&left, &right, self.size, background).map_err(|e| CommandError::Failed(e.to_string()))?;
            output.write(&format.encoded(bytes)?, cancel)?;
        }
        if self.json { say_json(out, FORMAT, &figures) } else { print(&figures, out) }
    }
}

/// Every figure with its name.
fn rows(figures: &MeshFigures) -> [(&'static str, String); 10] {
    let MeshFigures { fibers, quality: q, fit, .. } = figures;
    let percent = 100.0 * q.below_20_deg as f64 / q.triangles.max(1) as f64;
    let symmetry = match (figures.symmetric_outline, figures.symmetric_mesh) {
        (true, true) => "outline and mesh are mirror images of themselves",
        (true, false) => "the outline is its own mirror image, the mesh is not",
        (false, _) => "none",
    };
    let angles = format!("{:.1} degrees; mean over the triangles {:.1}", q.min_angle_deg, q.mean_min_angle_deg);
    let [millimetres, part] = [fit.boundary_mm, 100.0 * fit.boundary_fraction];
    [
        ("fibers", format!("{fibers}")),
        ("nodes, edges, triangles", format!("{}, {}, {}", q.nodes, q.edges, q.triangles)),
        ("smallest angle", angles),
        ("below 20 degrees", format!("{} triangles ({percent:.2} %)", q.below_20_deg)),
        ("edges", format!("{:.2} to {:.2} mm, mean {:.2}", q.min_edge, q.max_edge, q.mean_edge)),
        ("triangles", format!("{:.2} to {:.2} mm^2", q.min_area, q.max_area)),
        ("one triangle across", format!("{} places", q.bridges)),
        ("area", format!("{:+.2} % of the outline's", 100.0 * fit.area_error)),
        ("boundary", format!("within {millimetres:.2} mm of the outline, {part:.2} % of its height")),
        ("symmetry", symmetry.to_owned()),
    ]
}

fn print(figures: &MeshFigures, out: &mut dyn Write) -> Result<(), CommandError> {
    for (name, value) in rows(figures) {
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
