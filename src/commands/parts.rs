//! Where the commands touch rooms that are being built.

use super::error::CommandError;
use crate::design::Design;
use crate::mesh::{BodyPoint, Mesh};
use crate::outline::{Outline, Point};
use std::path::Path;

fn missing(what: &str) -> CommandError {
    CommandError::Failed(format!("{what} is not available"))
}

pub fn mesh(outline: &Outline, _fibers: usize) -> Result<Mesh, String> {
    let _ = outline;
    Ok(Mesh { nodes: outline.outer.clone(), triangles: vec![[0, 1, 2], [0, 2, 3]] })
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
