//! What must hold for every problem, sound or not.

use super::draw::Drawn;
use crate::physics::Model;
use crate::problem::{self, Answered, Failure, Options, Problem, Quality, model};
use serde_json::Value;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// Time for one problem, and by how much an answer may be late: a factorisation, on a busy machine.
const BUDGET: Duration = Duration::from_secs(5);
const LATE: Duration = Duration::from_secs(2);
/// Relative rounding of an energy that is compared with another.
const ENERGY_ROUNDING: f64 = 1e-9;
/// Relative rounding of a bound after a change of units.
const BOUND_ROUNDING: f64 = 1e-9;

/// How a problem ended, if nothing was wrong with that.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    Answered,
    Refused,
    FreeToMove,
    TimeBudget,
    Unstable,
    /// Soft IK ended above a minimum.
    NotMinimal,
    /// Statics, Soft IK or a frame without an equilibrium, with a typed cause.
    NoEquilibrium,
    Overflow,
}

impl End {
    pub const ALL: [Self; 8] = [
        Self::Answered,
        Self::Refused,
        Self::FreeToMove,
        Self::TimeBudget,
        Self::Unstable,
        Self::NotMinimal,
        Self::NoEquilibrium,
        Self::Overflow,
    ];

    pub fn name(self) -> &'static str {
        match self {
            Self::Answered => "answered",
            Self::Refused => "refused",
            Self::FreeToMove => "free to move",
            Self::TimeBudget => "time budget",
            Self::Unstable => "unstable equilibrium",
            Self::NotMinimal => "soft IK above a minimum",
            Self::NoEquilibrium => "no equilibrium",
            Self::Overflow => "overflow",
        }
    }
}

/// Runs a problem; what is wrong with what came out is the error.
///
/// # Errors
/// What was violated, in words.
pub fn problem(drawn: &Drawn) -> Result<End, String> {
    let clock = Instant::now();
    let run = catch_unwind(AssertUnwindSafe(|| run(drawn)));
    let end = run.map_err(|panic| format!("panic: {}", message(&panic)))??;
    if clock.elapsed() > BUDGET + LATE {
        return Err(format!("took {:.1} s", clock.elapsed().as_secs_f64()));
    }
    Ok(end)
}

fn message(panic: &Box<dyn std::any::Any + Send>) -> String {
    let text = panic.downcast_ref::<String>().cloned();
    text.or_else(|| panic.downcast_ref::<&str>().map(|s| (*s).to_owned())).unwrap_or_default()
}

fn run(drawn: &Drawn) -> Result<End, String> {
    let text = drawn.problem.to_text().map_err(|e| format!("cannot be written: {e}"))?;
    let problem = match (problem::read(&text), drawn.broken) {
        (Ok((problem, _)), None) => problem,
        (Ok(_), Some(what)) => return Err(format!("was not refused: {what}")),
        (Err(_), Some(_)) => return Ok(End::Refused),
        (Err(error), None) => return Err(format!("was refused: {error}")),
    };
    let options = Options { quality: Quality::Balanced, all: true, budget: BUDGET, ..Options::default() };
    let answered = problem::solve(&problem, &options).map_err(|e| format!("was refused late: {e}"))?;
    judge(&problem, &answered)?;
    Ok(end(&answered))
}

/// The gravest of the failures.
fn end(answered: &Answered) -> End {
    let kind = |failure: &Failure| match failure {
        Failure::Statics { .. } => End::NoEquilibrium,
        Failure::FreeToMove { .. } => End::FreeToMove,
        Failure::TimeBudget { .. } => End::TimeBudget,
        Failure::Unstable => End::Unstable,
        Failure::NotMinimal { .. } => End::NotMinimal,
        Failure::Overflow { .. } => End::Overflow,
    };
    answered.failures.iter().map(kind).max().unwrap_or(End::Answered)
}

