//! Algorithm 2 by brute force: every cycle, every path, every set, in the plainest way. Only for small graphs.

use plushwright::discovery::{Parameters, Spread};
use std::collections::BTreeSet;

pub struct Reference {
    pub seeds: Vec<[usize; 2]>,
    pub start: Vec<[usize; 2]>,
    pub joins: Vec<Vec<usize>>,
    pub tree: Vec<[usize; 2]>,
    /// Winch, set of tendons, score.
    pub network: Option<(usize, BTreeSet<Vec<usize>>, f64)>,
}

/// Equal up to rounding: the test weights are far coarser or far apart.
fn ties(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-14 * (a.abs() + b.abs()) + 1e-22
}

type Edge = ([usize; 2], f64);

fn nodes_of(edges: &[Edge]) -> BTreeSet<usize> {
    edges.iter().flat_map(|edge| edge.0).collect()
}

/// The nodes that can be reached from one.
fn reach(edges: &[Edge], from: usize) -> BTreeSet<usize> {
    let mut reached = BTreeSet::from([from]);
    loop {
        let before = reached.len();
        for ([a, b], _) in edges {
            if reached.contains(a) || reached.contains(b) {
                reached.extend([*a, *b]);
            }
        }
        if reached.len() == before {
            return reached;
        }
    }
}

/// While there is a cycle, deletes the lightest edge that lies on one (of equal ones the largest ids).
fn break_cycles(mut edges: Vec<Edge>) -> Vec<Edge> {
    loop {
        let on_cycle = (0..edges.len()).filter(|&index| {
            let mut rest = edges.clone();
            let ([a, b], _) = rest.remove(index);
            reach(&rest, a).contains(&b)
        });
        let lightest =
            on_cycle.min_by(|&i, &j| edges[i].1.partial_cmp(&edges[j].1).unwrap().then(edges[j].0.cmp(&edges[i].0)));
        match lightest {
            Some(index) => edges.remove(index),
            None => return edges,
        };
    }
}

fn total(edges: &[Edge]) -> f64 {
    edges.iter().map(|edge| edge.1).sum()
}

/// Every path without repeated nodes from one node, of at most `length` edges, with its weight.
fn simple_paths(edges: &[Edge], path: &mut Vec<usize>, weight: f64, length: usize, out: &mut Vec<(Vec<usize>, f64)>) {
    out.push((path.clone(), weight));
    if length == 0 {
        return;
    }
    let last = *path.last().unwrap();
    for &([a, b], w) in edges {
        let next = if a == last { b } else { a };
        if (a == last || b == last) && !path.contains(&next) {
            path.push(next);
            simple_paths(edges, path, weight + w, length - 1, out);
            path.pop();
        }
    }
}

pub fn reference(nodes: usize, edges: &[[usize; 2]], weights: &[f64], parameters: &Parameters) -> Reference {
    let graph: Vec<Edge> = edges.iter().zip(weights).map(|(&[a, b], &w)| ([a.min(b), a.max(b)], w)).collect();
    let mut seeds = graph.clone();
    seeds.sort_by(|a, b| b.1.partial_cmp(&a.1).unwrap().then(a.0.cmp(&b.0)));
    seeds.truncate(parameters.seed_num);
    let forest = break_cycles(seeds.clone());
    let mut components: Vec<Vec<Edge>> = Vec::new();
    for node in 0..nodes {
        let reached = reach(&forest, node);
        if reached.len() > 1 && *reached.first().unwrap() == node {
            components.push(forest.iter().copied().filter(|edge| reached.contains(&edge.0[0])).collect());
        }
    }
    let largest = components.iter().map(|component| total(component)).fold(f64::NEG_INFINITY, f64::max);
    let start = components.iter().position(|component| ties(total(component), largest)).unwrap();
    let start = components.remove(start);

    let mut tree = start.clone();
    let mut joins = Vec::new();
    for _ in 0..parameters.join_depth {
        let mut added: Vec<Edge> = Vec::new();
        let tree_nodes = nodes_of(&tree);
        components.retain(|component| {
            let component_nodes = nodes_of(component);
            let mut paths = Vec::new();
            for &node in &tree_nodes {
                let mut all = Vec::new();
                simple_paths(&graph, &mut vec![node], 0.0, parameters.join_len.min(nodes), &mut all);
                paths.extend(all.into_iter().filter(|(path, _)| component_nodes.contains(path.last().unwrap())));
            }
            let Some(shortest) = paths.iter().map(|(path, _)| path.len()).min() else { return true };
            paths.retain(|(path, _)| path.len() == shortest);
            let heaviest = paths.iter().map(|path| path.1).fold(f64::NEG_INFINITY, f64::max);
            let path = paths.into_iter().filter(|path| ties(path.1, heaviest)).map(|path| path.0).min().unwrap();
            for pair in path.windows(2) {
                let pair = [pair[0].min(pair[1]), pair[0].max(pair[1])];
                added.push(*graph.iter().find(|edge| edge.0 == pair).unwrap());
            }
            added.extend(component);
            joins.push(path);
            false
        });
        for edge in added {
            if !tree.contains(&edge) {
                tree.push(edge);
            }
        }
        tree = break_cycles(tree);
    }

    let sorted = |edges: &[Edge]| edges.iter().map(|edge| edge.0).collect::<BTreeSet<_>>().into_iter().collect();
    let network = select(&tree, nodes, parameters);
    Reference { seeds: sorted(&seeds), start: sorted(&start), joins, tree: sorted(&tree), network }
}

