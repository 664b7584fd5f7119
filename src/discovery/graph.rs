//! The activation graph, its seeds and their components (step 0 of Algorithm 2).

use super::DiscoveryError;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// Sums of contractions that differ by less than this times the sum of the magnitudes involved count as equal, so that
/// a tie is decided by the documented order and not by the order of summation. Dimensionless; 64 units in the last
/// place cover sums of some hundred terms and stay far below the figures of any input.
pub(super) const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Contractions from here on are refused: the squares of their sums could overflow. Any unit of length.
const LARGEST: f64 = 1e100;

/// An edge-weighted undirected graph `G`: one vertex a mesh node, one edge a muscle fibre, `w(e)` its contraction.
pub(super) struct Graph {
    /// Node pairs with the smaller id first, in the order given.
    pub edges: Vec<[usize; 2]>,
    pub weights: Vec<f64>,
    /// Per node: neighbouring node and edge, by ascending neighbour.
    pub neighbors: Vec<Vec<(usize, usize)>>,
}

impl Graph {
    /// # Errors
    /// Everything that [`DiscoveryError`] says about edges and weights.
    pub fn new(nodes: usize, edges: &[[usize; 2]], weights: &[f64]) -> Result<Self, DiscoveryError> {
        if edges.is_empty() {
            return Err(DiscoveryError::NoEdges);
        }
        if edges.len() != weights.len() {
            return Err(DiscoveryError::WeightCount { edges: edges.len(), weights: weights.len() });
        }
        let mut seen = BTreeMap::new();
        let mut neighbors = vec![Vec::new(); nodes];
        let mut normalized = Vec::with_capacity(edges.len());
        for (edge, &[a, b]) in edges.iter().enumerate() {
            if let Some(&node) = [a, b].iter().find(|&&node| node >= nodes) {
                return Err(DiscoveryError::NodeOutOfRange { edge, node, nodes });
            }
            if a == b {
                return Err(DiscoveryError::SelfLoop { edge, node: a });
            }
            let pair = [a.min(b), a.max(b)];
            if let Some(first) = seen.insert(pair, edge) {
                return Err(DiscoveryError::DuplicateEdge { edge, first });
            }
            normalized.push(pair);
            neighbors[a].push((b, edge));
            neighbors[b].push((a, edge));
        }
        if let Some(edge) = weights.iter().position(|weight| weight.is_nan() || weight.abs() >= LARGEST) {
            return Err(DiscoveryError::NonFinite { edge });
        }
        neighbors.iter_mut().for_each(|list| list.sort_unstable());
        Ok(Self { edges: normalized, weights: weights.to_vec(), neighbors })
    }

    /// Heaviest first, equal weights by smaller node ids. A strict order, so that whatever is built on it is unique.
    fn by_weight(&self, a: usize, b: usize) -> Ordering {
        let weights = self.weights[b].partial_cmp(&self.weights[a]).unwrap_or(Ordering::Equal);
        weights.then_with(|| self.edges[a].cmp(&self.edges[b]))
    }

    /// All edges, heaviest first.
    pub fn ranking(&self) -> Vec<usize> {
        let mut ranking: Vec<usize> = (0..self.edges.len()).collect();
        ranking.sort_unstable_by(|&a, &b| self.by_weight(a, b));
        ranking
    }

    /// Deletes the lightest edge of every cycle until none is left. What remains is the maximum spanning forest, here
    /// built the other way round: the heaviest edges first, leaving out each that would close a cycle.
    pub fn break_cycles(&self, mut edges: Vec<usize>) -> Vec<usize> {
        edges.sort_unstable_by(|&a, &b| self.by_weight(a, b));
        edges.dedup();
        let mut sets = DisjointSets::new(self.neighbors.len());
        edges.retain(|&edge| sets.union(self.edges[edge]));
        edges
    }

    /// The connected components of a set of edges, each with ascending nodes, ordered by their smallest node.
    pub fn components(&self, edges: &[usize]) -> Vec<Component> {
        let mut sets = DisjointSets::new(self.neighbors.len());
        for &edge in edges {
            sets.union(self.edges[edge]);
        }
        // The representative is the smallest node, so that the map's order is the documented one.
        let mut components: BTreeMap<usize, Component> = BTreeMap::new();
        for &edge in edges {
            let component = components.entry(sets.find(self.edges[edge][0])).or_default();
            component.edges.push(edge);
            component.nodes.extend(self.edges[edge]);
        }
        let mut components: Vec<Component> = components.into_values().collect();
        for component in &mut components {
            component.nodes.sort_unstable();
            component.nodes.dedup();
        }
        components
    }

    /// Node pairs of a set of edges, ascending.
    pub fn pairs(&self, edges: &[usize]) -> Vec<[usize; 2]> {
        let mut pairs: Vec<[usize; 2]> = edges.iter().map(|&edge| self.edges[edge]).collect();
        pairs.sort_unstable();
        pairs
    }

