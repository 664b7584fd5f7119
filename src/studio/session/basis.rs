//! Figures that took long, and whether they are still true.

use crate::design::{Design, Target};
use crate::engine::BodySpec;
use std::sync::Arc;

/// The design that figures are of.
pub struct Basis {
    design: Arc<Design>,
    /// The newest design that was compared with it, and whether the figures hold for that.
    compared: (Arc<Design>, bool),
}

impl Basis {
    pub fn new(design: &Arc<Design>) -> Self {
        Self { design: design.clone(), compared: (design.clone(), true) }
    }

    /// Whether the figures hold for a design: it has the same body, poses, networks and rules of sewing.
    pub fn holds(&mut self, design: &Arc<Design>) -> bool {
        if !Arc::ptr_eq(&self.compared.0, design) {
            self.compared = (design.clone(), same_figures(&self.design, design));
        }
        self.compared.1
    }
}

fn same_figures(a: &Design, b: &Design) -> bool {
    let targets = |design: &Design| -> Vec<(String, Vec<Target>)> {
        design.poses.iter().map(|pose| (pose.name.clone(), pose.targets.clone())).collect()
    };
    BodySpec::of(a) == BodySpec::of(b)
        && a.outline == b.outline
        && a.sewing == b.sewing
        && a.fabrication.turning_gap_mm == b.fabrication.turning_gap_mm
        && targets(a) == targets(b)
}
