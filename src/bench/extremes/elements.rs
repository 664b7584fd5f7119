//! Rows of contractile elements: stiffness, smoothing, contraction, routing.

use super::materials::{decades, diagonal_case};
use super::row::{Case, Row};
use super::scenes::{arm, bent_arm, fiber, fibers_on_all_edges, horseshoe, square, with_elements};
use crate::problem::Problem;

const GROUP: &str = "elements";

pub fn rows(short: bool) -> Vec<Row> {
    vec![
        stiffness(short),
        smoothing(short),
        both(short),
        contraction(short),
        slack(short),
        folded(short),
        degenerate(),
        gap(short),
    ]
}

/// The square with a fibre on its diagonal.
fn square_with_fiber(part: f64) -> Problem {
    let mut problem = square();
    fiber(&mut problem, &[0, 2], part);
    problem
}

/// A tendon along the lower side of the arm and back through its middle.
fn arm_with_tendon(part: f64) -> Problem {
    let mut problem = arm();
    fiber(&mut problem, &[0, 2, 4, 6], part);
    fiber(&mut problem, &[14, 9, 18, 20], 0.5 * part);
    problem
}

fn stiffness(short: bool) -> Row {
    let stiff = |problem: Problem, k: f64| with_elements(problem, |e| e.stiffness = k);
    let mut cases = Vec::new();
    for k in decades(0, 9, short) {
        cases.push(diagonal_case(format!("{k:e}, square"), stiff(square_with_fiber(0.3), k)));
        cases.push(Case::solved(format!("{k:e}, bent arm"), stiff(bent_arm(0.3), k)));
        cases.push(Case::solved(format!("{k:e}, tendons"), stiff(arm_with_tendon(0.3), k)));
    }
    Row { group: GROUP, name: "stiffness", swept: "K/mu", cases }
}

fn smoothing(short: bool) -> Row {
    let mut cases = Vec::new();
    for part in decades(-9, -1, short) {
        let with = |problem| with_elements(problem, |e| e.epsilon = part * e.alpha0);
        cases.push(diagonal_case(format!("{part:e}, square"), with(square_with_fiber(0.3))));
        cases.push(Case::solved(format!("{part:e}, bent arm"), with(bent_arm(0.3))));
        // At rest, right at the kink.
        cases.push(Case::solved(format!("{part:e}, all just taut"), with(all_edges(0.0))));
    }
    Row { group: GROUP, name: "width of the smooth zone", swept: "epsilon / edge", cases }
}

fn both(short: bool) -> Row {
    let mut cases = Vec::new();
    for exponent in if short { vec![9] } else { vec![3, 6, 9] } {
        let (k, part) = (10f64.powi(exponent), 10f64.powi(-exponent));
        let with = |problem| {
            with_elements(problem, |e| {
                e.stiffness = k;
                e.epsilon = part * e.alpha0;
            })
        };
        cases.push(diagonal_case(format!("1e{exponent}, square"), with(square_with_fiber(0.3))));
        cases.push(Case::solved(format!("1e{exponent}, bent arm"), with(bent_arm(0.3))));
        cases.push(Case::solved(format!("1e{exponent}, tendons"), with(arm_with_tendon(0.3))));
    }
    Row { group: GROUP, name: "stiff and sharp", swept: "K/mu = edge/epsilon", cases }
}

fn all_edges(part: f64) -> Problem {
    let mut problem = arm();
    fibers_on_all_edges(&mut problem, part);
    problem
}

fn contraction(short: bool) -> Row {
    let parts: &[f64] = if short { &[0.5, 1.0] } else { &[0.1, 0.3, 0.5, 0.7, 0.9, 0.99, 1.0] };
    let mut cases = Vec::new();
    for &part in parts {
        let percent = (100.0 * part).round();
        cases.push(diagonal_case(format!("{percent} % of one, square"), square_with_fiber(part)));
        let mut one = arm();
        fiber(&mut one, &[2, 3], part);
        cases.push(Case::solved(format!("{percent} % of one"), one));
        cases.push(Case::solved(format!("{percent} % of many"), bent_arm(part)));
        cases.push(Case::solved(format!("{percent} % of all"), all_edges(part)));
        let stiff = with_elements(all_edges(part), |e| e.stiffness = 100.0);
        cases.push(Case::solved(format!("{percent} % of all, K = 100 mu"), stiff));
        cases.push(Case::solved(format!("{percent} % of tendons"), arm_with_tendon(part)));
    }
    Row { group: GROUP, name: "contraction", swept: "part of the length", cases }
}

