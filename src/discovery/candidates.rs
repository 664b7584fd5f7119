//! Several networks for one pose: Algorithm 2 with its parameters varied.
//!
//! The score of Algorithm 2 is a heuristic, and slightly different activations can give very different networks. So the
//! tool proposes many, simulates each, and ranks them by the pose that is really reached.

use super::graph::{Forest, Graph};
use super::select::Selector;
use super::tree::WinchTree;
use super::{DiscoveryError, Parameters, Stages};
use std::collections::BTreeSet;

/// Multiples of SEED_NUM, in percent. Half finds the core of a motion, twice reaches whole limbs.
const SEED_PERCENT: [usize; 5] = [100, 50, 75, 150, 200];
/// Values of phi beside the one given: from equal tendons to long ones.
const PHIS: [f64; 4] = [0.2, 0.5, 0.8, 1.0];
/// Added to JOIN_DEPTH and JOIN_LEN for a wider reach.
const WIDER: usize = 2;

/// The distinct networks, each with the parameters that found it, over the grid
///
/// | parameter | values |
/// | --- | --- |
/// | SEED_NUM | 100, 50, 75, 150 and 200 % of the base's, at most the number of contracted fibres |
/// | JOIN_DEPTH | the base's, 1, two more than the base's, 0 |
/// | JOIN_LEN | the base's, 1, two more than the base's |
/// | TENDON_NUM | `tendon_nums`, in their order, as far as the winch tree has branches |
/// | phi | the base's, 0.2, 0.5, 0.8, 1 |
///
/// The order is that of the grid, the last row running fastest; the first is the base's own network where `tendon_nums`
/// starts with its TENDON_NUM. Networks count as equal where their sets of tendons are. At most 250 a tendon number;
/// usually a dozen.
///
/// # Errors
/// Invalid input, or [`DiscoveryError::Inactive`] where no fibre is contracted.
pub fn candidates(
    nodes: usize,
    edges: &[[usize; 2]],
    weights: &[f64],
    base: &Parameters,
    tendon_nums: &[usize],
) -> Result<Vec<(Parameters, Stages)>, DiscoveryError> {
    let graph = Graph::new(nodes, edges, weights)?;
    base.validate()?;
    for &tendon_num in tendon_nums {
        Parameters { tendon_num, ..base.clone() }.validate()?;
    }
    let active = weights.iter().filter(|&&weight| weight > 0.0).count();
    if active == 0 {
        return Err(DiscoveryError::Inactive);
    }
    let ranking = graph.ranking();
    let seed_nums = SEED_PERCENT.map(|percent| (base.seed_num.saturating_mul(percent) / 100).clamp(1, active));
    let depths = [base.join_depth, 1, base.join_depth.saturating_add(WIDER), 0];
    let lengths = [base.join_len, 1, base.join_len.saturating_add(WIDER)];
    let phis: Vec<f64> = std::iter::once(base.phi).chain(PHIS).collect();

    let (mut trees, mut networks, mut found) = (BTreeSet::new(), BTreeSet::new(), Vec::new());
    for seed_num in distinct(&seed_nums) {
        let forest = Forest::new(&graph, &ranking, seed_num);
        let grid = distinct(&depths).flat_map(|depth| distinct(&lengths).map(move |length| (depth, length)));
        for (join_depth, join_len) in grid {
            let mut tree = WinchTree::new(&graph, &forest);
            tree.grow(&graph, join_depth, join_len);
            let tree_edges = tree.edges(&graph);
            if !trees.insert(tree_edges.clone()) {
                continue;
            }
            let selector = Selector::new(&graph, &tree_edges);
            let stages = Stages::up_to_tree(&graph, &forest, tree, &tree_edges);
            for &tendon_num in tendon_nums {
                for &phi in &phis {
                    let Some(selection) = selector.best(tendon_num, phi, base.spread) else { continue };
                    // The tendons of a selection are sorted already: a list is as good as a set.
                    if networks.insert(selection.tendons.clone()) {
                        let parameters =
                            Parameters { seed_num, join_depth, join_len, tendon_num, phi, spread: base.spread };
                        found.push((parameters, stages.clone().with(selection)));
                    }
                }
            }
        }
    }
    Ok(found)
}

/// The values without repetitions, in their order.
fn distinct(values: &[usize]) -> impl Iterator<Item = usize> {
    let first = values.iter().enumerate().filter(|(index, value)| !values[..*index].contains(value));
    first.map(|(_, value)| *value).collect::<Vec<_>>().into_iter()
}
