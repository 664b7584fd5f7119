//! Winch and tendons chosen by the body's response instead of by net contraction.
//!
//! Algorithm 2 scores tendons by the contraction of the fibres they replace. The body can be asked directly, linearised (see
//! `linear`): on the winch trees of Algorithm 2, and on wider ones that reach every active limb.

use super::linear::select;
use crate::discovery::{self, Parameters, Stages};
use crate::rigging::Candidate;
use crate::rigging::generator::{Generator, Given};

/// SEED_NUM of the wide winch trees, and their JOIN_DEPTH and JOIN_LEN.
const WIDE_SEEDS: [usize; 4] = [16, 32, 64, 100];
const WIDE_JOIN: usize = 12;
/// Trees that are looked at, tendon sets kept of each, and sets kept in all.
const TREES: usize = 8;
const ROOTS: usize = 12;
const KEPT: usize = 40;

pub(super) struct Response;

impl Generator for Response {
    fn generate(&self, given: &Given) -> Vec<Candidate> {
        let trees = trees(given);
        let mut scored: Vec<(f64, Candidate)> = Vec::new();
        for (parameters, stages) in trees.into_iter().take(TREES) {
            for &tendon_num in given.tendon_nums {
                let sets = select(given.design, &stages.tree, given.poses, tendon_num);
                for (value, tendons) in sets.into_iter().take(ROOTS) {
                    if scored.iter().any(|(_, c)| c.tendons == tendons) {
                        continue;
                    }
                    let parameters = Parameters { tendon_num, ..parameters.clone() };
                    let winch = tendons.first().and_then(|t| t.first()).copied().unwrap_or(stages.winch);
                    let stages = Stages { winch, tendons: tendons.clone(), ..stages.clone() };
                    scored.push((value, Candidate { tendons, parameters, stages }));
                }
            }
        }
        scored.sort_by(|a, b| a.0.total_cmp(&b.0));
        scored.into_iter().take(KEPT).map(|(_, c)| c).collect()
    }
}

/// Distinct winch trees: the wide ones first.
fn trees(given: &Given) -> Vec<(Parameters, Stages)> {
    let mut trees: Vec<(Parameters, Stages)> = Vec::new();
    let mut add = |parameters: Parameters, stages: Stages| {
        if !stages.tree.is_empty() && !trees.iter().any(|(_, s)| s.tree == stages.tree) {
            trees.push((parameters, stages));
        }
    };
    let Some((base, _)) = given.found.first() else { return Vec::new() };
    let (nodes, graph) = (given.design.mesh.nodes.len(), given.graph);
    for seed_num in WIDE_SEEDS {
        let wide = Parameters { seed_num, join_depth: WIDE_JOIN, join_len: WIDE_JOIN, tendon_num: 1, ..base.clone() };
        if let Ok(stages) = discovery::propose(nodes, &graph.edges, &graph.weights, &wide) {
            add(wide, stages);
        }
    }
    for (parameters, stages) in given.found {
        add(parameters.clone(), stages.clone());
    }
    trees
}
