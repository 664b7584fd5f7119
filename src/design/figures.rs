//! Figures of a design's mesh, for whoever shows them.

use super::Design;
use crate::mesh::quality::{Fit, MeshQuality};
use crate::mesh::{axis, is_mirrored};
use serde::Serialize;

/// How good the mesh of a design is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MeshFigures {
    pub fibers: usize,
    pub quality: MeshQuality,
    pub fit: Fit,
    /// Whether outline and mesh are their own mirror images.
    pub symmetric_outline: bool,
    pub symmetric_mesh: bool,
}

impl MeshFigures {
    pub fn of(design: &Design) -> Self {
        let mesh = &design.mesh;
        let axis = axis(&design.outline);
        Self {
            fibers: design.fiber_routings().len(),
            quality: MeshQuality::of(mesh),
            fit: Fit::of(mesh, &design.outline),
            symmetric_outline: axis.is_some(),
            symmetric_mesh: axis.is_some_and(|(axis, _)| is_mirrored(mesh, axis)),
        }
    }
}
