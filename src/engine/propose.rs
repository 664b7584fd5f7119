//! Networks for a pose, ranked by simulation.
//!
//! The score of Algorithm 2 is a heuristic, and small differences in activations change the network it finds. So the fibres'
//! activations are turned into many candidates (parameters varied, paths refined), each is added to the realizable plushie and
//! posed, and what counts is the pose error that is really reached.

use super::response;
use super::solver::{Effort, Solver};
use super::trial::{Care, Reached, Trial};
use super::{Proposal, Quality, Question, Request, Shape};
use crate::design::{Design, Network, Target, Tendon};
use crate::discovery::{self, Parameters, Stages, refine};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Proposals returned.
const PROPOSALS: usize = 8;
/// Candidates that are simulated for one set of proposals, the most promising first: a few seconds of work.
const SCREENED: usize = 100;
/// Candidates that are posed carefully after a quick screening.
const SETTLED: usize = 10;
/// SEED_NUM of the wide winch trees on which the body's response selects, and their JOIN_DEPTH and JOIN_LEN.
const WIDE_SEEDS: [usize; 4] = [16, 32, 64, 100];
const WIDE_JOIN: usize = 12;
/// Trees on which the response selects, sets kept of each, and sets kept in all.
const TREES: usize = 8;
const ROOTS: usize = 12;
const RESPONSE_CANDIDATES: usize = 40;
/// A dropped via point may lie this far from the straightened tendon, as a part of the mean edge length.
const STRAIGHTENING: f64 = 0.15;

/// A candidate network and where it came from.
#[derive(Clone, Debug)]
pub struct Candidate {
    pub tendons: Vec<Vec<usize>>,
    pub parameters: Parameters,
    pub stages: Stages,
}

/// Proposes networks of `base.tendon_num` tendons (fewer or more where that serves better) for a pose, best simulated pose
/// error first. Empty where nothing helps, or when cancelled.
pub fn propose(design: &Design, targets: &[Target], base: &Parameters, cancel: &AtomicBool) -> Vec<Proposal> {
    let mut tendon_nums = vec![base.tendon_num];
    tendon_nums.extend((1..=3).filter(|n| *n != base.tendon_num));
    let Some(before) = Trial::new(design).map(|mut t| t.pose(design, targets, None, Care::Whole, cancel)) else {
        return Vec::new();
    };
    let poses = [Known { targets, before: &before }];
    let mut candidates = candidates(design, targets, &poses, base, &tendon_nums, cancel);
    candidates.truncate(SCREENED);
    let ranked = rank(design, candidates, &poses, cancel);
    let mut out = Vec::new();
    for (candidate, mut reached) in ranked.into_iter().take(PROPOSALS) {
        let with = with_network(design, &candidate.tendons);
        let (Some(reached), Some(mut trial)) = (reached.pop(), Trial::new(&with)) else { continue };
        let Some(network) = with.networks.last().cloned() else { continue };
        out.push(Proposal {
            network,
            parameters: candidate.parameters,
            stages: Arc::new(candidate.stages),
            preview: Arc::new(trial.shape(&with, targets, &reached)),
            error_before: before.error,
            error_after: reached.error,
        });
    }
    out
}

/// A pose that a network should serve, and what the rig reaches without it.
pub struct Known<'a> {
    pub targets: &'a [Target],
    pub before: &'a Reached,
}

