//! Networks of Algorithm 2 with its parameters varied, as found and with their paths refined.

use crate::discovery::path_variants;
use crate::rigging::Candidate;
use crate::rigging::generator::{Generator, Given};

/// A dropped via point may lie this far from the straightened tendon, as a part of the mean edge length.
const STRAIGHTENING: f64 = 0.15;

pub(super) struct Algorithm2;

impl Generator for Algorithm2 {
    fn generate(&self, given: &Given) -> Vec<Candidate> {
        let graph = given.graph;
        let straightening = STRAIGHTENING * graph.mean_length_mm(given.design);
        let around = path_variants::Surroundings {
            positions: &given.design.mesh.nodes,
            edges: &graph.edges,
            weights: &graph.weights,
        };
        let mut out = Vec::new();
        for (parameters, stages) in given.found {
            let own = stages.tendons.clone();
            for tendons in std::iter::once(own).chain(path_variants::variants(&stages.tendons, &around, straightening))
            {
                out.push(Candidate { tendons, parameters: parameters.clone(), stages: stages.clone() });
            }
        }
        out
    }
}