    /// Sum of contractions, and the sum of their magnitudes by which its rounding is judged.
    pub fn total(&self, edges: &[usize]) -> (f64, f64) {
        edges.iter().map(|&edge| self.weights[edge]).fold((0.0, 0.0), |(sum, size), w| (sum + w, size + w.abs()))
    }
}

/// A tree of the forest of seeds.
#[derive(Clone, Debug, Default)]
pub(super) struct Component {
    pub nodes: Vec<usize>,
    pub edges: Vec<usize>,
}

/// The seeds with their cycles broken: the starting component `S` and the others, `T`.
#[derive(Clone, Debug)]
pub(super) struct Forest {
    pub seeds: Vec<usize>,
    pub start: Component,
    pub others: Vec<Component>,
}

impl Forest {
    /// `ranking` holds all edges, heaviest first; the first `seed_num` (at least one) become seeds. There is no sign
    /// test: a seed may have a negative contraction.
    pub fn new(graph: &Graph, ranking: &[usize], seed_num: usize) -> Self {
        let seeds = ranking[..seed_num.min(ranking.len())].to_vec();
        let mut others = graph.components(&graph.break_cycles(seeds.clone()));
        let totals: Vec<(f64, f64)> = others.iter().map(|component| graph.total(&component.edges)).collect();
        let largest = totals.iter().copied().fold((f64::NEG_INFINITY, 0.0), |a, b| if b.0 > a.0 { b } else { a });
        let ties = |&(sum, size): &(f64, f64)| sum >= largest.0 - ROUNDING * (size + largest.1);
        let start = totals.iter().position(ties).unwrap_or(0);
        let start = others.remove(start);
        Self { seeds, start, others }
    }
}

/// Union-find whose representatives are the smallest members.
struct DisjointSets(Vec<usize>);

impl DisjointSets {
    fn new(size: usize) -> Self {
        Self((0..size).collect())
    }

    fn find(&mut self, mut node: usize) -> usize {
        while self.0[node] != node {
            self.0[node] = self.0[self.0[node]];
            node = self.0[node];
        }
        node
    }

    /// True where the two ends were apart.
    fn union(&mut self, [a, b]: [usize; 2]) -> bool {
        let (a, b) = (self.find(a), self.find(b));
        self.0[a.max(b)] = a.min(b);
        a != b
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cycles_break_at_the_lightest_edge_and_ties_delete_the_larger_ids() {
        let graph = Graph::new(4, &[[1, 0], [1, 2], [2, 0], [3, 2]], &[2.0, 1.0, 3.0, 0.5]).unwrap();
        assert_eq!(graph.pairs(&graph.break_cycles(vec![0, 1, 2, 3])), [[0, 1], [0, 2], [2, 3]]);
        let equal = Graph::new(3, &[[1, 2], [0, 2], [0, 1]], &[1.0; 3]).unwrap();
        assert_eq!(equal.pairs(&equal.break_cycles(vec![0, 1, 2])), [[0, 1], [0, 2]]);
    }

    #[test]
    fn the_start_is_chosen_after_cycles_are_broken() {
        // The triangle weighs 3.3 before, 2.3 after its cycle is broken; the single edge 2.5.
        let graph = Graph::new(5, &[[0, 1], [1, 2], [0, 2], [3, 4]], &[1.0, 1.3, 1.0, 2.5]).unwrap();
        let forest = Forest::new(&graph, &graph.ranking(), 4);
        assert_eq!(forest.start.nodes, [3, 4]);
        assert_eq!(forest.others.len(), 1);
    }

    #[test]
    fn bad_input_is_refused_with_its_index() {
        let error = |nodes, edges: &[[usize; 2]], weights: &[f64]| Graph::new(nodes, edges, weights).err();
        assert_eq!(error(3, &[], &[]), Some(DiscoveryError::NoEdges));
        assert_eq!(
            error(3, &[[0, 1], [1, 3]], &[1.0; 2]),
            Some(DiscoveryError::NodeOutOfRange { edge: 1, node: 3, nodes: 3 })
        );
        assert_eq!(error(3, &[[2, 2]], &[1.0]), Some(DiscoveryError::SelfLoop { edge: 0, node: 2 }));
        assert_eq!(error(3, &[[0, 1], [1, 0]], &[1.0; 2]), Some(DiscoveryError::DuplicateEdge { edge: 1, first: 0 }));
        assert_eq!(error(3, &[[0, 1]], &[f64::NAN]), Some(DiscoveryError::NonFinite { edge: 0 }));
        assert_eq!(error(3, &[[0, 1]], &[]), Some(DiscoveryError::WeightCount { edges: 1, weights: 0 }));
    }
}
