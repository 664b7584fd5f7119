//! A body linearised at the postures reached so far: which tendons on one winch would move the targets most.
//!
//! With `M = H^-1`, a tendon of length gradient `g_q` under tension `tau_q` moves the targets by `-S M g_q tau_q`. Tendons `Q` on
//! one winch that takes in `beta` have the tensions `(C + D) tau = beta 1`, with the compliances `C_pq = g_p M g_q` and the
//! tendons' own `D = 1/(2K)`. For every root of a winch tree the tendons (paths of the tree that leave the root by different
//! branches) are added greedily so that the targets' residual, at its best `beta` in each pose, falls most.

use crate::design::Design;
use crate::engine::compile::{View, compile};
use crate::engine::patch::patch;
use crate::rigging::Baseline;
use crate::soft_ik::Actuation;
use nalgebra::{DMatrix, DVector};
use std::collections::BTreeMap;

/// Largest take-in considered, as a part of the shortest tendon: beyond it the linear model means little.
const LARGEST_TAKE_IN: f64 = 0.4;
/// Shortest tendon considered, in tree edges.
const SHORTEST_PATH: usize = 2;

/// Tendon sets of `tendon_num` tendons on a winch tree, with the squared residual that the linear model leaves (relative to
/// the residual without them, summed over the poses), best first; one set a root.
pub(super) fn select(
    design: &Design,
    tree: &[[usize; 2]],
    poses: &[Baseline],
    tendon_num: usize,
) -> Vec<(f64, Vec<Vec<usize>>)> {
    let tree = Tree::new(tree);
    let Some(responses) = responses(design, &tree, poses) else { return Vec::new() };
    let mut out = Vec::new();
    for root in 0..tree.nodes.len() {
        let paths: Vec<Path> = tree.paths(root).into_iter().map(|p| Path::new(design, &tree, p, &responses)).collect();
        if let Some((value, chosen)) = greedy(design, &paths, &responses, tendon_num) {
            let routing = |k: &usize| paths[*k].nodes.iter().map(|n| tree.nodes[*n]).collect();
            out.push((value, chosen.iter().map(routing).collect()));
        }
    }
    out.sort_by(|a, b| a.0.total_cmp(&b.0));
    out
}

/// A tree over some mesh nodes, with local indices.
struct Tree {
    nodes: Vec<usize>,
    neighbours: Vec<Vec<usize>>,
}

impl Tree {
    fn new(edges: &[[usize; 2]]) -> Self {
        let mut nodes: Vec<usize> = edges.iter().flatten().copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        let local: BTreeMap<usize, usize> = nodes.iter().enumerate().map(|(k, n)| (*n, k)).collect();
        let mut neighbours = vec![Vec::new(); nodes.len()];
        for [a, b] in edges {
            neighbours[local[a]].push(local[b]);
            neighbours[local[b]].push(local[a]);
        }
        for list in &mut neighbours {
            list.sort_unstable();
        }
        Self { nodes, neighbours }
    }

    /// The paths from `root` to every node at least [`SHORTEST_PATH`] edges away.
    fn paths(&self, root: usize) -> Vec<Vec<usize>> {
        let mut out = Vec::new();
        let mut stack = vec![vec![root]];
        while let Some(path) = stack.pop() {
            let (tip, before) = (path[path.len() - 1], path.len().checked_sub(2).map(|k| path[k]));
            for &next in self.neighbours[tip].iter().rev().filter(|n| Some(**n) != before && !path.contains(n)) {
                stack.push(path.iter().copied().chain([next]).collect());
            }
            if path.len() > SHORTEST_PATH {
                out.push(path);
            }
        }
        out
    }
}

/// The linearised body of one pose, on the degrees of freedom of the tree's nodes.
struct Response {
    /// Coordinates of the tree's nodes.
    x: Vec<[f64; 2]>,
    /// `M` between them.
    compliance: DMatrix<f64>,
    /// `S M`: motion of the targets.
    motion: DMatrix<f64>,
    /// `x' - S x`.
    wanted: DVector<f64>,
}

fn responses(design: &Design, tree: &Tree, poses: &[Baseline]) -> Option<Vec<Response>> {
    let mut plushie = compile(design, View::Realizable).ok()?;
    let n = plushie.model.dimension();
    let actuation = Actuation { winches: plushie.winches.clone(), fixed: vec![0.0; plushie.tendons.len()] };
    let mut out = Vec::new();
    for pose in poses {
        let posture = &pose.before.posture;
        plushie.model.contractile.set_contractions(&actuation.contractions(&posture.beta));
        plushie.model.factorize_for_descent(&posture.x).ok()?;
        let dofs: Vec<usize> = tree.nodes.iter().flat_map(|m| [2 * m, 2 * m + 1]).collect();
        let mut columns = vec![0.0; n * dofs.len()];
        for (k, d) in dofs.iter().enumerate() {
            columns[k * n + d] = 1.0;
        }
        plushie.model.solve_many(&mut columns, dofs.len());
        let column = |k: usize| &columns[k * n..(k + 1) * n];
        let mut motion = DMatrix::zeros(2 * pose.targets.len(), dofs.len());
        let mut wanted = DVector::zeros(2 * pose.targets.len());
        for (t, target) in pose.targets.iter().enumerate() {
            let (nodes, weights) = patch(&design.mesh, &target.at);
            let scale = target.weight.sqrt();
            for axis in 0..2 {
                let at = |x: &[f64]| -> f64 { nodes.iter().zip(&weights).map(|(m, w)| w * x[2 * m + axis]).sum() };
                wanted[2 * t + axis] = scale * (target.to[axis] - at(&posture.x));
                for k in 0..dofs.len() {
                    motion[(2 * t + axis, k)] = scale * at(column(k));
                }
            }
        }
        out.push(Response {
            x: tree.nodes.iter().map(|m| [posture.x[2 * m], posture.x[2 * m + 1]]).collect(),
            compliance: DMatrix::from_fn(dofs.len(), dofs.len(), |a, b| column(b)[dofs[a]]),
            motion,
            wanted,
        });
    }
    Some(out)
}