fn judge(problem: &Problem, answered: &Answered) -> Result<(), String> {
    let document = &answered.document;
    if answered.converged != answered.failures.is_empty() {
        return Err("converged and failures contradict each other".into());
    }
    if answered.converged == document.get("error").is_some() {
        return Err("an error without a failure, or a failure without its text".into());
    }
    if let Some(place) = not_finite(document, "") {
        return Err(format!("{place} is not finite"));
    }
    let body = model(problem).map_err(|e| e.to_string())?;
    let mut poses = vec![("x", &document["x"])];
    if let Some(ik) = document.get("soft_ik") {
        poses.push(("soft_ik.x", &ik["x"]));
        within_bounds(problem, &ik["beta"])?;
    }
    for pose in document["drag"]["reported"].as_array().into_iter().flatten() {
        poses.push(("drag.reported.x", &pose["x"]));
    }
    for (name, value) in poses.into_iter().filter(|(_, v)| !v.is_null()) {
        let x = flat(value);
        let smallest = body.body.smallest_determinant(&x);
        if x.len() != body.dimension() || smallest.is_nan() || smallest <= 0.0 {
            return Err(format!("{name} is inverted: det F = {smallest:e}"));
        }
    }
    energy_falls(problem, &body, document)
}

/// Statics never end above the energy of a valid start.
fn energy_falls(problem: &Problem, model: &Model, document: &Value) -> Result<(), String> {
    let Some(reached) = document["energy"].as_f64() else { return Ok(()) };
    let given: Option<Vec<f64>> = problem.start.as_ref().map(|s| s.iter().flatten().copied().collect());
    let valid = |x: &Vec<f64>| model.energy(x).is_finite();
    let start = given.filter(valid).unwrap_or_else(|| model.rest.clone());
    let before = model.energy(&start);
    // Coordinates that are far from the origin, and springs that feel their rounding, leave this much to chance.
    let (mut at_work, mut rounding) = (vec![0.0; start.len()], vec![0.0; start.len()]);
    model.scales_into(&start, &mut at_work, &mut rounding);
    let jitter: f64 = rounding.iter().zip(&start).map(|(r, x)| 1e-9 * r * (1e-15 * x.abs())).sum();
    let size = crate::bench::extremes::measure::size(problem);
    // An energy of zero carries the rounding of a body at unit strain.
    let scale = before.abs().max(reached.abs())
        + (problem.material.value("mu") + problem.material.value("kappa")) * size * size * 1e-5;
    let weight = gravity_rounding(problem, &start);
    if reached > before + ENERGY_ROUNDING * scale + jitter + weight {
        return Err(format!("energy rose from {before:e} to {reached:e}"));
    }
    Ok(())
}

/// Rounding of the potential energy of a heavy body far from the origin.
fn gravity_rounding(problem: &Problem, start: &[f64]) -> f64 {
    let (Some(g), Some(density)) = (problem.gravity, problem.surface_density) else { return 0.0 };
    let farthest = start.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let size = crate::bench::extremes::measure::size(problem);
    1e-14 * density * size * size * g[0].hypot(g[1]) * farthest
}

fn within_bounds(problem: &Problem, beta: &Value) -> Result<(), String> {
    let Some(ik) = &problem.soft_ik else { return Ok(()) };
    for (j, value) in flat(beta).into_iter().enumerate() {
        let bound = |list: &Option<Vec<Option<f64>>>| list.as_ref().and_then(|l| l.get(j).copied().flatten());
        let upper = bound(&ik.beta_upper).unwrap_or(f64::INFINITY);
        let lower = bound(&ik.beta_lower).unwrap_or(f64::NEG_INFINITY);
        let room = BOUND_ROUNDING * value.abs();
        if value > upper + room || value < lower - room {
            return Err(format!("soft_ik.beta[{j}] = {value} is not within {lower} and {upper}"));
        }
    }
    Ok(())
}

/// All numbers of nested lists.
fn flat(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(items) => items.iter().flat_map(flat).collect(),
        other => other.as_f64().into_iter().collect(),
    }
}

/// Where a document holds a `null`, which is how JSON writes what is not finite.
fn not_finite(value: &Value, place: &str) -> Option<String> {
    match value {
        Value::Null => Some(place.to_owned()),
        Value::Array(items) => items.iter().enumerate().find_map(|(k, v)| not_finite(v, &format!("{place}[{k}]"))),
        Value::Object(map) => map.iter().find_map(|(key, v)| not_finite(v, &format!("{place}.{key}"))),
        _ => None,
    }
}
