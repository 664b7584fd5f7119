//! Network discovery: from co-active fibres to a winch-tendon network (section 6, Algorithm 2).
//!
//! The idealized plushie's fibres form the *activation graph*, whose edge weights are the fibres' contractions. The
//! heaviest edges are the *seeds*; their heaviest component grows to the *winch tree* by joining others over short
//! paths; a root of that tree becomes the winch and some of the ways to its leaves the tendons.
//!
//! Where the paper is silent:
//! - Seeds are the largest contractions, whatever their sign; equal ones by the smaller node ids. The same order decides
//!   which edge of a cycle goes: the last in it.
//! - The starting component has the largest total contraction once the cycles are broken (equal totals: the smallest
//!   node).
//! - A joining path has the fewest edges, then the largest total weight, then the smallest node list from the tree
//!   outward. It may use any fibre. One round of joining sees only the tree of its start. Cycles that paths close are
//!   broken as well.
//! - Candidate tendons overlap where they share an edge, so a set holds one a branch at the root. A root with fewer
//!   than TENDON_NUM branches is skipped. The variance is that of a population.
//! - Equal scores go to the smallest root, then to the smallest sorted list of leaves.
//!
//! Sums that differ only by rounding count as equal.

mod candidates;
mod graph;
pub mod refine;
mod select;
mod sets;
mod tree;

pub use candidates::candidates;

use crate::defaults;
use graph::{Forest, Graph};
use select::{Selection, Selector};
use serde::{Deserialize, Serialize};
use tree::WinchTree;

/// Parameters of Algorithm 2.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameters {
    pub seed_num: usize,
    pub join_depth: usize,
    pub join_len: usize,
    pub tendon_num: usize,
    /// Between 0 (equal tendons) and 1 (long tendons).
    pub phi: f64,
    /// How the spread of net contractions is measured.
    pub spread: Spread,
}

/// `phi * mean - (1 - phi) * spread`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Spread {
    /// Population variance, as printed: m and m^2 are mixed.
    Variance,
    /// Standard deviation: `phi` means the same at every size.
    StandardDeviation,
}

/// What each stage of discovery found, for fig. 6. Edges are node pairs with the smaller id first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stages {
    /// Contraction of every edge of the activation graph, in the order of the edges given.
    pub weights: Vec<f64>,
    /// The heaviest edges, ascending, those that closed a cycle included.
    pub seeds: Vec<[usize; 2]>,
    /// The starting component, ascending.
    pub start: Vec<[usize; 2]>,
    /// The paths that joined other components, each from the tree outward; of a single node where the component
    /// already touched the tree.
    pub joins: Vec<Vec<usize>>,
    /// The winch tree, ascending.
    pub tree: Vec<[usize; 2]>,
    pub winch: usize,
    /// Node paths from the winch outward, ascending by their last node.
    pub tendons: Vec<Vec<usize>>,
    /// `phi * mean - (1 - phi) * spread` of the tendons' net contractions.
    pub score: f64,
}

/// Why there is no network.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DiscoveryError {
    #[error("the activation graph has no edges")]
    NoEdges,
    #[error("{weights} weights for {edges} edges")]
    WeightCount { edges: usize, weights: usize },
    #[error("edge {edge}: node {node} is out of range, there are {nodes} nodes")]
    NodeOutOfRange { edge: usize, node: usize, nodes: usize },
    #[error("edge {edge}: joins node {node} to itself")]
    SelfLoop { edge: usize, node: usize },
    #[error("edge {edge}: is the same as edge {first}")]
    DuplicateEdge { edge: usize, first: usize },
    #[error("weight {edge}: must be a finite number below 1e100")]
    NonFinite { edge: usize },
    /// `name` as in the paper.
    #[error("{name} must be {expected}")]
    Parameter { name: &'static str, expected: &'static str },
    #[error("no fibre is contracted")]
    Inactive,
    /// Every root of the winch tree has too few branches. Carries the stages up to the tree.
    #[error("no node of the winch tree has {tendon_num} branches: the most is {most}")]
    TooFewBranches { tendon_num: usize, most: usize, stages: Box<Stages> },
}

impl Parameters {
    /// # Errors
    /// [`DiscoveryError::Parameter`] for a count of zero where one is needed, or `phi` outside [0, 1].
    pub fn validate(&self) -> Result<(), DiscoveryError> {
        let refuse = |name, expected| Err(DiscoveryError::Parameter { name, expected });
        match self {
            Self { seed_num: 0, .. } => refuse("SEED_NUM", "at least 1"),
            Self { tendon_num: 0, .. } => refuse("TENDON_NUM", "at least 1"),
            _ if !(0.0..=1.0).contains(&self.phi) => refuse("PHI", "between 0 and 1"),
            _ => Ok(()),
        }
    }
}

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
    fn up_to_tree(graph: &Graph, forest: &Forest, tree: WinchTree, tree_edges: &[usize]) -> Self {
        Self {
            weights: graph.weights.clone(),
            seeds: graph.pairs(&forest.seeds),
            start: graph.pairs(&forest.start.edges),
            joins: tree.joins,
            tree: graph.pairs(tree_edges),
            ..Self::default()
        }
    }

    fn with(self, Selection { winch, tendons, score }: Selection) -> Self {
        Self { winch, tendons, score, ..self }
    }
}

impl Default for Parameters {
    fn default() -> Self {
        Self {
            seed_num: defaults::SEED_NUM,
            join_depth: defaults::JOIN_DEPTH,
            join_len: defaults::JOIN_LEN,
            tendon_num: defaults::TENDON_NUM,
            phi: defaults::PHI,
            spread: Spread::StandardDeviation,
        }
    }
}
