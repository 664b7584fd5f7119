//! Answering a problem: statics, derivatives, Soft IK, drag.

use super::file::{Problem, ProblemError};
use crate::physics::{
    Body, Cause, Contractile, Element, Energy, Gravity, Model, ModelError, NeoHookean, Pin, Pins, StaticsSettings,
    statics,
};
use crate::soft_ik::{
    self, Actuation, Budget, Objective, PointTarget, Quality, Question, Tracker, Winch, default_method, sensitivity,
};
use serde_json::{Map, Value, json};
use std::time::{Duration, Instant};

/// How a problem is to be answered.
#[derive(Clone, Debug)]
pub struct Options {
    /// One of [`soft_ik::METHODS`].
    pub method: String,
    pub quality: Quality,
    /// Statics and `soft_ik` too where the file has a `drag`.
    pub all: bool,
    /// Time for the whole answer; the factorisation under way is finished.
    pub budget: Duration,
}

impl Default for Options {
    fn default() -> Self {
        Self { method: "default".into(), quality: Quality::Balanced, all: false, budget: Duration::from_secs(10) }
    }
}

/// The answer document and whether everything asked for converged.
#[derive(Clone, Debug)]
pub struct Answered {
    pub document: Value,
    pub converged: bool,
}

/// Iterations of a Soft IK method on a `soft_ik` question.
const SOFT_IK_ITERATIONS: usize = 300;

/// Answers everything the problem asks for.
pub fn solve(problem: &Problem, options: &Options) -> Result<Answered, ProblemError> {
    let deadline = Instant::now() + options.budget;
    let stop = || Instant::now() >= deadline;
    let mut model = model(problem)?;
    let mut out = Map::new();
    out.insert("format".into(), "plushwright-answer/1".into());
    let mut errors: Vec<String> = Vec::new();
    let drag_only = problem.drag.is_some() && !options.all;
    if !drag_only {
        answer_statics(problem, &mut model, &mut out, &mut errors, &stop)?;
        if problem.soft_ik.is_some() && problem.objective.is_some() {
            answer_soft_ik(problem, &mut model, options, &mut out, &mut errors, &stop)?;
        }
    }
    if problem.drag.is_some() {
        answer_drag(problem, &mut model, options, &mut out, &mut errors, &stop)?;
    }
    let converged = errors.is_empty();
    out.insert("converged".into(), converged.into());
    if !converged {
        out.insert("error".into(), errors.join("; ").into());
    }
    Ok(Answered { document: Value::Object(out), converged })
}

/// The physics model of a problem, at its `contractions` (zero if absent).
pub fn model(problem: &Problem) -> Result<Model, ProblemError> {
    let material = NeoHookean { mu: problem.material.mu, kappa: problem.material.kappa };
    let content = |key: String, what: &str| ProblemError::Content { key, what: what.into() };
    let body = Body::new(&problem.mesh.nodes, &problem.mesh.triangles, Box::new(material), None)
        .map_err(|k| content(format!("mesh.triangles[{k}]"), "has no area"))?;
    let elements = problem.elements.iter().map(|e| Element {
        routing: e.routing.clone(),
        stiffness: e.stiffness,
        epsilon: e.epsilon,
        alpha0: e.alpha0,
    });
    let contractile = Contractile::new(elements.collect());
    let pins = Pins { pins: problem.pins.iter().map(|p| Pin::node(p.node, p.target, p.stiffness)).collect() };
    let mut terms: Vec<Box<dyn Energy>> = Vec::new();
    if let (Some(acceleration), Some(density)) = (problem.gravity, problem.surface_density) {
        terms.push(Box::new(Gravity::new(&body.nodal_areas(problem.mesh.nodes.len()), density, acceleration)));
    }
    let mut model = Model::new(&problem.mesh.nodes, body, contractile, pins, terms).map_err(|e| match e {
        ModelError::Triangle(k) => content(format!("mesh.triangles[{k}]"), "has no area"),
        ModelError::Memory => content("mesh".into(), "is too large for the memory of this machine"),
    })?;
    model.contractile.set_contractions(&contractions(problem));
    Ok(model)
}

fn contractions(problem: &Problem) -> Vec<f64> {
    problem.contractions.clone().unwrap_or_else(|| vec![0.0; problem.elements.len()])
}

