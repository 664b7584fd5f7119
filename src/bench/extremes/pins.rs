//! Rows of what holds a body: pins from none to rigid, pieces, weight.

use super::closed::{affine_error, hold_affine};
use super::materials::decades;
use super::measure::size;
use super::row::{Case, Row};
use super::scenes::{arm, bar, bent_arm, fiber, fibers_on_all_edges, pin, weigh, weight};
use crate::problem::{Problem, Statics};

const GROUP: &str = "pins";

pub fn rows(short: bool) -> Vec<Row> {
    vec![stiff(short), apart(), one(short), none(), all(short), pieces(), hanging(short)]
}

fn with_pins(mut problem: Problem, stiffness: f64) -> Problem {
    problem.pins.iter_mut().for_each(|p| p.stiffness = stiffness * problem.material.value("mu"));
    problem
}

fn stiff(short: bool) -> Row {
    let mut cases = Vec::new();
    for k in decades(0, 16, short) {
        cases.push(Case::solved(format!("{k:e}, bent arm"), with_pins(bent_arm(0.3), k)));
        let hung = with_pins(weigh(arm(), 0.02), k);
        let exact = lifts(&hung);
        cases.push(Case::solved(format!("{k:e}, gravity"), hung).exact(exact));
        let f = [[1.3, 0.2], [-0.1, 0.8]];
        let mut patch = bar(1.0, 1.0, 3, 3);
        hold_affine(&mut patch, f, k);
        let exact = affine_error(&patch, f);
        cases.push(Case::solved(format!("{k:e}, homogeneous"), patch).exact(exact));
    }
    Row { group: GROUP, name: "stiff pins", swept: "K/mu", cases }
}

/// Pins carry exactly the weight: the relative error of their sum.
fn lifts(problem: &Problem) -> impl Fn(&Statics) -> f64 + 'static {
    let weight = weight(problem);
    move |answer| {
        let sum = |axis: usize| answer.pin_forces.iter().map(|f| f[axis]).sum::<f64>();
        ((sum(1) - weight).abs().max(sum(0).abs())) / weight
    }
}

/// Rigid pins that pull their body apart or move it far in one go.
fn apart() -> Row {
    let moved = |name: &str, place: fn([f64; 2]) -> [f64; 2]| {
        let mut problem = arm();
        (0..3).for_each(|j| pin(&mut problem, 7 * j + 6, 1.0));
        let mut problem = with_pins(problem, 1e12);
        problem.pins.iter_mut().skip(3).for_each(|p| p.target = place(p.target));
        Case::solved(name, problem)
    };
    let cases = vec![
        moved("drawn to twice the length", |p| [2.0 * p[0], p[1]]),
        moved("pressed to a third", |p| [p[0] / 3.0, p[1]]),
        moved("turned by a right angle", |p| [0.5 - p[1], p[0]]),
        moved("turned over", |p| [2.0 - p[0], 1.0 / 3.0 - p[1]]),
    ];
    Row { group: GROUP, name: "rigid pins elsewhere", swept: "pins of 1e12 mu", cases }
}

fn one(short: bool) -> Row {
    let mut cases = Vec::new();
    for k in if short { vec![1e12] } else { vec![1.0, 1e3, 1e12] } {
        let mut bent = bent_arm(0.3);
        bent.pins.truncate(1);
        cases.push(Case::solved(format!("{k:e}, fibres"), with_pins(bent, k)));
        let mut hung = weigh(arm(), 0.02);
        hung.pins.truncate(1);
        let hung = with_pins(hung, k);
        let exact = lifts(&hung);
        cases.push(Case::solved(format!("{k:e}, gravity: it swings down"), hung).exact(exact));
    }
    Row { group: GROUP, name: "one pin", swept: "K/mu", cases }
}

