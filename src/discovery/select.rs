//! Where the winch goes and which tendons it pulls (step 2 of Algorithm 2).

use super::Spread;
use super::graph::Graph;
use super::sets::{Measure, Score, TendonPath, best_score, smallest_set};

/// The winch tree with the candidate tendons of every possible root.
pub(super) struct Selector {
    /// Ascending by node.
    roots: Vec<Root>,
    /// Per root, in the same order: its neighbours in the tree as indices of roots.
    neighbors: Vec<Vec<usize>>,
    /// Sum of |w| over the tree.
    magnitude: f64,
}

struct Root {
    node: usize,
    /// One a leaf, ascending by net contraction.
    candidates: Vec<TendonPath>,
    /// Largest net contraction of each branch, descending.
    branch_maxima: Vec<f64>,
}

/// The outcome of step 2.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Selection {
    pub winch: usize,
    /// From the winch outward, ascending by leaf.
    pub tendons: Vec<Vec<usize>>,
    pub score: f64,
}

impl Selector {
    /// `tree`: the edges of the winch tree. Cost: nodes times nodes of the tree.
    pub fn new(graph: &Graph, tree: &[usize]) -> Self {
        let mut nodes: Vec<usize> = tree.iter().flat_map(|&edge| graph.edges[edge]).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let mut weighted = vec![Vec::new(); nodes.len()];
        for &edge in tree {
            let [a, b] = graph.edges[edge].map(|node| nodes.partition_point(|&other| other < node));
            weighted[a].push((b, graph.weights[edge]));
            weighted[b].push((a, graph.weights[edge]));
        }
        weighted.iter_mut().for_each(|list: &mut Vec<(usize, f64)>| list.sort_unstable_by_key(|entry| entry.0));
        let roots = (0..nodes.len()).map(|root| Root::new(root, &nodes, &weighted)).collect();
        let neighbors = weighted.iter().map(|list| list.iter().map(|entry| entry.0).collect()).collect();
        Self { roots, neighbors, magnitude: graph.total(tree).1 }
    }

    /// The largest number of branches at any root: no network can have more tendons.
    pub fn most_branches(&self) -> usize {
        self.neighbors.iter().map(Vec::len).max().unwrap_or(0)
    }

    /// The best winch and tendons; `None` where every root has fewer than `tendon_num` branches. Equal scores go to the
    /// smallest root, then to the smallest sorted list of leaves.
    pub fn best(&self, tendon_num: usize, phi: f64, spread: Spread) -> Option<Selection> {
        let measure = Measure::new(phi, spread, self.magnitude);
        // No spread is negative, so the mean of the largest candidates bounds a root's score from above. The roots are
        // tried in the order of their bounds, and the rest is skipped once the bounds fall below the best score.
        let bounds = self.roots.iter().enumerate().filter(|(_, root)| root.branch_maxima.len() >= tendon_num);
        let mut bounds: Vec<(usize, f64)> = bounds
            .map(|(index, root)| {
                (index, phi * root.branch_maxima[..tendon_num].iter().sum::<f64>() / tendon_num as f64)
            })
            .collect();
        bounds.sort_unstable_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        let mut scores: Vec<(usize, Score)> = Vec::new();
        let mut largest: Option<Score> = None;
        for (index, bound) in bounds {
            if largest.is_some_and(|score| bound + score.rounding < score.value - score.rounding) {
                break;
            }
            let Some(score) = best_score(&self.roots[index].candidates, &[], tendon_num, &measure) else { continue };
            scores.push((index, score));
            if largest.is_none_or(|largest| score.value > largest.value) {
                largest = Some(score);
            }
        }
        let largest = largest?;
        let winner = scores.iter().filter(|(_, score)| score.ties(largest)).map(|(index, _)| *index).min()?;
        let root = &self.roots[winner];
        let chosen = smallest_set(&root.candidates, tendon_num, &measure, largest)?;
        let net_contractions: Vec<f64> = chosen.iter().map(|candidate| candidate.net_contraction).collect();
        let tendons = chosen.iter().map(|candidate| self.path(winner, candidate.leaf)).collect();
        Some(Selection { winch: root.node, tendons, score: measure.score(&net_contractions).value })
    }

    /// The nodes from a root to a leaf.
    fn path(&self, root: usize, leaf: usize) -> Vec<usize> {
        let mut parents = vec![None; self.roots.len()];
        let mut stack = vec![root];
        while let Some(node) = stack.pop() {
            for &next in &self.neighbors[node] {
                if Some(next) != parents[node] {
                    parents[next] = Some(node);
                    stack.push(next);
                }
            }
        }
        let end = self.roots.partition_point(|root| root.node < leaf);
        let mut path: Vec<usize> =
            std::iter::successors(Some(end), |&node| parents[node]).map(|node| self.roots[node].node).collect();
        path.reverse();
        path
    }
}

impl Root {
    /// Walks from the root to all leaves; contractions are summed from the winch outward.
    fn new(root: usize, nodes: &[usize], neighbors: &[Vec<(usize, f64)>]) -> Self {
        let mut candidates = Vec::new();
        let mut branch_maxima = Vec::new();
        for (branch, &(first, weight)) in neighbors[root].iter().enumerate() {
            let mut largest = f64::NEG_INFINITY;
            let mut stack = vec![(first, root, weight)];
            while let Some((node, parent, net_contraction)) = stack.pop() {
                if neighbors[node].len() == 1 {
                    candidates.push(TendonPath { net_contraction, branch, leaf: nodes[node] });
                    largest = largest.max(net_contraction);
                }
                let onward = neighbors[node].iter().filter(|(next, _)| *next != parent);
                stack.extend(onward.map(|&(next, weight)| (next, node, net_contraction + weight)));
            }
            branch_maxima.push(largest);
        }
        candidates.sort_unstable_by(|a, b| a.net_contraction.total_cmp(&b.net_contraction).then(a.leaf.cmp(&b.leaf)));
        branch_maxima.sort_unstable_by(|a, b| b.total_cmp(a));
        Self { node: nodes[root], candidates, branch_maxima }
    }
}
