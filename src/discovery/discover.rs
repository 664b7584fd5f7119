//! Algorithm 2, step by step.

use super::error::DiscoveryError;
use super::graph::{Forest, Graph};
use super::parameters::Parameters;
use super::select::{Selection, Selector};
use super::stages::Stages;
use super::tree::WinchTree;

/// Algorithm 2, exactly. Edges are undirected, in any order; `weights` are their contractions.
///
/// # Errors
/// Invalid input, or [`DiscoveryError::TooFewBranches`] where no root can hold `tendon_num` tendons.
pub fn discover(
    nodes: usize,
    edges: &[[usize; 2]],
    weights: &[f64],
    parameters: &Parameters,
) -> Result<Stages, DiscoveryError> {
    let (stages, selector) = winch_tree(nodes, edges, weights, parameters)?;
    let tendon_num = parameters.tendon_num;
    match selector.best(tendon_num, parameters.phi, parameters.spread) {
        Some(selection) => Ok(stages.with(selection)),
        None => {
            let most = selector.most_branches();
            Err(DiscoveryError::TooFewBranches { tendon_num, most, stages: Box::new(stages) })
        }
    }
}

/// Algorithm 2 for the interactive tool: proposes fewer tendons where the winch tree has too few branches, and takes
/// only contracted fibres as seeds.
///
/// # Errors
/// Invalid input, or [`DiscoveryError::Inactive`] where no fibre is contracted.
pub fn propose(
    nodes: usize,
    edges: &[[usize; 2]],
    weights: &[f64],
    parameters: &Parameters,
) -> Result<Stages, DiscoveryError> {
    let active = weights.iter().filter(|&&weight| weight > 0.0).count();
    let seed_num = parameters.seed_num.min(active);
    if active == 0 && parameters.seed_num > 0 {
        // Invalid input is reported before a lack of contraction.
        Graph::new(nodes, edges, weights)?;
        return Err(DiscoveryError::Inactive);
    }
    let (stages, selector) = winch_tree(nodes, edges, weights, &Parameters { seed_num, ..parameters.clone() })?;
    let most = parameters.tendon_num.min(selector.most_branches());
    let selection = selector.best(most, parameters.phi, parameters.spread).ok_or(DiscoveryError::Inactive)?;
    Ok(stages.with(selection))
}

/// Steps 0 and 1, and the candidate tendons.
fn winch_tree(
    nodes: usize,
    edges: &[[usize; 2]],
    weights: &[f64],
    parameters: &Parameters,
) -> Result<(Stages, Selector), DiscoveryError> {
    let graph = Graph::new(nodes, edges, weights)?;
    parameters.validate()?;
    let forest = Forest::new(&graph, &graph.ranking(), parameters.seed_num);
    let mut tree = WinchTree::new(&graph, &forest);
    tree.grow(&graph, parameters.join_depth, parameters.join_len);
    let tree_edges = tree.edges(&graph);
    let selector = Selector::new(&graph, &tree_edges);
    Ok((Stages::up_to_tree(&graph, &forest, tree, &tree_edges), selector))
}

impl Stages {
    pub(super) fn up_to_tree(graph: &Graph, forest: &Forest, tree: WinchTree, tree_edges: &[usize]) -> Self {
        Self {
            weights: graph.weights.clone(),
            seeds: graph.pairs(&forest.seeds),
            start: graph.pairs(&forest.start.edges),
            joins: tree.joins,
            tree: graph.pairs(tree_edges),
            ..Self::default()
        }
    }

    pub(super) fn with(self, Selection { winch, tendons, score }: Selection) -> Self {
        Self { winch, tendons, score, ..self }
    }
}