/// A path of the tree as a tendon: in every pose its length gradient and what that does.
struct Path {
    nodes: Vec<usize>,
    /// Nonzero entries of `g` per pose, over tree degrees of freedom.
    gradient: Vec<Vec<(usize, f64)>>,
    /// `-S M g` per pose.
    effect: Vec<DVector<f64>>,
    length: f64,
}

impl Path {
    fn new(design: &Design, tree: &Tree, nodes: Vec<usize>, responses: &[Response]) -> Self {
        let rest = |k: usize| design.mesh.nodes[tree.nodes[k]];
        let distance = |p: [f64; 2], q: [f64; 2]| (q[0] - p[0]).hypot(q[1] - p[1]);
        let length = nodes.windows(2).map(|s| distance(rest(s[0]), rest(s[1]))).sum();
        let mut gradient = Vec::new();
        let mut effect = Vec::new();
        for response in responses {
            let mut g: BTreeMap<usize, f64> = BTreeMap::new();
            for s in nodes.windows(2) {
                let (p, q) = (response.x[s[0]], response.x[s[1]]);
                let l = distance(p, q).max(f64::MIN_POSITIVE);
                for axis in 0..2 {
                    let u = (q[axis] - p[axis]) / l;
                    *g.entry(2 * s[1] + axis).or_default() += u;
                    *g.entry(2 * s[0] + axis).or_default() -= u;
                }
            }
            let mut moved = DVector::zeros(response.wanted.len());
            for (d, v) in &g {
                moved.axpy(-v, &response.motion.column(*d), 1.0);
            }
            gradient.push(g.into_iter().collect());
            effect.push(moved);
        }
        Self { nodes, gradient, effect, length }
    }

    fn coupling(&self, other: &Path, pose: usize, response: &Response) -> f64 {
        let mut sum = 0.0;
        for (a, u) in &self.gradient[pose] {
            for (b, v) in &other.gradient[pose] {
                sum += u * v * response.compliance[(*a, *b)];
            }
        }
        sum
    }
}

/// Adds tendons one by one, each by a branch of its own, so that the residual falls most. `None` where the root has too few
/// branches.
fn greedy(design: &Design, paths: &[Path], responses: &[Response], tendon_num: usize) -> Option<(f64, Vec<usize>)> {
    let mut chosen: Vec<usize> = Vec::new();
    let mut value = f64::INFINITY;
    while chosen.len() < tendon_num {
        let mut best: Option<(f64, usize)> = None;
        for k in 0..paths.len() {
            if chosen.iter().any(|c| paths[*c].nodes[1] == paths[k].nodes[1]) {
                continue;
            }
            let set: Vec<&Path> = chosen.iter().chain([&k]).map(|c| &paths[*c]).collect();
            let left = residual(design, &set, responses);
            if best.is_none_or(|(v, _)| left < v) {
                best = Some((left, k));
            }
        }
        let (left, k) = best?;
        value = left;
        chosen.push(k);
    }
    Some((value, chosen))
}

/// The part of the squared residual that a tendon set leaves, summed over the poses, each at its best take-in.
fn residual(design: &Design, set: &[&Path], responses: &[Response]) -> f64 {
    let own = 1.0 / (2.0 * design.tendons.stiffness);
    let most = LARGEST_TAKE_IN * set.iter().map(|p| p.length).fold(f64::INFINITY, f64::min);
    let mut sum = 0.0;
    for (pose, response) in responses.iter().enumerate() {
        let m = set.len();
        let mut matrix = DMatrix::zeros(m, m);
        for a in 0..m {
            for b in 0..=a {
                let c = set[a].coupling(set[b], pose, response) + if a == b { own } else { 0.0 };
                matrix[(a, b)] = c;
                matrix[(b, a)] = c;
            }
        }
        let unit = match matrix.cholesky() {
            Some(cholesky) => cholesky.solve(&DVector::from_element(m, 1.0)),
            None => return f64::INFINITY,
        };
        let mut effect = DVector::zeros(response.wanted.len());
        for (path, tension) in set.iter().zip(unit.iter()) {
            effect.axpy(tension.max(0.0), &path.effect[pose], 1.0);
        }
        let take_in = (effect.dot(&response.wanted) / effect.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, most);
        let left = (&response.wanted - effect * take_in).norm_squared();
        sum += left / response.wanted.norm_squared().max(f64::MIN_POSITIVE);
    }
    sum
}
