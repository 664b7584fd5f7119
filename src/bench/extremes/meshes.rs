//! Rows of meshes: slivers, sizes, places, the smallest and the largest.

use super::materials::{decades, diagonal_case};
use super::row::{Case, Row};
use super::scenes::{arm, bar, bent_arm, body, fiber, fibers_on_all_edges, pin, placed, square, weigh};
use crate::problem::Problem;

const GROUP: &str = "mesh";

pub fn rows(short: bool) -> Vec<Row> {
    vec![slivers(short), scaled(short), shifted(short), smallest(short), largest(short), numbers()]
}

/// A bar with a sliver of this angle, degrees: a node of its upper side comes down onto the one below it.
fn with_sliver(degrees: f64, contracted: bool) -> Problem {
    // The middle of the arm's lower left cell gets a fan of triangles; its centre moves towards the lower side.
    let mut problem = arm();
    let centre = problem.mesh.nodes.len();
    let height = (1.0 / 12.0) * degrees.to_radians().tan();
    problem.mesh.nodes.push([0.25, height]);
    let [a, b, c, d] = [1, 2, 9, 8];
    problem.mesh.triangles.retain(|t| !t.iter().all(|n| [a, b, c, d].contains(n)));
    problem.mesh.triangles.extend([[a, b, centre], [b, c, centre], [c, d, centre], [d, a, centre]]);
    if contracted {
        for i in 14..20 {
            fiber(&mut problem, &[i, i + 1], 0.3);
        }
        fiber(&mut problem, &[1, centre], 0.2);
        problem
    } else {
        weigh(problem, 0.02)
    }
}

fn slivers(short: bool) -> Row {
    let angles: &[f64] = if short { &[1.0, 0.01] } else { &[10.0, 1.0, 0.3, 0.1, 0.03, 0.01] };
    let mut cases: Vec<Case> =
        angles.iter().map(|&a| Case::solved(format!("{a}, fibres"), with_sliver(a, true))).collect();
    cases.extend(angles.iter().map(|&a| Case::solved(format!("{a}, gravity"), with_sliver(a, false))));
    Row { group: GROUP, name: "slivers", swept: "smallest angle, degrees", cases }
}

fn scaled(short: bool) -> Row {
    let mut cases = Vec::new();
    for scale in decades(-6, 3, short) {
        let at = |what: &str| format!("{scale:e}, {what}");
        cases.push(Case::solved(at("bent arm"), placed(bent_arm(0.3), scale, [0.0; 2])));
        cases.push(Case::solved(at("gravity"), placed(weigh(arm(), 0.02), scale, [0.0; 2])));
    }
    // Units of force may be anything too.
    for modulus in if short { vec![1e-9] } else { vec![1e-9, 1e-3, 1e3, 1e9] } {
        let mut problem = bent_arm(0.3);
        problem.material.each_mut().for_each(|(_, values)| values[0] *= modulus);
        problem.elements.iter_mut().for_each(|e| e.stiffness *= modulus);
        problem.pins.iter_mut().for_each(|p| p.stiffness *= modulus);
        cases.push(Case::solved(format!("1, mu = {modulus:e} N/m"), problem));
    }
    Row { group: GROUP, name: "size of the body", swept: "length, m", cases }
}

fn shifted(short: bool) -> Row {
    let mut cases = Vec::new();
    for distance in decades(0, 6, short) {
        let there = [0.6 * distance, -0.8 * distance];
        cases.push(Case::solved(format!("{distance:e}, bent arm"), placed(bent_arm(0.3), 1.0, there)));
        cases.push(Case::solved(format!("{distance:e}, gravity"), placed(weigh(arm(), 0.02), 1.0, there)));
    }
    Row { group: GROUP, name: "distance from the origin", swept: "body lengths", cases }
}

fn smallest(short: bool) -> Row {
    let mut cases = Vec::new();
    for part in if short { vec![0.5] } else { vec![0.01, 0.1, 0.5, 1.0] } {
        let mut problem = square();
        fiber(&mut problem, &[0, 2], part);
        cases.push(diagonal_case(format!("two triangles, {part}"), problem));
        let mut problem = body(vec![[0.0, 0.0], [1.0, 0.0], [0.3, 0.8]], vec![[0, 1, 2]]);
        fiber(&mut problem, &[0, 1], part);
        cases.push(Case::solved(format!("one triangle, {part}"), problem));
    }
    Row { group: GROUP, name: "smallest bodies", swept: "body, contraction", cases }
}

/// About this many edges, each with a fibre.
fn fibers(count: usize) -> Case {
    // A bar of c x c/4 cells has about 3 c^2/4 edges.
    let columns = ((count as f64) * 4.0 / 3.0).sqrt() as usize;
    let rows = (columns / 4).max(1);
    let mut problem = bar(1.0, 0.25, columns, rows);
    for j in 0..=rows {
        pin(&mut problem, j * (columns + 1), 1e3);
    }
    fibers_on_all_edges(&mut problem, -0.02);
    // The upper third pulls.
    let edge = 1.0 / columns as f64;
    let (nodes, elements) = (&problem.mesh.nodes, &problem.elements);
    let pull = |e: &crate::problem::file::ElementData| {
        if e.routing.iter().all(|&n| nodes[n][1] > 0.17) { 0.2 * e.alpha0.min(edge) } else { -0.02 * edge }
    };
    problem.contractions = Some(elements.iter().map(pull).collect());
    let count = problem.elements.len();
    Case::solved(format!("{count} fibres"), problem)
}

fn largest(short: bool) -> Row {
    let counts: &[usize] = if short { &[1000] } else { &[1000, 10_000, 100_000] };
    Row { group: GROUP, name: "many fibres", swept: "fibres", cases: counts.iter().map(|&n| fibers(n)).collect() }
}

/// Numbers at the ends of what a file can hold.
fn numbers() -> Row {
    let tiny = f64::from_bits(1);
    let mut subnormal = bent_arm(0.3);
    subnormal.mesh.nodes[0] = [tiny, -tiny];
    subnormal.pins[0].target = [-tiny, tiny];
    let mut offset = bent_arm(0.3);
    offset.pins[0].target = [f64::MAX, 0.0];
    let mut stiff = bent_arm(0.3);
    stiff.elements[2].stiffness = f64::MAX;
    let mut sharp = bent_arm(0.3);
    sharp.elements[2].epsilon = f64::MIN_POSITIVE;
    let mut infinite = bent_arm(0.3);
    infinite.mesh.nodes[3] = [f64::INFINITY, 0.0];
    let at = |scale: f64| placed(bent_arm(0.3), scale, [0.0; 2]);
    let cases = vec![
        Case::solved("a subnormal coordinate", subnormal),
        Case::solved("a body of 1e-80 m", at(1e-80)),
        Case::solved("a body of 1e80 m", at(1e80)),
        Case::refused("a body of 1e-300 m", at(1e-300), "mesh.nodes: the body is"),
        Case::refused("a body of 1e300 m", at(1e300), "mesh.nodes: the body is"),
        Case::refused("a subnormal body", at(1e-310), "mesh.nodes: the body is"),
        Case::refused("a pin at the end of the world", offset, "pins[0].target: is"),
        Case::refused("a stiffness of 1.8e308", stiff, "elements[2].K: is"),
        Case::refused("an epsilon of 2e-308", sharp, "elements[2].epsilon: is"),
        Case::refused("an infinite coordinate", infinite, "mesh.nodes[3]"),
    ];
    Row { group: GROUP, name: "ends of the number range", swept: "figure", cases }
}
