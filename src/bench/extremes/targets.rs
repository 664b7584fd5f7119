//! Rows of targets: far away and back, in conflict, more than can be met. The tracker that follows a hand answers them.

use super::materials::decades;
use super::row::{Case, Row};
use super::scenes::{aim, arm, fiber, fibers_on_all_edges};
use crate::problem::Problem;
use crate::problem::file::{DragData, SoftIkData};

const GROUP: &str = "targets";
/// Fibres contract by at most this part of their length.
const MOST: f64 = 0.6;
/// Weight of squared tension in SI units: `1e-4/mu^2`, the tool's.
const TENSION_WEIGHT: f64 = 1e-4;

pub fn rows(short: bool) -> Vec<Row> {
    vec![away_and_back(short), conflicting(short), too_many(short)]
}

/// The arm with a fibre on every edge, which may take in and pay out.
fn muscles(targets: &[usize]) -> Problem {
    let mut problem = arm();
    // Just slack at rest.
    fibers_on_all_edges(&mut problem, 0.0);
    problem.elements.iter_mut().for_each(|e| e.alpha0 += e.epsilon);
    aim(&mut problem, targets);
    bounded(problem)
}

fn bounded(mut problem: Problem) -> Problem {
    let upper: Vec<Option<f64>> = problem.elements.iter().map(|e| Some(MOST * e.alpha0)).collect();
    let lower = upper.iter().map(|u| u.map(|u| -u)).collect();
    problem.contractions = None;
    problem.soft_ik = Some(SoftIkData { beta_upper: Some(upper), beta_lower: Some(lower), ..SoftIkData::default() });
    problem
}

/// Two winches instead: tendons along both sides.
fn cables(targets: &[usize]) -> Problem {
    let mut problem = arm();
    fiber(&mut problem, &[0, 2, 4, 6], 0.0);
    fiber(&mut problem, &[14, 16, 18, 20], 0.0);
    aim(&mut problem, targets);
    bounded(problem)
}

/// The targets move by each of these offsets in turn (a list a frame, an offset a target); every frame is reported.
fn dragged(mut problem: Problem, offsets: Vec<Vec<[f64; 2]>>) -> Problem {
    let targets = problem.objective.iter().flat_map(|o| &o.targets);
    let home: Vec<[f64; 2]> = targets.map(|t| problem.mesh.nodes[t.node]).collect();
    let frames: Vec<Vec<[f64; 2]>> =
        offsets.iter().map(|frame| home.iter().zip(frame).map(|(h, o)| [h[0] + o[0], h[1] + o[1]]).collect()).collect();
    let report = (0..frames.len()).collect();
    problem.drag = Some(DragData { frames, report, tension_regulariser: TENSION_WEIGHT });
    problem
}

/// Out to `distance` in a few frames, round about there, and home again.
fn excursion(distance: f64, targets: usize) -> Vec<Vec<[f64; 2]>> {
    let spot = |angle: f64, part: f64, k: usize| {
        let turned = angle + 2.1 * k as f64;
        [distance * part * turned.cos(), distance * part * turned.sin()]
    };
    let all = |angle: f64, part: f64| (0..targets).map(|k| spot(angle, part, k)).collect();
    let mut frames: Vec<Vec<[f64; 2]>> =
        vec![all(0.3, 0.1), all(0.5, 1.0), all(1.5, 1.0), all(3.0, 1.0), all(4.5, 0.5)];
    frames.extend((0..10).map(|_| vec![[0.0; 2]; targets]));
    frames
}

fn away_and_back(short: bool) -> Row {
    let mut cases = Vec::new();
    for distance in decades(0, 6, short) {
        let frames = excursion(distance, 1);
        cases.push(Case::posed(format!("{distance:e}, fibres"), dragged(muscles(&[20]), frames.clone()), 0.02));
        cases.push(Case::posed(format!("{distance:e}, cables"), dragged(cables(&[20]), frames), 0.02));
        let frames = excursion(distance, 2);
        cases.push(Case::posed(format!("{distance:e}, two targets"), dragged(muscles(&[20, 3]), frames), 0.02));
    }
    Row { group: GROUP, name: "away and back", swept: "distance, body lengths", cases }
}

fn conflicting(short: bool) -> Row {
    let mut cases = Vec::new();
    for distance in decades(0, 6, short) {
        // Neighbours pulled apart, and let go.
        let mut frames = vec![vec![[-distance, 0.0], [distance, 0.0]]; 5];
        frames.extend(vec![vec![[0.0; 2]; 2]; 8]);
        let apart = dragged(muscles(&[12, 13]), frames.clone());
        cases.push(Case::posed(format!("{distance:e}, neighbours apart"), apart, 0.02));
        // The same node twice, to both sides at once.
        let twice = dragged(muscles(&[13, 13]), frames);
        cases.push(Case::posed(format!("{distance:e}, one node two ways"), twice, 0.02));
    }
    Row { group: GROUP, name: "conflicting targets", swept: "distance, body lengths", cases }
}

fn too_many(short: bool) -> Row {
    let every: Vec<usize> = (0..21).collect();
    let mut cases = Vec::new();
    for distance in decades(0, 4, short) {
        let wave = |k: usize, part: f64| [part * distance * (k as f64).sin(), part * distance * (2.3 * k as f64).cos()];
        let away: Vec<[f64; 2]> = (0..every.len()).map(|k| wave(k, 1.0)).collect();
        let mut frames = vec![away; 4];
        frames.extend(vec![vec![[0.0; 2]; every.len()]; 8]);
        cases.push(Case::posed(
            format!("{distance:e}, all nodes, fibres"),
            dragged(muscles(&every), frames.clone()),
            0.02,
        ));
        cases.push(Case::posed(format!("{distance:e}, all nodes, two winches"), dragged(cables(&every), frames), 0.02));
    }
    Row { group: GROUP, name: "more targets than freedoms", swept: "distance, body lengths", cases }
}