fn objective(problem: &Problem) -> Option<Objective> {
    let data = problem.objective.as_ref()?;
    let mut rest_weights = vec![data.default_weight; problem.mesh.nodes.len()];
    let targets = data.targets.iter().map(|t| {
        rest_weights[t.node] = 0.0;
        PointTarget { nodes: vec![t.node], weights: vec![1.0], goal: t.xy, weight: t.weight }
    });
    let targets = targets.collect();
    Some(Objective {
        targets,
        rest_weights,
        rest: problem.mesh.nodes.iter().flatten().copied().collect(),
        contraction_weight: data.regulariser,
        tension_weight: 0.0,
    })
}

fn actuation(problem: &Problem, ids: &[i64], fixed: Vec<f64>) -> Actuation {
    let ik = problem.soft_ik.as_ref();
    let bound = |list: Option<&Vec<Option<f64>>>, j: usize| list.and_then(|l| l.get(j).copied().flatten());
    let winches = ids.iter().enumerate().map(|(j, id)| Winch {
        members: (0..problem.elements.len()).filter(|e| problem.elements[*e].winch == *id).map(|e| (e, 1.0)).collect(),
        lower: bound(ik.and_then(|s| s.beta_lower.as_ref()), j).unwrap_or(f64::NEG_INFINITY),
        upper: bound(ik.and_then(|s| s.beta_upper.as_ref()), j).unwrap_or(f64::INFINITY),
    });
    Actuation { winches: winches.collect(), fixed }
}

/// The free winches of `soft_ik` (all winches without one); others stay at their fixed activation.
fn free_actuation(problem: &Problem) -> Result<Actuation, ProblemError> {
    let fixed_winches = problem.fixed_winches()?;
    let fixed = problem.elements.iter().map(|e| fixed_winches.get(&e.winch).copied().unwrap_or(0.0)).collect();
    Ok(actuation(problem, &problem.free_winches()?, fixed))
}

fn points(x: &[f64]) -> Value {
    x.chunks_exact(2).map(|p| json!([p[0], p[1]])).collect()
}

fn answer_statics(
    problem: &Problem,
    model: &mut Model,
    out: &mut Map<String, Value>,
    errors: &mut Vec<String>,
    stop: &dyn Fn() -> bool,
) -> Result<(), ProblemError> {
    let start: Vec<f64> = problem.start.as_ref().unwrap_or(&problem.mesh.nodes).iter().flatten().copied().collect();
    let state = match statics::solve(model, &start, &StaticsSettings::default(), stop) {
        Ok(state) => state,
        Err(error) => {
            errors.push(format!("statics: {}", named(error.cause, model)));
            error.best
        }
    };
    out.insert("x".into(), points(&state.x));
    out.insert("energy".into(), json!(state.energy));
    out.insert("tensions".into(), json!(model.contractile.tensions(&state.x)));
    out.insert("pin_forces".into(), model.pins.pins.iter().map(|p| json!(p.force(&state.x))).collect());
    out.insert("residual".into(), json!(state.residual));
    out.insert("iterations".into(), json!(state.iterations));
    if let Some(objective) = objective(problem) {
        let contractions = contractions(problem);
        let all = actuation(problem, &problem.all_winches(), contractions.clone());
        let mut question = Question { model, actuation: &all, objective: &objective };
        out.insert("objective".into(), json!(question.objective_at(&state.x, &contractions)));
        if let Some(gradient) = sensitivity::gradient(&mut question, &state.x, &contractions) {
            out.insert("grad_alpha_c".into(), json!(gradient.by_contraction));
            out.insert("grad_beta".into(), json!(gradient.by_activation));
        } else {
            errors.push("the equilibrium is not stable: it has no sensitivities".into());
        }
    }
    Ok(())
}

fn named(cause: Cause, model: &Model) -> String {
    if model.free_pieces() > 0 && cause != Cause::FreeToMove {
        format!("{cause} (the body is free to move: add a pin)")
    } else {
        cause.to_string()
    }
}

