//! Seeded rigs: bundled bodies with tendons along random shortest paths, and poses for them.

use crate::bench::{BenchError, drags, shapes};
use crate::design::{Design, MaterialPoint, Network, Target, Tendon};
use crate::engine::compile::{View, compile};
use crate::outline::Point;
use crate::random::Random;
use crate::soft_ik::{Actuation, Objective, Question};
use std::collections::VecDeque;

/// Fibres of a body, at least and at most. What is posed are the tendons, so these only say how fine the mesh is.
const FIBERS: [f64; 2] = [180.0, 420.0];
/// Tendons of a winch at most, and how far their tips are from the winch at least, in body lengths.
const TENDONS: usize = 3;
const REACH: f64 = 0.25;
/// Targets of a pose at most.
const TARGETS: usize = 5;
/// Goals that are not read off a wound state are so far away, in body lengths.
const AWAY: [f64; 2] = [0.08, 0.45];
/// Goals that are read off one are moved aside by up to this, in body lengths.
const ASIDE: f64 = 0.08;
/// Steps in which that state is wound.
const STEPS: usize = 40;

/// A design with one pose.
pub struct Rig {
    pub design: Design,
    pub targets: Vec<Target>,
}

/// The rig of this number.
///
/// # Errors
/// A name that is no shape, or a shape that cannot be meshed or compiled.
pub fn rig(shape: &str, winches: usize, seed: u64, number: u64, stop: &dyn Fn() -> bool) -> Result<Rig, BenchError> {
    let mut random = Random::of(seed, &format!("{shape} winding {winches}"), number);
    let fibers = random.between(FIBERS[0], FIBERS[1]) as usize;
    let mut design = shapes::design(shape, fibers)?;
    let neighbours = design.mesh.neighbours();
    for k in 0..winches {
        let network = network(&design, &neighbours, format!("winch {}", k + 1), &mut random);
        design.networks.push(network);
    }
    let places = drags::places(shape, 1 + random.index(TARGETS), &mut random)?;
    let at: Vec<_> = places.iter().filter_map(|p| design.mesh.locate_nearest(*p, &design.mesh.nodes)).collect();
    let begin: Vec<Point> = at.iter().map(|(at, _)| design.mesh.position(at, &design.mesh.nodes)).collect();
    let length = design.body_length_mm();
    let goals: Vec<Point> = if random.unit() < 0.5 {
        let away = length * random.between(AWAY[0], AWAY[1]);
        begin.iter().map(|p| moved(*p, away, &mut random)).collect()
    } else {
        let nodes = wound(&design, shape, &mut random, stop)?;
        let aside = length * random.between(0.0, ASIDE);
        at.iter().map(|(at, _)| moved(design.mesh.position(at, &nodes), aside, &mut random)).collect()
    };
    let targets = at.iter().zip(goals).map(|((at, _), to)| Target { at: *at, to, weight: 1.0 }).collect();
    Ok(Rig { design, targets })
}

fn moved(p: Point, by: f64, random: &mut Random) -> Point {
    let d = random.direction();
    [p[0] + by * d[0], p[1] + by * d[1]]
}

/// A winch at a random node, with tendons along shortest paths to nodes some way off.
fn network(design: &Design, neighbours: &[Vec<usize>], name: String, random: &mut Random) -> Network {
    let nodes = &design.mesh.nodes;
    let root = random.index(nodes.len());
    let far = |n: &usize| {
        let (p, q) = (nodes[*n], nodes[root]);
        (p[0] - q[0]).hypot(p[1] - q[1]) >= REACH * design.body_length_mm()
    };
    let tips: Vec<usize> = (0..nodes.len()).filter(far).collect();
    let mut tendons = Vec::new();
    for _ in 0..1 + random.index(TENDONS) {
        let tip = tips[random.index(tips.len())];
        let slack_mm = if random.unit() < 0.3 { random.between(0.5, 5.0) } else { 0.0 };
        if let Some(routing) = path(neighbours, root, tip) {
            let routing = MaterialPoint::through(routing);
            tendons.push(Tendon { routing, ratio: 1.0, slack_mm });
        }
    }
    Network::new(name, tendons)
}

/// A path of fewest edges; `None` where there is none.
fn path(neighbours: &[Vec<usize>], from: usize, to: usize) -> Option<Vec<usize>> {
    let mut before = vec![usize::MAX; neighbours.len()];
    let mut queue = VecDeque::from([from]);
    before[from] = from;
    while let Some(node) = queue.pop_front() {
        for &next in &neighbours[node] {
            if before[next] == usize::MAX {
                before[next] = node;
                queue.push_back(next);
            }
        }
    }
    let mut out = vec![to];
    while out[out.len() - 1] != from {
        let node = before[out[out.len() - 1]];
        if node == usize::MAX {
            return None;
        }
        out.push(node);
    }
    out.reverse();
    Some(out)
}

/// Where the nodes are in a random wound state.
fn wound(design: &Design, shape: &str, random: &mut Random, stop: &dyn Fn() -> bool) -> Result<Vec<Point>, BenchError> {
    let fail = |source| BenchError::Model { shape: shape.to_owned(), source };
    let mut plushie = compile(design, View::Realizable).map_err(fail)?;
    let actuation = Actuation { winches: plushie.winches.clone(), fixed: vec![0.0; plushie.tendons.len()] };
    let beta: Vec<f64> = actuation.winches.iter().map(|w| w.upper * random.between(0.1, 0.95)).collect();
    let objective = Objective { rest: plushie.model.rest.clone(), ..Objective::default() };
    let mut question = Question { model: &mut plushie.model, actuation: &actuation, objective: &objective };
    let rest = question.model.rest.clone();
    let (start, _) = question.settle(&vec![0.0; beta.len()], &rest, stop);
    let (end, _) = question.wind(&start, &beta, STEPS, stop);
    Ok(end.x.chunks_exact(2).map(|p| [p[0], p[1]]).collect())
}
