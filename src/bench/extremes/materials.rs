//! Rows of the material and of large deformations.

use super::closed::{Diagonal, affine, affine_error, hold_affine};
use super::row::{Case, Row};
use super::scenes::{MU, arm, bar, bent_arm, fiber, square};
use crate::problem::Problem;

const GROUP: &str = "material";

pub fn rows(short: bool) -> Vec<Row> {
    vec![
        incompressible_square(short),
        incompressible_arm(short),
        compressed(short),
        stretched(short),
        sheared(short),
        inverted(short),
    ]
}

/// Every decade, or the ends and the middle of a shortened table.
pub fn decades(from: i32, to: i32, short: bool) -> Vec<f64> {
    let all = from..=to;
    let kept = move |e: &i32| !short || *e == from || *e == to || *e == (from + to) / 2;
    all.filter(kept).map(|e| 10f64.powi(e)).collect()
}

/// A case whose exact answer is that of the square with an element on its diagonal.
pub fn diagonal_case(at: impl ToString, problem: Problem) -> Case {
    let closed = Diagonal::of(&problem);
    let case = Case::solved(at, problem);
    match closed {
        Some(closed) => case.exact(move |answer| closed.error(answer)),
        None => case,
    }
}

fn incompressible_square(short: bool) -> Row {
    let case = |ratio: f64| {
        let mut problem = square();
        fiber(&mut problem, &[0, 2], 0.3);
        problem.material.set("kappa", ratio * MU);
        diagonal_case(format!("{ratio:e}"), problem)
    };
    let cases = decades(0, 6, short).into_iter().map(case).collect();
    Row { group: GROUP, name: "nearly incompressible, two triangles", swept: "kappa/mu", cases }
}

fn incompressible_arm(short: bool) -> Row {
    let case = |ratio: f64| {
        let mut problem = bent_arm(0.3);
        problem.material.set("kappa", ratio * MU);
        Case::solved(format!("{ratio:e}"), problem)
    };
    let cases = decades(0, 6, short).into_iter().map(case).collect();
    Row { group: GROUP, name: "nearly incompressible, bent arm", swept: "kappa/mu", cases }
}

/// A patch held at its boundary: the deformation is homogeneous, whatever the mesh.
fn patch(f: [[f64; 2]; 2], at: String) -> Case {
    let mut problem = bar(1.0, 1.0, 4, 4);
    // Inner nodes off the grid, so that no symmetry helps.
    for (k, n) in [6, 7, 8, 11, 12, 13, 16, 17, 18].into_iter().enumerate() {
        problem.mesh.nodes[n][0] += 0.06 * (k as f64 * 1.7).sin();
        problem.mesh.nodes[n][1] += 0.06 * (k as f64 * 2.3).cos();
    }
    hold_affine(&mut problem, f, 1e3);
    let exact = affine_error(&problem, f);
    Case::solved(at, problem).exact(exact)
}

fn compressed(short: bool) -> Row {
    let parts: &[f64] = if short { &[0.5, 0.1] } else { &[0.9, 0.7, 0.5, 0.3, 0.2, 0.1] };
    let mut cases: Vec<Case> = parts.iter().map(|&s| patch([[s, 0.0], [0.0, 1.0]], format!("{s} along x"))).collect();
    cases.extend(parts.iter().map(|&s| patch([[s, 0.0], [0.0, s]], format!("{s} both ways"))));
    cases.extend(parts.iter().map(|&s| pressed_arm(s)));
    Row { group: GROUP, name: "compression", swept: "stretch", cases }
}

fn stretched(short: bool) -> Row {
    let parts: &[f64] = if short { &[2.0, 10.0] } else { &[1.5, 2.0, 4.0, 7.0, 10.0] };
    let mut cases: Vec<Case> = parts.iter().map(|&s| patch([[s, 0.0], [0.0, 1.0]], format!("{s} along x"))).collect();
    cases.extend(parts.iter().map(|&s| pressed_arm(s)));
    Row { group: GROUP, name: "stretch", swept: "stretch", cases }
}

/// The arm between two clamps whose distance becomes `part` of its length; the rest is free.
fn pressed_arm(part: f64) -> Case {
    let mut problem = arm();
    for j in 0..3 {
        let node = 7 * j + 6;
        super::scenes::pin(&mut problem, node, 1e3);
        if let Some(last) = problem.pins.last_mut() {
            last.target[0] *= part;
        }
    }
    Case::solved(format!("{part}, arm between clamps"), problem)
}

fn sheared(short: bool) -> Row {
    let amounts: &[f64] = if short { &[10.0] } else { &[1.0, 3.0, 10.0] };
    let cases = amounts.iter().map(|&s| patch([[1.0, s], [0.0, 1.0]], format!("{s}"))).collect();
    Row { group: GROUP, name: "simple shear", swept: "shear", cases }
}

/// Starting guesses that no body can be in.
fn inverted(short: bool) -> Row {
    let f = [[0.8, 0.3], [0.0, 1.2]];
    let start = |name: &str, place: fn(usize, [f64; 2]) -> [f64; 2]| {
        let mut case = patch(f, name.into());
        let nodes = &case.problem.mesh.nodes;
        case.problem.start = Some(nodes.iter().enumerate().map(|(i, p)| place(i, *p)).collect());
        case
    };
    let mut cases = vec![
        start("mirrored", |_, p| [-p[0], p[1]]),
        start("all in one point", |_, _| [0.5, 0.5]),
        start("scattered", |i, _| [(i as f64 * 12.9898).sin() * 3.0, (i as f64 * 78.233).cos() * 3.0]),
    ];
    if !short {
        cases.push(start("turned by half a turn", |_, p| affine([[-1.0, 0.0], [0.0, -1.0]], p)));
        cases.push(start("one node outside", |i, p| if i == 12 { [7.0, 7.0] } else { p }));
        cases.push(start("a billion times too large", |_, p| [1e9 * p[0], 1e9 * p[1]]));
    }
    Row { group: GROUP, name: "impossible starting guess", swept: "start", cases }
}
