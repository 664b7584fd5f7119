//! Runs a case through the same door as a file: written, read, checked, solved.

use super::reference;
use super::row::{Bar, Case, Outcome};
use crate::physics::statics::norm;
use crate::problem::{self, Options, Problem, Quality, Statics, model};
use serde_json::Value;
use std::time::{Duration, Instant};

/// Bodies of up to this many nodes get a reference of twice the digits.
const REFERENCE_NODES: usize = 64;
/// Time for one case.
const BUDGET: Duration = Duration::from_secs(120);

/// Runs a case.
pub fn run(case: &Case, stop: &dyn Fn() -> bool) -> Outcome {
    let clock = Instant::now();
    let mut outcome = match through_the_file(&case.problem) {
        Err(reason) => Outcome { failure: Some(reason), ..Outcome::default() },
        Ok(problem) => match case.bar {
            Bar::Posed { .. } => posed(&problem),
            _ if problem.drag.is_some() || problem.soft_ik.is_some() => posed(&problem),
            _ => solved(case, &problem, stop),
        },
    };
    outcome.milliseconds = clock.elapsed().as_secs_f64() * 1e3;
    outcome
}

/// The problem after a round trip through the text of a file, or why it is refused.
fn through_the_file(problem: &Problem) -> Result<Problem, String> {
    let text = problem.to_text().map_err(|e| e.to_string())?;
    problem::read(&text).map(|(problem, _)| problem).map_err(|e| e.to_string())
}

fn solved(case: &Case, problem: &Problem, stop: &dyn Fn() -> bool) -> Outcome {
    let state = match problem::equilibrium(problem, stop) {
        Ok(state) => state,
        Err(error) => return Outcome { failure: Some(error.to_string()), ..Outcome::default() },
    };
    let mut outcome = Outcome {
        iterations: state.iterations,
        factorizations: state.factorizations,
        projections: state.projections,
        determinant: state.smallest_determinant,
        residual: state.residual / state.force_scale.max(f64::MIN_POSITIVE),
        failure: state.failure.as_ref().map(|f| f.to_string()),
        unsound: unsound(&state),
        ..Outcome::default()
    };
    if outcome.failure.is_some() {
        return outcome;
    }
    let size = size(problem);
    let (rigid, pieces) = rigid_motions(problem);
    // Loose pieces that hang together by slack cables have no one answer.
    if problem.mesh.nodes.len() <= REFERENCE_NODES && (rigid == 0 || pieces == 1) {
        if let Some(reference) = reference::near(problem, &state.x, rigid) {
            let error = if rigid > 0 {
                shape_error(problem, &state.x, &reference.x)
            } else {
                largest_distance(&state.x, &reference.x)
            };
            outcome.error = Some(error / size);
            // Coordinates far from the origin have fewer digits to give.
            let far = problem.mesh.nodes.iter().flatten().fold(0.0, |m: f64, v| m.max(v.abs())) / size;
            outcome.condition = Some(reference.condition * far.max(1.0));
        } else {
            outcome.unsound = Some("the reference found no equilibrium nearby".into());
        }
    }
    if let Some(exact) = &case.exact {
        let error = exact(&state);
        outcome.error = Some(outcome.error.map_or(error, |e| e.max(error)));
    }
    outcome
}

/// Soft IK and drags: every pose that is shown, judged by the forces at its own contractions.
fn posed(problem: &Problem) -> Outcome {
    let options = Options { quality: Quality::Balanced, budget: BUDGET, ..Options::default() };
    let answered = match problem::solve(problem, &options) {
        Ok(answered) => answered,
        Err(error) => return Outcome { failure: Some(error.to_string()), ..Outcome::default() },
    };
    let document = &answered.document;
    let mut outcome = Outcome {
        determinant: f64::INFINITY,
        failure: (!answered.converged).then(|| document["error"].as_str().unwrap_or("no reason").to_owned()),
        ..Outcome::default()
    };
    let mut poses: Vec<&Value> = document["drag"]["reported"].as_array().into_iter().flatten().collect();
    poses.extend(document.get("soft_ik"));
    if poses.is_empty() && answered.converged {
        outcome.unsound = Some("nothing was reported".into());
    }
    for pose in poses {
        if let Err(what) = judge_pose(problem, pose, &mut outcome) {
            outcome.unsound = Some(what);
        }
    }
    let iterations = document["drag"]["iterations"].as_array().into_iter().flatten().filter_map(Value::as_u64).max();
    outcome.iterations = iterations.unwrap_or(0) as usize;
    outcome.factorizations = document["soft_ik"]["factorizations"].as_u64().unwrap_or(0) as usize;
    let last = document["drag"]["target_error"].as_array().and_then(|errors| errors.last()).and_then(Value::as_f64);
    outcome.target_error = last.map(|e| e / size(problem));
    outcome
}

