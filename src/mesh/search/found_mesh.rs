//! A mesh that was found: whether it is good enough, and which of several is best.

use crate::mesh::Mesh;
use crate::mesh::quality::{Fit, MeshQuality};
use crate::outline::Outline;
use std::cell::OnceCell;

/// A mesh without bridges and with no angle below this is taken at once, degrees.
const FINE_DEG: f64 = 30.5;
/// How near, as a part of the height, the boundary must be to an outline that is to be followed closely.
const CLOSE: f64 = 0.005;
/// How near its area must be, as a part.
const CLOSE_AREA: f64 = 0.01;

pub(super) struct FoundMesh {
    pub mesh: Mesh,
    pub quality: MeshQuality,
    /// Whether it follows the outline closely, once somebody asked.
    follows: OnceCell<bool>,
}

impl FoundMesh {
    pub fn new(mesh: Mesh, quality: MeshQuality) -> Self {
        Self { mesh, quality, follows: OnceCell::new() }
    }

    /// Whether every angle below 20 degrees is one of the outline's own.
    pub fn is_good(&self) -> bool {
        self.quality.below_20_deg == self.quality.corners_below_20_deg
    }

    /// Whether no more than one in a thousand triangles is poor for no fault of the outline.
    pub fn is_nearly_good(&self) -> bool {
        (self.quality.below_20_deg - self.quality.corners_below_20_deg) * 1000 <= self.quality.triangles
    }

    /// Whether its boundary and its area are close to those of the outline.
    pub fn follows(&self, outline: &Outline) -> bool {
        *self.follows.get_or_init(|| {
            let fit = Fit::of(&self.mesh, outline);
            fit.boundary_fraction <= CLOSE && fit.area_error.abs() <= CLOSE_AREA
        })
    }

    /// Whether no better one need be sought.
    pub fn is_fine(&self, fibers: usize) -> bool {
        let q = &self.quality;
        q.edges == fibers && q.bridges == 0 && q.min_angle_deg > FINE_DEG
    }
}

/// The candidate with the fewest poor triangles, then of the asked count, and among those the one with the least of what
/// else is unwanted: an inner edge across a limb weighs as much as four degrees that the least angle is below a fine one,
/// as ten degrees above, or as edges that differ by a factor of two more.
pub(super) fn take_best(candidates: &mut Vec<FoundMesh>, fibers: usize) -> Option<FoundMesh> {
    let unwanted = |q: &MeshQuality| {
        let angle = 0.1 * q.min_angle_deg - 0.25 * (FINE_DEG - q.min_angle_deg).max(0.0);
        q.bridges as f64 - angle + 0.5 * q.max_edge / q.min_edge
    };
    let order = |a: &MeshQuality, b: &MeshQuality| {
        let other = |q: &MeshQuality| q.edges != fibers;
        let poor = |q: &MeshQuality| q.below_20_deg - q.corners_below_20_deg;
        poor(a).cmp(&poor(b)).then(other(a).cmp(&other(b))).then(unwanted(a).total_cmp(&unwanted(b)))
    };
    let best = (0..candidates.len()).min_by(|&a, &b| order(&candidates[a].quality, &candidates[b].quality))?;
    Some(candidates.remove(best))
}
