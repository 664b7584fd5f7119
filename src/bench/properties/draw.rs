//! Random problems: meshes, materials, elements, pins, weights, targets, starts; most are sound, some are not.

use crate::bench::extremes::scenes;
use crate::physics::NeoHookean;
use crate::problem::Problem;
use crate::problem::file::{DragData, ElementData, MeshData, ObjectiveData, PinData, SoftIkData, TargetData};
use crate::random::Random;

/// The problem with this number. One in sixteen is broken on purpose ([`Drawn::broken`]).
pub fn problem(seed: u64, number: u64) -> Drawn {
    let mut random = Random::of(seed, "problem", number);
    let mut problem = mesh(&mut random);
    material(&mut random, &mut problem);
    elements(&mut random, &mut problem);
    pins(&mut random, &mut problem);
    if chance(&mut random, 0.3) {
        weight(&mut random, &mut problem);
    }
    if chance(&mut random, 0.2) {
        start(&mut random, &mut problem);
    }
    if chance(&mut random, 0.5) {
        objective(&mut random, &mut problem);
    }
    if chance(&mut random, 0.2) {
        place(&mut random, &mut problem);
    }
    let broken = chance(&mut random, 1.0 / 16.0).then(|| damage(&mut random, &mut problem));
    Drawn { problem, broken }
}

/// A problem, and what was done to it.
pub struct Drawn {
    pub problem: Problem,
    /// The flaw that makes it unsound: it must be refused.
    pub broken: Option<&'static str>,
}

fn chance(random: &mut Random, part: f64) -> bool {
    random.unit() < part
}

/// `10^a ... 10^b`, uniform in the exponent.
fn power(random: &mut Random, a: f64, b: f64) -> f64 {
    10f64.powf(random.between(a, b))
}

/// A grid of up to 5 x 3 cells, its nodes moved at random and some cells left out; now and then in two pieces.
fn mesh(random: &mut Random) -> Problem {
    let (columns, rows) = (1 + random.index(5), 1 + random.index(3));
    let at = |i: usize, j: usize| j * (columns + 1) + i;
    // Sometimes so far that slivers come about.
    let jitter = if chance(random, 0.3) { 0.45 } else { 0.2 };
    let mut nodes = Vec::new();
    for j in 0..=rows {
        for i in 0..=columns {
            let mut shake = || random.between(-jitter, jitter);
            nodes.push([i as f64 + shake(), j as f64 + shake()]);
        }
    }
    let gap = chance(random, 0.1).then(|| random.index(columns));
    let mut triangles = Vec::new();
    for j in 0..rows {
        for i in 0..columns {
            if columns > 2 && (gap == Some(i) || chance(random, 0.05)) {
                continue;
            }
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let pair = if chance(random, 0.5) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
            triangles.extend(pair);
        }
    }
    let mut mesh = MeshData { nodes, triangles: Vec::new() };
    triangles.retain(|t| mesh.area(t) > 1e-6);
    mesh.triangles = triangles;
    if mesh.triangles.is_empty() {
        mesh = MeshData { nodes: vec![[0.0, 0.0], [1.0, 0.0], [0.2, 0.7]], triangles: vec![[0, 1, 2]] };
    }
    Problem { mesh, ..Problem::default() }
}

fn material(random: &mut Random, problem: &mut Problem) {
    let mu = if chance(random, 0.3) { power(random, -6.0, 6.0) } else { 1.0 };
    let ratio = match random.index(4) {
        0 => 0.0,
        1 => power(random, 1.0, 6.0),
        _ => random.between(0.2, 5.0),
    };
    problem.material = NeoHookean { mu, kappa: ratio * mu }.into();
}

fn elements(random: &mut Random, problem: &mut Problem) {
    let count = random.index(11);
    let nodes = problem.mesh.nodes.len();
    let mut contractions = Vec::new();
    for k in 0..count {
        let mut routing = vec![random.index(nodes)];
        let most = 1 + random.index(5);
        for _ in 0..1 + random.index(most) {
            let last = routing[routing.len() - 1];
            routing.push((last + 1 + random.index(nodes - 1)) % nodes);
        }
        let length = scenes::rest_length(problem, &routing);
        let stiffness = problem.material.value("mu")
            * if chance(random, 0.3) { power(random, -3.0, 9.0) } else { random.between(0.0, 5.0) };
        let epsilon = length * if chance(random, 0.3) { power(random, -9.0, -1.0) } else { 1e-2 };
        let alpha0 = length * if chance(random, 0.2) { random.between(0.1, 2.0) } else { 1.0 };
        contractions
            .push(alpha0 * if chance(random, 0.2) { random.between(-1.0, 1.3) } else { random.between(0.0, 0.4) });
        let winch = if chance(random, 0.3) { random.index(3) as i64 } else { k as i64 + 10 };
        problem.elements.push(ElementData { routing, stiffness, epsilon, alpha0, winch });
    }
    problem.contractions = Some(contractions);
}