/// Candidate networks from the fibres' activations of the idealized plushie in one pose: those of Algorithm 2 with its
/// parameters varied and paths refined, and those that the body's response (in all `poses`) selects on the same winch trees.
pub fn candidates(
    design: &Design,
    targets: &[Target],
    poses: &[Known],
    base: &Parameters,
    tendon_nums: &[usize],
    cancel: &AtomicBool,
) -> Vec<Candidate> {
    let request = Request {
        id: 0,
        design: Arc::new(design.clone()),
        question: Question::Targets(targets.to_vec()),
        quality: Quality::Accurate,
        show_idealized: true,
        show_realizable: false,
    };
    let Some(shape) = Solver::default().solve_with(&request, Effort::Thorough, cancel).idealized else {
        return Vec::new();
    };
    let (edges, weights) = activation_graph(design, &shape);
    let nodes = design.mesh.nodes.len();
    let Ok(found) = discovery::candidates(nodes, &edges, &weights, base, tendon_nums) else { return Vec::new() };
    let mean = mean_length(design, &edges);
    let around = refine::Surroundings { positions: &design.mesh.nodes, edges: &edges, weights: &weights };
    let mut out = by_response(design, &edges, &weights, &found, poses, tendon_nums);
    for (parameters, stages) in found {
        let own = stages.tendons.clone();
        for tendons in std::iter::once(own).chain(refine::variants(&stages.tendons, &around, STRAIGHTENING * mean)) {
            if !out.iter().any(|c| c.tendons == tendons) {
                out.push(Candidate { tendons, parameters: parameters.clone(), stages: stages.clone() });
            }
        }
    }
    out
}

/// Sets selected by the body's response on the winch trees found, and on wider ones that reach every active limb.
fn by_response(
    design: &Design,
    edges: &[[usize; 2]],
    weights: &[f64],
    found: &[(Parameters, Stages)],
    poses: &[Known],
    tendon_nums: &[usize],
) -> Vec<Candidate> {
    let mut trees: Vec<(Parameters, Stages)> = Vec::new();
    let mut add = |parameters: Parameters, stages: Stages| {
        if !stages.tree.is_empty() && !trees.iter().any(|(_, s)| s.tree == stages.tree) {
            trees.push((parameters, stages));
        }
    };
    let Some((base, _)) = found.first() else { return Vec::new() };
    for seed_num in WIDE_SEEDS {
        let wide = Parameters { seed_num, join_depth: WIDE_JOIN, join_len: WIDE_JOIN, tendon_num: 1, ..base.clone() };
        if let Ok(stages) = discovery::propose(design.mesh.nodes.len(), edges, weights, &wide) {
            add(wide, stages);
        }
    }
    for (parameters, stages) in found {
        add(parameters.clone(), stages.clone());
    }
    let mut scored: Vec<(f64, Candidate)> = Vec::new();
    for (parameters, stages) in trees.into_iter().take(TREES) {
        for &tendon_num in tendon_nums {
            for (value, tendons) in response::select(design, &stages.tree, poses, tendon_num).into_iter().take(ROOTS) {
                if scored.iter().any(|(_, c)| c.tendons == tendons) {
                    continue;
                }
                let parameters = Parameters { tendon_num, ..parameters.clone() };
                let winch = tendons.first().and_then(|t| t.first()).copied().unwrap_or(stages.winch);
                let stages = Stages { winch, tendons: tendons.clone(), ..stages.clone() };
                scored.push((value, Candidate { tendons, parameters, stages }));
            }
        }
    }
    scored.sort_by(|a, b| a.0.total_cmp(&b.0));
    scored.into_iter().take(RESPONSE_CANDIDATES).map(|(_, c)| c).collect()
}

/// The activation graph of an idealized shape: the mesh edges with the contraction of their fibre. A fibre with via points
/// shares its contraction among its segments by length.
pub fn activation_graph(design: &Design, shape: &Shape) -> (Vec<[usize; 2]>, Vec<f64>) {
    let edges = design.mesh.edges();
    let mut weights = vec![0.0; edges.len()];
    let length = |a: usize, b: usize| {
        let (p, q) = (design.mesh.nodes[a], design.mesh.nodes[b]);
        (q[0] - p[0]).hypot(q[1] - p[1])
    };
    for (routing, contraction) in design.fiber_routings().iter().zip(&shape.fiber_contractions_mm) {
        let total: f64 = routing.windows(2).map(|s| length(s[0], s[1])).sum();
        for s in routing.windows(2) {
            if let Ok(k) = edges.binary_search(&[s[0].min(s[1]), s[0].max(s[1])]) {
                weights[k] += contraction * length(s[0], s[1]) / total;
            }
        }
    }
    (edges, weights)
}