fn none() -> Row {
    let free = |mut problem: Problem| {
        problem.pins.clear();
        problem
    };
    let mut soft = bent_arm(0.3);
    soft.pins.iter_mut().for_each(|p| p.stiffness = 0.0);
    let cases = vec![
        Case::solved("fibres", free(bent_arm(0.3))),
        Case::solved("nothing pulls", free(arm())),
        Case::solved("pins of stiffness zero", soft),
        Case::refused("gravity", free(weigh(arm(), 0.02)), "the body is free to move: add a pin"),
        Case::refused("a speck of gravity", free(weigh(arm(), 1e-6)), "the body is free to move: add a pin"),
    ];
    Row { group: GROUP, name: "no pin", swept: "what pulls", cases }
}

fn all(short: bool) -> Row {
    let case = |k: f64| {
        let mut problem = bent_arm(0.3);
        problem.pins.clear();
        (0..problem.mesh.nodes.len()).for_each(|n| pin(&mut problem, n, k));
        Case::solved(format!("{k:e}"), problem)
    };
    let cases = (if short { vec![1e12] } else { vec![1e-3, 1.0, 1e3, 1e6, 1e12] }).into_iter().map(case).collect();
    Row { group: GROUP, name: "all nodes pinned", swept: "K/mu", cases }
}

/// The bent arm and a second bar beside it, which is not pinned. Its smallest node is 21.
fn two_pieces() -> Problem {
    let mut problem = bent_arm(0.3);
    let other = bar(1.0, 1.0 / 3.0, 3, 1);
    let first = problem.mesh.nodes.len();
    problem.mesh.nodes.extend(other.mesh.nodes.iter().map(|p| [p[0], p[1] + 1.0]));
    problem.mesh.triangles.extend(other.mesh.triangles.iter().map(|t| t.map(|n| n + first)));
    problem
}

fn pieces() -> Row {
    let mut held = weigh(two_pieces(), 0.02);
    [21, 25].into_iter().for_each(|n| pin(&mut held, n, 1e3));
    let mut tied = two_pieces();
    fiber(&mut tied, &[20, 24], 0.1);
    fiber(&mut tied, &[17, 22], 0.1);
    let mut hung = weigh(two_pieces(), 0.01);
    hung.gravity = Some([0.0, 10.0]);
    fiber(&mut hung, &[20, 24], 0.1);
    fiber(&mut hung, &[14, 21], 0.1);
    let cases = vec![
        Case::solved("the second rests", two_pieces()),
        Case::refused("the second falls", weigh(two_pieces(), 0.02), "the piece with node 21 is not held"),
        Case::solved("the second has pins of its own", held),
        Case::solved("tied together by two fibres", tied),
        Case::solved("the second hangs on two fibres", hung),
    ];
    Row { group: GROUP, name: "a body in two pieces, one unpinned", swept: "what pulls", cases }
}

/// A bar that hangs from its end, up to many times its length in weight.
fn hanging(short: bool) -> Row {
    let parts: &[f64] = if short { &[1e-9, 0.1] } else { &[1e-15, 1e-9, 1e-6, 1e-3, 0.01, 0.1, 1.0] };
    let case = |&part: &f64| {
        let mut problem = weigh(arm(), part);
        problem.gravity = Some([10.0, 0.0]);
        let weight = part * size(&problem);
        let exact = move |answer: &Statics| {
            let sum = |axis: usize| answer.pin_forces.iter().map(|f| f[axis]).sum::<f64>();
            ((sum(0) + weight).abs().max(sum(1).abs())) / weight
        };
        Case::solved(format!("{part:e}"), problem).exact(exact)
    };
    let mut cases: Vec<Case> = parts.iter().map(case).collect();
    if !short {
        let mut busy = weigh(arm(), 0.3);
        fibers_on_all_edges(&mut busy, 0.3);
        cases.push(Case::solved("0.3 and every fibre contracted", busy));
    }
    Row { group: GROUP, name: "hanging bar", swept: "weight / (mu length)", cases }
}
