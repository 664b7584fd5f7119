//! The design loop without a hand: over all poses, solve, discover, try out, accept (section 3).
//!
//! Each round adds one winch. The idealized plushie, with the winches so far held at their best, shows which fibres are
//! still missed: in the pose that is worst served, and over all poses (root of the sum of squares). Both activation
//! graphs give candidate networks; every candidate is simulated in all poses, and the one that leaves the smallest
//! rms target error stays, after its routings were varied.

use super::{Effort, Question, Request, Shape, Solver};
use crate::defaults;
use crate::design::{Design, Network, Pose, Tendon, edit};
use crate::discovery::refine::{Surroundings, smooth, variants};
use crate::discovery::{Parameters, Spread, candidates};
use std::collections::BTreeSet;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A winch must lower the rms target error by this fraction at least, or it is not worth its motor.
const WORTHWHILE: f64 = 0.02;
/// Candidates simulated a round: the time of rigging grows with it.
const MAX_CANDIDATES: usize = 48;
/// How far a routing may leave the discovered path to save a hole, in mean edge lengths.
const STRAIGHTEN: f64 = 0.35;

/// What the loop may build and try.
#[derive(Clone, Debug, PartialEq)]
pub struct RigOptions {
    pub max_winches: usize,
    pub tendons: TendonChoice,
    /// Parameters of Algorithm 2 to vary around; the defaults where `None`.
    pub seed_num: Option<usize>,
    pub join_depth: Option<usize>,
    pub join_len: Option<usize>,
    pub phi: Option<f64>,
}

/// How many tendons each winch gets.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TendonChoice {
    /// Winch by winch; the last number holds for all further ones.
    PerWinch(Vec<usize>),
    /// Whatever serves best between the two, both included.
    Between(usize, usize),
}

/// Why no rig was found.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RigError {
    #[error("the design has no pose with targets, so there is nothing to rig for")]
    NoTargets,
    #[error("no network brings any pose closer to its targets")]
    NothingFound,
    #[error("cancelled")]
    Cancelled,
}

/// Adds networks to `design` until its poses are served or `options` are used up. `progress` gets one line a step.
pub fn rig(
    design: &Design,
    options: &RigOptions,
    progress: &mut dyn FnMut(&str),
    cancel: &AtomicBool,
) -> Result<Design, RigError> {
    let poses: Vec<&Pose> = design.poses.iter().filter(|pose| !pose.targets.is_empty()).collect();
    if poses.is_empty() {
        return Err(RigError::NoTargets);
    }
    let mut rigged = design.clone();
    let mut error = total_error(&rigged, &poses, cancel)?;
    progress(&format!("{} winches: rms target error {:.2} %", rigged.networks.len(), 100.0 * error));
    while rigged.networks.len() < options.max_winches {
        let networks = proposals(&rigged, &poses, options, cancel)?;
        let tried = networks.len();
        let Some((better, better_error)) = best(&rigged, &poses, networks, cancel)? else { break };
        let (better, better_error) = refined(&rigged, &poses, better, better_error, cancel)?;
        if better_error > (1.0 - WORTHWHILE) * error {
            break;
        }
        let tendons = better.tendons.len();
        if edit::accept_network(&mut rigged, better).is_err() {
            break;
        }
        error = better_error;
        progress(&format!(
            "{} winches: rms target error {:.2} %, {tendons} tendons on the new one, best of {tried} candidates",
            rigged.networks.len(),
            100.0 * error
        ));
    }
    if rigged.networks.is_empty() { Err(RigError::NothingFound) } else { Ok(rigged) }
}

/// Candidate networks for the next winch, from the fibres that are still missed.
fn proposals(
    design: &Design,
    poses: &[&Pose],
    options: &RigOptions,
    cancel: &AtomicBool,
) -> Result<Vec<Network>, RigError> {
    let (edges, owners) = fiber_edges(design);
    let mut worst = (0.0, vec![0.0; edges.len()]);
    let mut squares = vec![0.0; edges.len()];
    for pose in poses {
        let [idealized, realizable] = solve(design, pose, true, cancel)?;
        let weights: Vec<f64> = owners
            .iter()
            .map(|&(fiber, share)| {
                share * idealized.fiber_contractions_mm.get(fiber).copied().unwrap_or_default().max(0.0)
            })
            .collect();
        squares.iter_mut().zip(&weights).for_each(|(sum, w)| *sum += w * w);
        if realizable.target_error > worst.0 {
            worst = (realizable.target_error, weights);
        }
    }
    let overall: Vec<f64> = squares.into_iter().map(f64::sqrt).collect();
    let base = Parameters {
        seed_num: options.seed_num.unwrap_or(defaults::SEED_NUM),
        join_depth: options.join_depth.unwrap_or(defaults::JOIN_DEPTH),
        join_len: options.join_len.unwrap_or(defaults::JOIN_LEN),
        phi: options.phi.unwrap_or(defaults::PHI),
        tendon_num: defaults::TENDON_NUM,
        spread: Spread::StandardDeviation,
    };
    let counts = options.tendons.for_winch(design.networks.len());
    let mut sources = vec![worst.1];
    if poses.len() > 1 {
        sources.push(overall);
    }
    let share = MAX_CANDIDATES / sources.len();
    let (mut seen, mut networks) = (BTreeSet::new(), Vec::new());
    for weights in &sources {
        let around = Surroundings { positions: &design.mesh.nodes, edges: &edges, weights };
        // A graph without contraction or with too few branches has no candidates; the other source may have some.
        let found = candidates(design.mesh.nodes.len(), &edges, weights, &base, &counts).unwrap_or_default();
        let fresh = found
            .into_iter()
            .map(|(_, stages)| stages.tendons)
            .map(|tendons| tendons.iter().map(|path| smooth(path, &around, tolerance_mm(design))).collect::<Vec<_>>())
            .filter(|tendons| seen.insert(tendons.clone()))
            .collect::<Vec<_>>();
        // Spread evenly over the grid of parameters rather than taken from its first corner.
        let step = fresh.len().div_ceil(share.max(1)).max(1);
        networks.extend(fresh.into_iter().step_by(step).map(network));
    }
    Ok(networks)
}

