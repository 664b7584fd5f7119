//! Why there is no network.

use super::stages::Stages;

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
