//! What each stage found.

/// The result of each stage of discovery, for fig. 6. Edges are node pairs with the smaller id first.
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