/// The candidate that leaves the smallest error, and that error; the earlier one on a tie.
fn best(
    design: &Design,
    poses: &[&Pose],
    networks: Vec<Network>,
    cancel: &AtomicBool,
) -> Result<Option<(Network, f64)>, RigError> {
    let mut best: Option<(Network, f64)> = None;
    for network in networks {
        let mut trial = design.clone();
        if edit::accept_network(&mut trial, network.clone()).is_err() {
            continue;
        }
        let error = total_error(&trial, poses, cancel)?;
        if best.as_ref().is_none_or(|(_, smallest)| error < *smallest) {
            best = Some((network, error));
        }
    }
    Ok(best)
}

/// The network with its routings varied, as far as that helps.
fn refined(
    design: &Design,
    poses: &[&Pose],
    network: Network,
    error: f64,
    cancel: &AtomicBool,
) -> Result<(Network, f64), RigError> {
    let (edges, _) = fiber_edges(design);
    let weights = vec![1.0; edges.len()];
    let around = Surroundings { positions: &design.mesh.nodes, edges: &edges, weights: &weights };
    let tendons: Vec<Vec<usize>> = network.tendons.iter().map(|t| t.routing.clone()).collect();
    let others = variants(&tendons, &around, tolerance_mm(design)).into_iter().map(self::network).collect();
    Ok(match best(design, poses, others, cancel)? {
        Some((better, smaller)) if smaller < error => (better, smaller),
        _ => (network, error),
    })
}

/// Rms over the poses of the realizable plushie's target errors, body lengths.
fn total_error(design: &Design, poses: &[&Pose], cancel: &AtomicBool) -> Result<f64, RigError> {
    let mut sum = 0.0;
    for pose in poses {
        let [_, realizable] = solve(design, pose, false, cancel)?;
        sum += realizable.target_error.powi(2);
    }
    Ok((sum / poses.len() as f64).sqrt())
}

/// Idealized and realizable plushie in a pose, solved from rest; the idealized one stays there unless `both`.
fn solve(design: &Design, pose: &Pose, both: bool, cancel: &AtomicBool) -> Result<[Shape; 2], RigError> {
    let request = Request {
        id: 0,
        design: Arc::new(design.clone()),
        question: Question::Targets(pose.targets.clone()),
        show_idealized: both,
        show_realizable: true,
    };
    let outcome = Solver::default().solve_with(&request, Effort::Thorough, cancel);
    if cancel.load(Ordering::SeqCst) {
        return Err(RigError::Cancelled);
    }
    Ok([outcome.idealized.unwrap_or_default(), outcome.realizable.unwrap_or_default()])
}

/// The fibres as edges, smaller node first, each with its fibre and the share of the fibre's contraction it stands for.
fn fiber_edges(design: &Design) -> (Vec<[usize; 2]>, Vec<(usize, f64)>) {
    let (mut edges, mut owners, mut seen) = (Vec::new(), Vec::new(), BTreeSet::new());
    for (fiber, routing) in design.fiber_routings().iter().enumerate() {
        for pair in routing.windows(2) {
            let edge = [pair[0].min(pair[1]), pair[0].max(pair[1])];
            if seen.insert(edge) {
                edges.push(edge);
                owners.push((fiber, 1.0 / (routing.len() - 1) as f64));
            }
        }
    }
    (edges, owners)
}

fn tolerance_mm(design: &Design) -> f64 {
    let (edges, _) = fiber_edges(design);
    let nodes = &design.mesh.nodes;
    let length = |[i, j]: &[usize; 2]| (nodes[*i][0] - nodes[*j][0]).hypot(nodes[*i][1] - nodes[*j][1]);
    STRAIGHTEN * edges.iter().map(length).sum::<f64>() / edges.len().max(1) as f64
}

fn network(tendons: Vec<Vec<usize>>) -> Network {
    let tendons = tendons.into_iter().map(|routing| Tendon { routing, ratio: 1.0, slack_mm: 0.0 });
    Network { name: String::new(), tendons: tendons.collect() }
}

impl TendonChoice {
    /// The numbers of tendons to try for the winch with this index.
    pub fn for_winch(&self, index: usize) -> Vec<usize> {
        match self {
            Self::PerWinch(numbers) => numbers.get(index).or(numbers.last()).copied().into_iter().collect(),
            Self::Between(low, high) => (*low..=*high).collect(),
        }
    }
}