fn answer_soft_ik(
    problem: &Problem,
    model: &mut Model,
    options: &Options,
    out: &mut Map<String, Value>,
    errors: &mut Vec<String>,
    stop: &dyn Fn() -> bool,
) -> Result<(), ProblemError> {
    let (Some(objective), Some(data)) = (objective(problem), &problem.soft_ik) else { return Ok(()) };
    let actuation = free_actuation(problem)?;
    let beta_start = data.beta_start.clone().unwrap_or_else(|| vec![0.0; actuation.winches.len()]);
    let method = soft_ik::method(&options.method).ok_or_else(|| ProblemError::Content {
        key: "--method".into(),
        what: format!("\"{}\" is unknown, choose one of {}", options.method, soft_ik::METHODS.join(", ")),
    })?;
    if options.method == "tension" && !actuation.is_fibers_only() {
        let what = "tension needs winches of one element each".into();
        return Err(ProblemError::Content { key: "--method".into(), what });
    }
    let clock = Instant::now();
    let mut question = Question { model, actuation: &actuation, objective: &objective };
    let budget = Budget { iterations: SOFT_IK_ITERATIONS, stop };
    let answer = if options.method == "default" {
        default_method::solve(&mut question, &beta_start, &budget)
    } else {
        let mut beta = beta_start;
        actuation.clamp(&mut beta);
        let rest = question.model.rest.clone();
        let (start, factorizations) = question.settle(&beta, &rest, stop);
        let mut answer = method.solve(&mut question, &start, &budget);
        answer.factorizations += factorizations;
        answer
    };
    if !answer.posture.in_equilibrium {
        errors.push("soft_ik: no equilibrium was found".into());
    } else if stop() && !answer.converged {
        errors.push("soft_ik: the time budget ended the search".into());
    }
    let posture = answer.posture;
    out.insert(
        "soft_ik".into(),
        json!({
            "beta": posture.beta,
            "alpha_c": actuation.contractions(&posture.beta),
            "x": points(&posture.x),
            "objective": posture.objective,
            "iterations": answer.iterations,
            "factorizations": answer.factorizations,
            "milliseconds": clock.elapsed().as_secs_f64() * 1e3,
        }),
    );
    Ok(())
}

fn answer_drag(
    problem: &Problem,
    model: &mut Model,
    options: &Options,
    out: &mut Map<String, Value>,
    errors: &mut Vec<String>,
    stop: &dyn Fn() -> bool,
) -> Result<(), ProblemError> {
    let (Some(mut objective), Some(drag)) = (objective(problem), &problem.drag) else { return Ok(()) };
    objective.contraction_weight = 0.0;
    objective.tension_weight = drag.tension_regulariser;
    let actuation = free_actuation(problem)?;
    let mut beta = vec![0.0; actuation.winches.len()];
    actuation.clamp(&mut beta);
    let rest = model.rest.clone();
    let mut question = Question { model, actuation: &actuation, objective: &objective };
    let (start, _) = question.settle(&beta, &rest, stop);
    let mut tracker = Tracker::new(&mut question, &start);
    let (mut milliseconds, mut target_error, mut iterations, mut reported) = (vec![], vec![], vec![], vec![]);
    for (k, frame) in drag.frames.iter().enumerate() {
        for (target, goal) in objective.targets.iter_mut().zip(frame) {
            target.goal = *goal;
        }
        let clock = Instant::now();
        let mut question = Question { model, actuation: &actuation, objective: &objective };
        let answer = tracker.frame(&mut question, options.quality, stop);
        milliseconds.push(clock.elapsed().as_secs_f64() * 1e3);
        let posture = tracker.posture();
        target_error.push(objective.target_error(&posture.x));
        iterations.push(answer.iterations);
        if !posture.in_equilibrium {
            errors.push(format!("drag: frame {k} is not in equilibrium"));
        }
        if drag.report.contains(&k) {
            reported.push(json!({
                "frame": k,
                "x": points(&posture.x),
                "alpha_c": actuation.contractions(&posture.beta),
                "residual": posture.residual,
            }));
        }
        if stop() {
            errors.push(format!("drag: the time budget ended after frame {k}"));
            break;
        }
    }
    out.insert(
        "drag".into(),
        json!({
            "milliseconds": milliseconds,
            "target_error": target_error,
            "iterations": iterations,
            "reported": reported,
        }),
    );
    Ok(())
}
