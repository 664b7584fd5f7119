//! How far a pose misses its targets.

use crate::design::{Design, Target};

/// Rms distance of the targets in body lengths; zero without targets.
pub fn target_error(design: &Design, targets: &[Target], nodes: &[[f64; 2]]) -> f64 {
    if targets.is_empty() {
        return 0.0;
    }
    let sum: f64 = targets
        .iter()
        .map(|t| {
            let p = design.mesh.position(&t.at, nodes);
            (p[0] - t.to[0]).powi(2) + (p[1] - t.to[1]).powi(2)
        })
        .sum();
    (sum / targets.len() as f64).sqrt() / design.body_length_mm()
}