/// The candidates that lower the misfit of the poses, best first, with what each pose reaches. Quick screening of all, then
/// care for the best; two threads, the same result whatever their number.
pub fn rank(
    design: &Design,
    candidates: Vec<Candidate>,
    poses: &[Known],
    cancel: &AtomicBool,
) -> Vec<(Candidate, Vec<Reached>)> {
    let screened = try_all(design, &candidates, poses, Care::Screen, cancel);
    let mut order: Vec<usize> = (0..candidates.len()).collect();
    order.sort_by(|&a, &b| misfit(design, poses, &screened[a]).total_cmp(&misfit(design, poses, &screened[b])));
    order.truncate(SETTLED);
    let best: Vec<Candidate> = order.into_iter().map(|k| candidates[k].clone()).collect();
    if cancel.load(Ordering::Relaxed) {
        return Vec::new();
    }
    let settled = try_all(design, &best, poses, Care::Look, cancel);
    let before: Vec<Reached> = poses.iter().map(|p| p.before.clone()).collect();
    let mut out: Vec<(Candidate, Vec<Reached>)> = best.into_iter().zip(settled).collect();
    out.retain(|(_, reached)| misfit(design, poses, reached) < misfit(design, poses, &before));
    out.sort_by(|a, b| misfit(design, poses, &a.1).total_cmp(&misfit(design, poses, &b.1)));
    out
}

/// What a rig still misses: the fourth powers of the errors relative to the rest pose, summed, so that the worst pose counts
/// most. Infinite where nothing was reached.
pub fn misfit(design: &Design, poses: &[Known], reached: &[Reached]) -> f64 {
    if reached.len() != poses.len() {
        return f64::INFINITY;
    }
    let ratio = |pose: &Known, reached: &Reached| {
        let rest = super::solver::target_error(design, pose.targets, &design.mesh.nodes);
        if rest > 0.0 { reached.error / rest } else { 0.0 }
    };
    poses.iter().zip(reached).map(|(p, r)| ratio(p, r).powi(4)).sum()
}

/// Tries every candidate on every pose. An empty list stands for a candidate that has no model.
pub fn try_all(
    design: &Design,
    candidates: &[Candidate],
    poses: &[Known],
    care: Care,
    cancel: &AtomicBool,
) -> Vec<Vec<Reached>> {
    let threads = std::thread::available_parallelism().map_or(1, |n| n.get()).min(8);
    let mut out: Vec<Vec<Reached>> = vec![Vec::new(); candidates.len()];
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads)
            .map(|worker| {
                scope.spawn(move || {
                    let mine = candidates.iter().enumerate().skip(worker).step_by(threads);
                    mine.take_while(|_| !cancel.load(Ordering::Relaxed))
                        .map(|(k, candidate)| (k, try_one(design, candidate, poses, care, cancel)))
                        .collect::<Vec<_>>()
                })
            })
            .collect();
        for worker in workers {
            for (k, reached) in worker.join().unwrap_or_default() {
                out[k] = reached;
            }
        }
    });
    out
}

fn try_one(design: &Design, candidate: &Candidate, poses: &[Known], care: Care, cancel: &AtomicBool) -> Vec<Reached> {
    let with = with_network(design, &candidate.tendons);
    let Some(mut trial) = Trial::new(&with) else { return Vec::new() };
    poses.iter().map(|p| trial.pose(&with, p.targets, Some(&p.before.posture), care, cancel)).collect()
}

/// The design with one more network.
pub fn with_network(design: &Design, tendons: &[Vec<usize>]) -> Design {
    let mut with = design.clone();
    let tendons = tendons.iter().map(|routing| Tendon { routing: routing.clone(), ratio: 1.0, slack_mm: 0.0 });
    with.networks.push(Network { name: unused_name(design), tendons: tendons.collect() });
    with
}

fn unused_name(design: &Design) -> String {
    let mut k = design.networks.len() + 1;
    loop {
        let name = format!("winch {k}");
        if design.networks.iter().all(|n| n.name != name) {
            return name;
        }
        k += 1;
    }
}

fn mean_length(design: &Design, edges: &[[usize; 2]]) -> f64 {
    let nodes = &design.mesh.nodes;
    let sum: f64 = edges.iter().map(|&[a, b]| (nodes[b][0] - nodes[a][0]).hypot(nodes[b][1] - nodes[a][1])).sum();
    sum / edges.len().max(1) as f64
}
