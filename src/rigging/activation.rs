//! The activation graph of a pose: what Algorithm 2 works on.

use crate::design::{Design, Target};
use crate::engine::{Setpoint, Shape, solve_once};
use std::sync::atomic::AtomicBool;

/// The mesh edges of a body and what their fibres do in one pose.
pub struct ActivationGraph {
    pub edges: Vec<[usize; 2]>,
    /// Contraction of each edge, mm.
    pub weights: Vec<f64>,
}

impl ActivationGraph {
    /// Poses the idealized plushie with all effort, its present winches held where they serve best; `None` where it cannot be.
    pub fn of_pose(design: &Design, targets: &[Target], cancel: &AtomicBool) -> Option<Self> {
        let setpoint = Setpoint::Targets(targets.to_vec());
        let shape = solve_once(design, setpoint, [true, false], cancel).idealized?;
        Some(Self::of(design, &shape))
    }

    /// Reads the contractions of an idealized shape. A fibre with via points shares its contraction among its segments by length.
    pub fn of(design: &Design, shape: &Shape) -> Self {
        let edges = design.mesh.edges();
        let mut weights = vec![0.0; edges.len()];
        let length = |a: usize, b: usize| edge_length(design, [a, b]);
        for (routing, contraction) in design.fiber_routings().iter().zip(&shape.fiber_contractions_mm) {
            let total: f64 = routing.windows(2).map(|s| length(s[0], s[1])).sum();
            for s in routing.windows(2) {
                if let Ok(k) = edges.binary_search(&[s[0].min(s[1]), s[0].max(s[1])]) {
                    weights[k] += contraction * length(s[0], s[1]) / total;
                }
            }
        }
        Self { edges, weights }
    }

    /// Mean rest length of the edges, mm.
    pub fn mean_length_mm(&self, design: &Design) -> f64 {
        let sum: f64 = self.edges.iter().map(|&edge| edge_length(design, edge)).sum();
        sum / self.edges.len().max(1) as f64
    }
}

fn edge_length(design: &Design, [a, b]: [usize; 2]) -> f64 {
    let (p, q) = (design.mesh.nodes[a], design.mesh.nodes[b]);
    (q[0] - p[0]).hypot(q[1] - p[1])
}