type Ranked = (usize, Vec<usize>, BTreeSet<Vec<usize>>, f64);

fn select(tree: &[Edge], nodes: usize, parameters: &Parameters) -> Option<(usize, BTreeSet<Vec<usize>>, f64)> {
    let degree = |node: usize| tree.iter().filter(|edge| edge.0.contains(&node)).count();
    let mut sets: Vec<Ranked> = Vec::new();
    for root in nodes_of(tree) {
        let mut tendons = Vec::new();
        simple_paths(tree, &mut vec![root], 0.0, nodes, &mut tendons);
        tendons.retain(|(path, _)| path.len() > 1 && degree(*path.last().unwrap()) == 1);
        let mut chosen = Vec::new();
        combinations(&tendons, 0, &mut chosen, parameters, &mut |chosen| {
            let mut leaves: Vec<usize> = chosen.iter().map(|tendon| *tendon.0.last().unwrap()).collect();
            leaves.sort_unstable();
            let values: Vec<f64> = chosen.iter().map(|tendon| tendon.1).collect();
            sets.push((
                root,
                leaves,
                chosen.iter().map(|tendon| tendon.0.clone()).collect(),
                score(&values, parameters),
            ));
        });
    }
    let best = sets.iter().map(|set| set.3).fold(f64::NEG_INFINITY, f64::max);
    sets.retain(|set| ties(set.3, best));
    let (root, _, tendons, score) = sets.into_iter().min_by(|a, b| (a.0, &a.1).cmp(&(b.0, &b.1)))?;
    Some((root, tendons, score))
}

fn score(values: &[f64], parameters: &Parameters) -> f64 {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let variance = values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / count;
    let spread = match parameters.spread {
        Spread::Variance => variance,
        Spread::StandardDeviation => variance.sqrt(),
    };
    parameters.phi * mean - (1.0 - parameters.phi) * spread
}

/// Every set of TENDON_NUM tendons without a common edge.
fn combinations<'a>(
    tendons: &'a [(Vec<usize>, f64)],
    from: usize,
    chosen: &mut Vec<&'a (Vec<usize>, f64)>,
    parameters: &Parameters,
    visit: &mut impl FnMut(&[&'a (Vec<usize>, f64)]),
) {
    if chosen.len() == parameters.tendon_num {
        return visit(chosen);
    }
    for (index, tendon) in tendons.iter().enumerate().skip(from) {
        let edges = |path: &[usize]| {
            path.windows(2).map(|pair| [pair[0].min(pair[1]), pair[0].max(pair[1])]).collect::<BTreeSet<_>>()
        };
        if chosen.iter().all(|other| edges(&other.0).is_disjoint(&edges(&tendon.0))) {
            chosen.push(tendon);
            combinations(tendons, index + 1, chosen, parameters, visit);
            chosen.pop();
        }
    }
}
