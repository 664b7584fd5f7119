//! Where the commands touch rooms that are being built.

use super::error::CommandError;
use crate::design::Design;
use crate::mesh::{BodyPoint, Mesh};
use crate::outline::{Outline, Point};
use std::path::Path;
use std::sync::atomic::AtomicBool;

fn missing(what: &str) -> CommandError {
    CommandError::Failed(format!("{what} is not available"))
}

pub fn outline(_bytes: &[u8], _height_mm: Option<f64>) -> Result<Outline, String> {
    Ok(Outline { outer: vec![[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0]], holes: vec![] })
}

pub fn mesh(outline: &Outline, _fibers: usize) -> Result<Mesh, String> {
    let _ = outline;
    Ok(Mesh { nodes: outline.outer.clone(), triangles: vec![[0, 1, 2], [0, 2, 3]] })
}

pub fn read_design(path: &Path) -> Result<Design, CommandError> {
    ron::from_str(&super::output::read_text(path)?).map_err(|e| CommandError::input(path, e))
}

pub fn write_design(path: &Path, design: &Design, cancel: &AtomicBool) -> Result<(), CommandError> {
    let text = ron::ser::to_string_pretty(design, ron::ser::PrettyConfig::default())
        .map_err(|e| CommandError::Failed(e.to_string()))?;
    super::output::write_file(path, text.as_bytes(), cancel)
}

pub fn nearest_body_point(mesh: &Mesh, p: Point) -> Option<BodyPoint> {
    mesh.node_point(mesh.nearest_node(p, &mesh.nodes))
}

pub fn export(_design: &Design, _folder: &Path) -> Result<(), CommandError> {
    Err(missing("export"))
}

pub fn answer(_text: &str) -> Result<String, CommandError> {
    Err(missing("solve"))
}

pub fn network_answer(_text: &str) -> Result<String, CommandError> {
    Err(missing("discover"))
}

pub fn activations_at(design: &Design, _time_s: f64) -> Vec<f64> {
    vec![0.0; design.networks.len()]
}