fn judge_pose(problem: &Problem, pose: &Value, outcome: &mut Outcome) -> Result<(), String> {
    let missing = |what: &str| format!("{what} is missing or not a list of numbers");
    let x: Vec<f64> = numbers(&pose["x"]).ok_or_else(|| missing("x"))?;
    let contractions = numbers(&pose["alpha_c"]).ok_or_else(|| missing("alpha_c"))?;
    let held = Problem { contractions: Some(contractions), ..problem.clone() };
    let model = model(&held).map_err(|e| e.to_string())?;
    let mut gradient = vec![0.0; x.len()];
    model.gradient(&x, &mut gradient);
    let residual = norm(&gradient) / model.force_scale(&x).max(f64::MIN_POSITIVE);
    outcome.residual = outcome.residual.max(residual);
    outcome.determinant = outcome.determinant.min(model.body.smallest_determinant(&x));
    Ok(())
}

/// All numbers of nested lists; `None` where anything else stands.
fn numbers(value: &Value) -> Option<Vec<f64>> {
    match value {
        Value::Number(n) => n.as_f64().map(|v| vec![v]),
        Value::Array(items) => {
            let parts: Option<Vec<Vec<f64>>> = items.iter().map(numbers).collect();
            parts.map(|p| p.concat())
        }
        _ => None,
    }
}

fn unsound(state: &Statics) -> Option<String> {
    let points = [("x", &state.x), ("pin_forces", &state.pin_forces)];
    for (name, list) in points {
        if let Some(k) = list.iter().position(|p| !(p[0].is_finite() && p[1].is_finite())) {
            return Some(format!("{name}[{k}] is not finite"));
        }
    }
    if let Some(k) = state.tensions.iter().position(|t| !t.is_finite()) {
        return Some(format!("tensions[{k}] is not finite"));
    }
    let scalars = [("energy", state.energy), ("residual", state.residual)];
    scalars.into_iter().find(|(_, v)| !v.is_finite()).map(|(name, _)| format!("{name} is not finite"))
}

/// Free rigid motions, 3 for a piece without a pin and 1 about a single one; and the number of pieces.
fn rigid_motions(problem: &Problem) -> (usize, usize) {
    let motions =
        |m: crate::physics::Model| (m.loose().iter().map(|l| if l.pinned == 0 { 3 } else { 1 }).sum(), m.pieces());
    model(problem).map_or((0, 1), motions)
}

/// Longer side of the rest shape's box, m.
pub fn size(problem: &Problem) -> f64 {
    let spread = |axis: usize| {
        let values = problem.mesh.nodes.iter().map(|p| p[axis]);
        values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
    };
    spread(0).max(spread(1)).max(f64::MIN_POSITIVE)
}

fn distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    (p[0] - q[0]).hypot(p[1] - q[1])
}

fn largest_distance(x: &[[f64; 2]], y: &[[f64; 2]]) -> f64 {
    x.iter().zip(y).map(|(p, q)| distance(*p, *q)).fold(0.0, f64::max)
}

/// Largest difference of an edge's length: what a free rigid motion leaves as it is.
fn shape_error(problem: &Problem, x: &[[f64; 2]], y: &[[f64; 2]]) -> f64 {
    let edges = problem.mesh.triangles.iter().flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]]);
    edges.map(|[i, j]| (distance(x[i], x[j]) - distance(y[i], y[j])).abs()).fold(0.0, f64::max)
}