fn pins(random: &mut Random, problem: &mut Problem) {
    for _ in 0..random.index(6) {
        let node = random.index(problem.mesh.nodes.len());
        let mut target = problem.mesh.nodes[node];
        if chance(random, 0.2) {
            let far = power(random, -3.0, 0.5);
            target = target.map(|v| v + random.between(-far, far));
        }
        let ratio = match random.index(4) {
            0 => power(random, -3.0, 12.0),
            1 => 0.0,
            _ => 1e3,
        };
        problem.pins.push(PinData { node, target, stiffness: ratio * problem.material.value("mu") });
    }
}

fn weight(random: &mut Random, problem: &mut Problem) {
    let direction = random.direction();
    problem.gravity = Some(direction.map(|d| 9.81 * d));
    problem.surface_density = Some(problem.material.value("mu") * power(random, -6.0, -0.5) / 9.81);
}

/// A state to start from: the body a little bent, or no body at all.
fn start(random: &mut Random, problem: &mut Problem) {
    let wild = chance(random, 0.3);
    let amount = if wild { 3.0 } else { 0.1 };
    let mut shake = || random.between(-amount, amount);
    problem.start = Some(problem.mesh.nodes.iter().map(|p| [p[0] + shake(), p[1] + shake()]).collect());
}

fn objective(random: &mut Random, problem: &mut Problem) {
    let far = if chance(random, 0.2) { power(random, 0.0, 6.0) } else { 0.3 };
    let count = 1 + random.index(4);
    let targets = (0..count).map(|_| {
        let node = random.index(problem.mesh.nodes.len());
        let xy = problem.mesh.nodes[node].map(|v| v + random.between(-far, far));
        TargetData { node, xy, weight: if chance(random, 0.1) { 0.0 } else { random.between(0.1, 2.0) } }
    });
    let targets: Vec<TargetData> = targets.collect();
    let default_weight = if chance(random, 0.2) { 0.0 } else { power(random, -6.0, -2.0) };
    let regulariser = if chance(random, 0.5) { 0.0 } else { power(random, -6.0, -1.0) };
    let home: Vec<[f64; 2]> = targets.iter().map(|t| t.xy).collect();
    problem.objective = Some(ObjectiveData { targets, default_weight, regulariser });
    let Ok(winches) = problem.free_winches() else { return };
    // These take a hundred times longer than statics.
    if chance(random, 0.08) {
        let bound = |random: &mut Random| chance(random, 0.8).then(|| random.between(0.1, 0.8));
        let upper: Vec<Option<f64>> = winches.iter().map(|_| bound(random)).collect();
        let lower = winches.iter().map(|_| bound(random).map(|b| -b)).collect();
        problem.soft_ik =
            Some(SoftIkData { beta_upper: Some(upper), beta_lower: Some(lower), ..SoftIkData::default() });
    }
    if chance(random, 0.08) {
        let frames: Vec<Vec<[f64; 2]>> = (0..2 + random.index(5))
            .map(|_| home.iter().map(|p| p.map(|v| v + random.between(-far, far))).collect())
            .collect();
        let report = (0..frames.len()).collect();
        let weight = power(random, -6.0, -2.0) / (problem.material.value("mu") * problem.material.value("mu"));
        problem.drag = Some(DragData { frames, report, tension_regulariser: weight });
    }
}

/// Another size, another place.
fn place(random: &mut Random, problem: &mut Problem) {
    let scale = power(random, -6.0, 3.0);
    let far = scale * power(random, 0.0, 5.0);
    let offset = [random.between(-far, far), random.between(-far, far)];
    *problem = scenes::placed(std::mem::take(problem), scale, offset);
}

/// Breaks a problem in one of the ways that a file can be broken.
fn damage(random: &mut Random, problem: &mut Problem) -> &'static str {
    let nodes = problem.mesh.nodes.len();
    match random.index(10) {
        0 => {
            problem.mesh.triangles[0].swap(0, 1);
            "a clockwise triangle"
        }
        1 => {
            problem.mesh.triangles[0][1] = nodes;
            "a node out of range"
        }
        2 => {
            let mu = problem.material.value("mu");
            problem.material.set("mu", -mu);
            "mu below zero"
        }
        3 => {
            problem.mesh.nodes[0][0] = f64::NAN;
            "a coordinate that is no number"
        }
        4 => {
            let t = problem.mesh.triangles[0];
            problem.mesh.triangles[0] = [t[0], t[0], t[1]];
            "a triangle without area"
        }
        5 => {
            problem.contractions = Some(vec![0.0; problem.elements.len() + 1]);
            "one contraction too many"
        }
        6 => {
            problem.pins.push(PinData { node: nodes + 3, target: [0.0; 2], stiffness: 1.0 });
            "a pin on no node"
        }
        7 => {
            problem.material.set("kappa", f64::MAX);
            "kappa without measure"
        }
        8 => {
            let data = ElementData { routing: vec![0, 0], stiffness: 1.0, epsilon: 0.1, alpha0: 1.0, winch: 99 };
            problem.elements.push(data);
            problem.contractions.get_or_insert_default().push(0.0);
            problem.soft_ik = None;
            "a node twice in a row"
        }
        _ => {
            problem.start = Some(vec![[0.0; 2]; nodes + 1]);
            "a start of another body"
        }
    }
}
