//! Bodies for the rows: small problems in SI units, built up step by step.

use crate::physics::NeoHookean;
use crate::problem::Problem;
use crate::problem::file::{ElementData, MeshData, ObjectiveData, PinData, TargetData};

/// Shear modulus of every scene unless a row sweeps it, N/m.
pub const MU: f64 = 1.0;
/// `kappa` likewise: 1.5 `mu`, the default of the tool.
pub const KAPPA: f64 = 1.5;
/// Stiffness of fibres, N/m.
pub const FIBER: f64 = 1.0;
/// Half-width of the smooth zone of fibres, as a part of their length.
pub const EPSILON: f64 = 1e-2;
/// Stiffness of pins, N/m.
pub const PIN: f64 = 1e3;

/// Two triangles: the unit square, cut along the diagonal 0-2.
pub fn square() -> Problem {
    body(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], vec![[0, 1, 2], [0, 2, 3]])
}

/// A `length` x `height` bar of `columns` x `rows` cells of two triangles, the diagonals alternating. Node `(i, j)` is
/// `j (columns + 1) + i`.
pub fn bar(length: f64, height: f64, columns: usize, rows: usize) -> Problem {
    let at = |i: usize, j: usize| j * (columns + 1) + i;
    let (mut nodes, mut triangles) = (Vec::new(), Vec::new());
    for j in 0..=rows {
        for i in 0..=columns {
            nodes.push([length * i as f64 / columns as f64, height * j as f64 / rows as f64]);
        }
    }
    for j in 0..rows {
        for i in 0..columns {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let pair = if (i + j) % 2 == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
            triangles.extend(pair);
        }
    }
    body(nodes, triangles)
}

/// The usual small bar: 6 x 2 cells of 1/6 m, held at its left end.
pub fn arm() -> Problem {
    let mut arm = bar(1.0, 1.0 / 3.0, 6, 2);
    for j in 0..3 {
        pin(&mut arm, 7 * j, PIN);
    }
    arm
}

/// The arm with fibres along its upper side, which bend it up when they contract by `part` of their length.
pub fn bent_arm(part: f64) -> Problem {
    let mut arm = arm();
    for i in 14..20 {
        fiber(&mut arm, &[i, i + 1], part);
    }
    arm
}

/// A `U`: two legs one cell wide with a gap of one cell between them; its feet are pinned. Nodes 17 and 18 are the inner
/// corners of the tips.
pub fn horseshoe() -> Problem {
    let grid = bar(3.0, 4.0, 3, 4);
    let keep = |t: &[usize; 3]| {
        let centre: [f64; 2] = [0, 1].map(|axis| t.iter().map(|&n| grid.mesh.nodes[n][axis]).sum::<f64>() / 3.0);
        !(centre[0] > 1.0 && centre[0] < 2.0 && centre[1] > 1.0)
    };
    let triangles = grid.mesh.triangles.iter().copied().filter(keep).collect();
    let mut shoe = body(grid.mesh.nodes.clone(), triangles);
    for i in 0..4 {
        pin(&mut shoe, i, PIN);
    }
    shoe
}

/// A problem with this mesh and the usual material, all contractions zero.
pub fn body(nodes: Vec<[f64; 2]>, triangles: Vec<[usize; 3]>) -> Problem {
    Problem {
        mesh: MeshData { nodes, triangles },
        material: NeoHookean { mu: MU, kappa: KAPPA }.into(),
        contractions: Some(Vec::new()),
        ..Problem::default()
    }
}

/// Length of a routing at rest.
pub fn rest_length(problem: &Problem, routing: &[usize]) -> f64 {
    let nodes = &problem.mesh.nodes;
    routing.windows(2).map(|s| (nodes[s[1]][0] - nodes[s[0]][0]).hypot(nodes[s[1]][1] - nodes[s[0]][1])).sum()
}

/// Adds an element that is contracted by `part` of its length; on a winch of its own.
pub fn fiber(problem: &mut Problem, routing: &[usize], part: f64) {
    let length = rest_length(problem, routing);
    let winch = problem.elements.len() as i64;
    let data =
        ElementData { routing: routing.to_vec(), stiffness: FIBER, epsilon: EPSILON * length, alpha0: length, winch };
    problem.elements.push(data);
    problem.contractions.get_or_insert_default().push(part * length);
}

/// A fibre on every edge of the mesh.
pub fn fibers_on_all_edges(problem: &mut Problem, part: f64) {
    let sides = |t: &[usize; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    let mut edges: Vec<[usize; 2]> = problem.mesh.triangles.iter().flat_map(sides).collect();
    edges.iter_mut().for_each(|e| e.sort_unstable());
    edges.sort_unstable();
    edges.dedup();
    edges.iter().for_each(|e| fiber(problem, e, part));
}

/// Changes every element.
pub fn with_elements(mut problem: Problem, change: impl Fn(&mut ElementData)) -> Problem {
    problem.elements.iter_mut().for_each(change);
    problem
}

/// Pins a node where it is at rest.
pub fn pin(problem: &mut Problem, node: usize, stiffness: f64) {
    let target = problem.mesh.nodes[node];
    problem.pins.push(PinData { node, target, stiffness });
}

/// Weight downwards: `part` is that of the whole body over `mu` times its length.
pub fn weigh(mut problem: Problem, part: f64) -> Problem {
    let size = super::measure::size(&problem);
    let area: f64 = problem.mesh.triangles.iter().map(|t| problem.mesh.area(t)).sum();
    problem.gravity = Some([0.0, -10.0]);
    problem.surface_density = Some(part * problem.material.value("mu") * size / (10.0 * area));
    problem
}

/// Total weight, N.
pub fn weight(problem: &Problem) -> f64 {
    let area: f64 = problem.mesh.triangles.iter().map(|t| problem.mesh.area(t)).sum();
    area * problem.surface_density.unwrap_or(0.0) * problem.gravity.map_or(0.0, |g| -g[1])
}

/// Targets at rest, without any weight towards rest elsewhere but a little.
pub fn aim(problem: &mut Problem, nodes: &[usize]) {
    let targets = nodes.iter().map(|&node| TargetData { node, xy: problem.mesh.nodes[node], weight: 1.0 });
    problem.objective = Some(ObjectiveData { targets: targets.collect(), default_weight: 1e-4, regulariser: 0.0 });
}

/// Everything in other units of length, at another place.
pub fn placed(mut problem: Problem, scale: f64, offset: [f64; 2]) -> Problem {
    let point = |p: &mut [f64; 2]| *p = [scale * p[0] + offset[0], scale * p[1] + offset[1]];
    problem.mesh.nodes.iter_mut().for_each(point);
    problem.start.iter_mut().flatten().for_each(point);
    problem.pins.iter_mut().for_each(|p| point(&mut p.target));
    for e in &mut problem.elements {
        e.epsilon *= scale;
        e.alpha0 *= scale;
    }
    problem.contractions.iter_mut().flatten().for_each(|c| *c *= scale);
    if let Some(density) = &mut problem.surface_density {
        *density /= scale;
    }
    if let Some(objective) = &mut problem.objective {
        objective.targets.iter_mut().for_each(|t| point(&mut t.xy));
        objective.regulariser *= scale * scale;
    }
    if let Some(ik) = &mut problem.soft_ik {
        for list in [&mut ik.beta_upper, &mut ik.beta_lower] {
            list.iter_mut().flatten().flatten().for_each(|v| *v *= scale);
        }
    }
    if let Some(drag) = &mut problem.drag {
        drag.frames.iter_mut().flatten().for_each(point);
    }
    problem
}
