//! The winch tree `G_W`: the starting component and what lies near it (step 1 of Algorithm 2).

use super::graph::{Component, Forest, Graph, ROUNDING};

/// The winch tree while it grows, one round of joining after another.
#[derive(Clone, Debug)]
pub(super) struct WinchTree {
    in_tree: Vec<bool>,
    /// Edges of the union so far, cycles included.
    edges: Vec<usize>,
    waiting: Vec<Component>,
    /// The joining paths found so far, each from the tree outward; of one node where a component already touched it.
    pub joins: Vec<Vec<usize>>,
}

impl WinchTree {
    pub fn new(graph: &Graph, forest: &Forest) -> Self {
        let mut in_tree = vec![false; graph.neighbors.len()];
        forest.start.nodes.iter().for_each(|&node| in_tree[node] = true);
        Self { in_tree, edges: forest.start.edges.clone(), waiting: forest.others.clone(), joins: Vec::new() }
    }

    /// At most `join_depth` rounds of joining over at most `join_len` edges.
    pub fn grow(&mut self, graph: &Graph, join_depth: usize, join_len: usize) {
        for _ in 0..join_depth {
            // Without a join the tree is the same in all further rounds.
            if !self.join_round(graph, join_len) {
                break;
            }
        }
    }

    /// One round: every path is measured from the tree as it stood at the start of the round, and may run through any
    /// mesh edge. False where nothing was joined.
    fn join_round(&mut self, graph: &Graph, join_len: usize) -> bool {
        let levels = self.levels(graph, join_len);
        let before = self.waiting.len();
        let (mut nodes, mut edges): (Vec<usize>, Vec<usize>) = (Vec::new(), Vec::new());
        let mut waiting = std::mem::take(&mut self.waiting);
        waiting.retain(|component| {
            let Some(path) = shortest_path(graph, &levels, component) else { return true };
            nodes.extend(component.nodes.iter().chain(&path.nodes));
            edges.extend(component.edges.iter().chain(&path.edges));
            self.joins.push(path.nodes);
            false
        });
        self.waiting = waiting;
        nodes.into_iter().for_each(|node| self.in_tree[node] = true);
        self.edges.extend(edges);
        self.waiting.len() < before
    }

    /// Number of edges from the tree to each node, breadth first; `None` beyond `join_len`.
    fn levels(&self, graph: &Graph, join_len: usize) -> Vec<Option<usize>> {
        let mut levels: Vec<Option<usize>> = self.in_tree.iter().map(|&inside| inside.then_some(0)).collect();
        let mut front: Vec<usize> = (0..levels.len()).filter(|&node| self.in_tree[node]).collect();
        for level in 1.. {
            if level > join_len || front.is_empty() {
                break;
            }
            let mut next = Vec::new();
            for &(node, _) in front.iter().flat_map(|&node| &graph.neighbors[node]) {
                if levels[node].is_none() {
                    levels[node] = Some(level);
                    next.push(node);
                }
            }
            front = next;
        }
        levels
    }

    /// The edges of the tree. Its cycles, which paths through neighbouring components can close, are broken at the
    /// lightest edge; once at the end, because only the nodes matter while the tree grows and the maximum spanning
    /// forest of a union is that of the parts' forests.
    pub fn edges(&self, graph: &Graph) -> Vec<usize> {
        graph.break_cycles(self.edges.clone())
    }
}

struct Path {
    nodes: Vec<usize>,
    edges: Vec<usize>,
}

/// The path from the tree to a component with the fewest edges, then the largest total weight, then the smallest node
/// list from the tree outward. `levels` counts edges from the tree.
fn shortest_path(graph: &Graph, levels: &[Option<usize>], component: &Component) -> Option<Path> {
    let length = component.nodes.iter().filter_map(|&node| levels[node]).min()?;
    // Backwards from the component, the largest weight of a way there: `best[d]` over the nodes d edges away from the
    // tree, as (node, sum, sum of magnitudes), by ascending node.
    let ends = component.nodes.iter().filter(|&&node| levels[node] == Some(length));
    let mut best: Vec<Vec<(usize, f64, f64)>> = vec![ends.map(|&node| (node, 0.0, 0.0)).collect()];
    for level in (0..length).rev() {
        let mut ways = Vec::new();
        for &(node, sum, size) in best.last().into_iter().flatten() {
            for &(previous, edge) in &graph.neighbors[node] {
                if levels[previous] == Some(level) {
                    let weight = graph.weights[edge];
                    ways.push((previous, sum + weight, size + weight.abs()));
                }
            }
        }
        ways.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
        ways.dedup_by_key(|way| way.0);
        best.push(ways);
    }
    best.reverse();

    // Forwards, the smallest node from which the largest weight (up to rounding) is still in reach.
    let largest = best[0].iter().copied().max_by(|a, b| a.1.total_cmp(&b.1))?;
    let enough = largest.1 - ROUNDING * 2.0 * largest.2;
    let mut nodes = vec![best[0].iter().find(|way| way.1 >= enough)?.0];
    let (mut edges, mut sum) = (Vec::new(), 0.0);
    for ways in &best[1..] {
        let (node, edge) = *graph.neighbors[*nodes.last()?].iter().find(|&&(next, edge)| {
            let way = ways.binary_search_by_key(&next, |way| way.0);
            way.is_ok_and(|way| sum + graph.weights[edge] + ways[way].1 >= enough)
        })?;
        sum += graph.weights[edge];
        nodes.push(node);
        edges.push(edge);
    }
    Some(Path { nodes, edges })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Seeds 0-1 (the start) and 6-7, with a ladder of equal length between.
    fn joined(weights: [f64; 6]) -> Vec<Vec<usize>> {
        let edges = [[0, 1], [6, 7], [1, 3], [3, 6], [1, 2], [2, 6], [0, 4], [4, 5], [5, 7]];
        let mut all = vec![9.0, 8.0];
        all.extend(weights);
        all.push(0.0);
        let graph = Graph::new(8, &edges, &all).unwrap();
        let forest = Forest::new(&graph, &graph.ranking(), 2);
        let mut tree = WinchTree::new(&graph, &forest);
        tree.grow(&graph, 1, 2);
        tree.joins
    }

    #[test]
    fn paths_prefer_few_edges_then_weight_then_small_ids() {
        assert_eq!(joined([0.0, 0.0, 0.0, 0.0, 7.0, 7.0]), [[1, 2, 6]]);
        assert_eq!(joined([0.0, 0.1, 0.0, 0.0, 7.0, 7.0]), [[1, 3, 6]]);
        // 0.1 + 0.2 is not 0.3 in binary, and yet a tie.
        assert_eq!(joined([0.1, 0.2, 0.3, 0.0, 7.0, 7.0]), [[1, 2, 6]]);
    }

    #[test]
    fn a_round_sees_only_the_tree_of_its_start() {
        // A chain of seeds 0-1, 2-3, 4-5, one edge apart.
        let edges = [[0, 1], [2, 3], [4, 5], [1, 2], [3, 4]];
        let graph = Graph::new(6, &edges, &[5.0, 4.0, 3.0, 0.0, 0.0]).unwrap();
        let forest = Forest::new(&graph, &graph.ranking(), 3);
        for (depth, joins) in [(0, 0), (1, 1), (2, 2), (9, 2)] {
            let mut tree = WinchTree::new(&graph, &forest);
            tree.grow(&graph, depth, 1);
            assert_eq!((tree.joins.len(), tree.edges(&graph).len()), (joins, 1 + 2 * joins));
        }
    }
}
