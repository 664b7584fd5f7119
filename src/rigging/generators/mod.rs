//! Where candidate networks come from: one way a file, and the table of them.

mod algorithm2;
mod linear;
mod response;

use super::activation::ActivationGraph;
use super::candidate::{Baseline, Candidate};
use super::generator::{Generator, Given};
use crate::design::{Design, Target};
use crate::discovery::{self, Parameters};
use std::sync::atomic::AtomicBool;

/// All ways, in the order in which their candidates are tried out. A new one is a file and a line here.
const GENERATORS: [&dyn Generator; 2] = [&response::Response, &algorithm2::Algorithm2];

/// Distinct candidates of all generators for the pose of `targets`, from the fibres' activations of the idealized plushie in it.
/// Empty where the body cannot be posed or no fibre is contracted.
pub fn candidates(
    design: &Design,
    targets: &[Target],
    poses: &[Baseline],
    base: &Parameters,
    tendon_nums: &[usize],
    cancel: &AtomicBool,
) -> Vec<Candidate> {
    let Some(graph) = ActivationGraph::of_pose(design, targets, cancel) else { return Vec::new() };
    let nodes = design.mesh.nodes.len();
    let Ok(found) = discovery::candidates(nodes, &graph.edges, &graph.weights, base, tendon_nums) else {
        return Vec::new();
    };
    if found.is_empty() {
        return Vec::new();
    }
    let given = Given { design, graph: &graph, found: &found, poses, tendon_nums };
    let mut out: Vec<Candidate> = Vec::new();
    for candidate in GENERATORS.iter().flat_map(|generator| generator.generate(&given)) {
        if !out.iter().any(|c| c.tendons == candidate.tendons) {
            out.push(candidate);
        }
    }
    out
}
