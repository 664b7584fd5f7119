//! Figures of a design's mesh, for whoever shows them.

use super::Design;
use crate::mesh::quality::{Fit, Quality};
use crate::mesh::{axis, is_mirrored};
use serde::Serialize;

/// How good the mesh of a design is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct MeshFigures {
    pub fibers: usize,
    pub quality: Quality,
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
            quality: Quality::of(mesh),
            fit: Fit::of(mesh, &design.outline),
            symmetric_outline: axis.is_some(),
            symmetric_mesh: axis.is_some_and(|(axis, _)| is_mirrored(mesh, axis)),
        }
    }

    /// Every figure with its name, worded for people.
    pub fn rows(&self) -> [(&'static str, String); 10] {
        let Self { fibers, quality: q, fit, .. } = self;
        let percent = 100.0 * q.below_20_deg as f64 / q.triangles.max(1) as f64;
        let symmetry = match (self.symmetric_outline, self.symmetric_mesh) {
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
}