fn slack(short: bool) -> Row {
    let parts: &[f64] = if short { &[-1.0] } else { &[-0.02, -1.0, -1e3] };
    let case = |part: &f64| {
        let problem = all_edges(*part);
        let size = super::measure::size(&problem);
        let rest = problem.mesh.nodes.clone();
        Case::solved(format!("{part}"), problem).exact(move |answer| {
            let off = answer.x.iter().zip(&rest).map(|(p, q)| (p[0] - q[0]).hypot(p[1] - q[1]));
            off.fold(0.0, f64::max) / size
        })
    };
    Row {
        group: GROUP,
        name: "slack everywhere",
        swept: "contraction / length",
        cases: parts.iter().map(case).collect(),
    }
}

/// Routings that run to and fro, and through a node several times.
fn folded(short: bool) -> Row {
    let routings: [(&str, &[usize]); 4] = [
        ("there and back", &[0, 6, 0]),
        ("to and fro nine times", &[0, 6, 0, 6, 0, 6, 0, 6, 0, 6]),
        ("round a triangle three times", &[8, 9, 2, 8, 9, 2, 8, 9, 2, 8]),
        ("a loop through one node", &[7, 10, 3, 10, 17, 10, 13]),
    ];
    let count = if short { 2 } else { routings.len() };
    let case = |(name, routing): &(&str, &[usize])| {
        let mut problem = arm();
        fiber(&mut problem, routing, 0.2);
        Case::solved(name, problem)
    };
    Row {
        group: GROUP,
        name: "routing folds back",
        swept: "routing",
        cases: routings[..count].iter().map(case).collect(),
    }
}

/// Segments without a length or a direction.
fn degenerate() -> Row {
    let with = |routing: &[usize]| {
        let mut problem = arm();
        fiber(&mut problem, &[0, 6], 0.1);
        problem.elements[0].routing = routing.to_vec();
        problem
    };
    // Two nodes in one place: a patch sewn on, held by its own pins.
    let mut doubled = arm();
    let first = doubled.mesh.nodes.len();
    doubled.mesh.nodes.extend([[1.0, 0.0], [2.0, 0.0], [2.0, 0.4]]);
    doubled.mesh.triangles.push([first, first + 1, first + 2]);
    (first + 1..first + 3).for_each(|n| super::scenes::pin(&mut doubled, n, 1e3));
    fiber(&mut doubled, &[0, 6, first], 0.1);
    let mut sewn = doubled.clone();
    // Nothing but the seam: its rest length cannot be zero, so it is given one.
    sewn.elements[0].routing = vec![6, first];
    sewn.elements[0].alpha0 = 0.1;
    sewn.contractions = Some(vec![0.2]);
    let cases = vec![
        Case::refused("a node twice in a row", with(&[0, 3, 3, 6]), "elements[0].routing[2]: node 3 twice in a row"),
        Case::refused("one node alone", with(&[3]), "elements[0].routing: needs at least two nodes"),
        Case::solved("a segment of length zero between two pieces", doubled),
        Case::solved("a seam pulled to a point", sewn),
    ];
    Row { group: GROUP, name: "degenerate segments", swept: "routing", cases }
}

/// An element across the gap of a horseshoe, whose tips it pulls together until they meet.
fn gap(short: bool) -> Row {
    let parts: &[f64] = if short { &[1.0] } else { &[0.3, 0.7, 0.9, 1.0, 1.2] };
    let mut cases = Vec::new();
    for &part in parts {
        for k in [1.0, 1e3] {
            let mut problem = horseshoe();
            fiber(&mut problem, &[17, 18], part);
            problem.elements[0].stiffness = k;
            cases.push(Case::solved(format!("{part}, K = {k} mu"), problem));
        }
    }
    Row { group: GROUP, name: "element across a concave gap", swept: "contraction / length", cases }
}
