//! Answering a problem: statics, derivatives, Soft IK, drag.

use super::document::{Document, DragAnswer, ReportedFrame, SoftIkAnswer};
use super::equilibrium::settle;
use super::error::ProblemError;
use super::failure::{Failure, Part};
use super::file::{DragData, Problem};
use super::frame::Frame;
use super::model::{contractions, take_model};
use crate::physics::{Cause, Model};
use crate::soft_ik::{
    self, Actuation, Budget, Objective, PointTarget, Quality, Question, Tracker, Winch, default_method, newton,
    sensitivity,
};
use serde_json::Value;
use std::collections::BTreeMap;
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

/// The answer document as a tree of values, for those who look at it key by key.
#[derive(Clone, Debug)]
pub struct Answered {
    pub document: Value,
    pub converged: bool,
    /// Why not; `error` of the document in typed form.
    pub failures: Vec<Failure>,
}

/// Iterations of a Soft IK method on a `soft_ik` question.
const SOFT_IK_ITERATIONS: usize = 300;

/// [`answer`] as a tree of values.
///
/// # Errors
/// As [`answer`].
pub fn solve(problem: &Problem, options: &Options) -> Result<Answered, ProblemError> {
    let document = answer(problem, options)?;
    // Text keys and finite numbers: nothing that a tree of values could not hold.
    let tree = serde_json::to_value(&document).unwrap_or_default();
    Ok(Answered { document: tree, converged: document.converged, failures: document.failures })
}

/// Answers everything the problem asks for. The problem is solved in the frame of its own body and answered in its own units.
///
/// # Errors
/// [`ProblemError`] where no model can be made. What does not converge is no error: the document says so.
pub fn answer(problem: &Problem, options: &Options) -> Result<Document, ProblemError> {
    let deadline = Instant::now() + options.budget;
    let stop = || Instant::now() >= deadline;
    let frame = Frame::of(problem);
    let mut inner = frame.inside(problem);
    let model = take_model(&mut inner)?;
    let mut work = Work {
        inner: &inner,
        frame: &frame,
        model,
        options,
        stop: &stop,
        out: Document::default(),
        failures: Vec::new(),
    };
    let drag_only = problem.drag.is_some() && !options.all;
    if !drag_only {
        work.statics()?;
        if let (Some(_), Some(objective)) = (&inner.soft_ik, objective(&inner)) {
            work.soft_ik(&objective)?;
        }
    }
    if let (Some(drag), Some(objective)) = (&inner.drag, objective(&inner)) {
        work.drag(drag, objective)?;
    }
    Ok(work.out.concluded(work.failures))
}

/// What the parts of an answer share.
struct Work<'a> {
    /// The problem in its frame; `model` is of this one.
    inner: &'a Problem,
    frame: &'a Frame,
    model: Model,
    options: &'a Options,
    stop: &'a dyn Fn() -> bool,
    out: Document,
    failures: Vec<Failure>,
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
    let mut members: BTreeMap<i64, Vec<(usize, f64)>> = BTreeMap::new();
    for (e, element) in problem.elements.iter().enumerate() {
        members.entry(element.winch).or_default().push((e, 1.0));
    }
    let winches = ids.iter().enumerate().map(|(j, id)| Winch {
        members: members.remove(id).unwrap_or_default(),
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

impl Work<'_> {
    fn statics(&mut self) -> Result<(), ProblemError> {
        let (state, x) = settle(self.inner, self.frame, &mut self.model, self.stop);
        let out = &mut self.out;
        out.x = Some(state.x);
        out.energy = Some(state.energy);
        out.tensions = Some(state.tensions);
        out.pin_forces = Some(state.pin_forces);
        out.residual = Some(state.residual);
        out.iterations = Some(state.iterations);
        let in_equilibrium = state.failure.is_none();
        self.failures.extend(state.failure);
        if let Some(objective) = objective(self.inner) {
            let contractions = contractions(self.inner);
            let all = actuation(self.inner, &self.inner.all_winches(), contractions.clone());
            let mut question = Question { model: &mut self.model, actuation: &all, objective: &objective };
            let value = question.objective_at(&x, &contractions) * self.frame.objective();
            out.objective = Some(value);
            if (self.stop)() {
                if in_equilibrium {
                    self.failures.push(Failure::TimeBudget { part: Part::Statics });
                }
            } else if let Some(gradient) = sensitivity::gradient(&mut question, &x, &contractions) {
                // dO/dalpha_c: units of O over units of length.
                let scaled = |list: &[f64]| list.iter().map(|g| g * self.frame.length).collect::<Vec<f64>>();
                out.grad_alpha_c = Some(scaled(&gradient.by_contraction));
                out.grad_beta = Some(scaled(&gradient.by_activation));
            } else {
                self.failures.push(Failure::Unstable);
            }
        }
        Ok(())
    }

    fn soft_ik(&mut self, objective: &Objective) -> Result<(), ProblemError> {
        let Some(data) = &self.inner.soft_ik else { return Ok(()) };
        let (options, stop) = (self.options, self.stop);
        let actuation = free_actuation(self.inner)?;
        let beta_start = data.beta_start.clone().unwrap_or_else(|| vec![0.0; actuation.winches.len()]);
        let method = soft_ik::method(&options.method).ok_or_else(|| {
            let known = soft_ik::METHODS.join(", ");
            ProblemError::Method(format!("\"{}\" is unknown, choose one of {known}", options.method))
        })?;
        if options.method == "tension" && !actuation.is_fibers_only() {
            return Err(ProblemError::Method("tension needs winches of one element each".into()));
        }
        let clock = Instant::now();
        let mut question = Question { model: &mut self.model, actuation: &actuation, objective };
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
        let milliseconds = clock.elapsed().as_secs_f64() * 1e3;
        let posture = answer.posture;
        let in_time = !stop();
        let scale = self.frame.objective();
        let contractions = actuation.contractions(&posture.beta);
        question.model.contractile.set_contractions(&contractions);
        let gradient = sensitivity::gradient(&mut question, &posture.x, &contractions);
        let projected = gradient.map(|g| newton::projected_gradient(&question, &posture.beta, &g.by_activation));
        let minimal = projected.is_some_and(|p| newton::is_small(&question, p, posture.objective));
        let tolerance = newton::TOLERANCE * posture.objective * scale;
        if !posture.in_equilibrium() || (!in_time && !minimal) {
            self.failures.push(self.unbalanced(Part::SoftIk, &posture.x, in_time));
        } else if !minimal {
            self.failures.push(match projected {
                None => Failure::Unstable,
                Some(p) => Failure::NotMinimal { part: Part::SoftIk, projected: p * scale, tolerance },
            });
        }
        let (length, frame) = (self.frame.length, self.frame);
        let lengths = |list: &[f64]| list.iter().map(|v| v * length).collect::<Vec<f64>>();
        self.out.soft_ik = Some(SoftIkAnswer {
            alpha_c: lengths(&contractions),
            beta: lengths(&posture.beta),
            converged: posture.in_equilibrium() && minimal,
            factorizations: answer.factorizations,
            iterations: answer.iterations,
            milliseconds,
            minimises: method.objective(),
            objective: posture.objective * scale,
            projected_gradient: projected.map(|p| p * scale),
            starts: answer.starts,
            tolerance,
            x: frame.points(&posture.x),
        });
        Ok(())
    }

    fn drag(&mut self, drag: &DragData, mut objective: Objective) -> Result<(), ProblemError> {
        let (options, stop, frame) = (self.options, self.stop, self.frame);
        objective.contraction_weight = 0.0;
        objective.tension_weight = drag.tension_regulariser;
        let actuation = free_actuation(self.inner)?;
        let mut beta = vec![0.0; actuation.winches.len()];
        actuation.clamp(&mut beta);
        let rest = self.model.rest.clone();
        let mut question = Question { model: &mut self.model, actuation: &actuation, objective: &objective };
        let (start, _) = question.settle(&beta, &rest, stop);
        let mut out = DragAnswer::default();
        // Once the time is up, nothing more is begun.
        let mut tracker = (!stop()).then(|| Tracker::within(&mut question, &start, stop));
        if tracker.is_none() {
            self.failures.push(Failure::TimeBudget { part: Part::Frame(0) });
        }
        for (k, goals) in drag.frames.iter().enumerate() {
            let Some(tracker) = &mut tracker else { break };
            for (target, goal) in objective.targets.iter_mut().zip(goals) {
                target.goal = *goal;
            }
            let clock = Instant::now();
            let mut question = Question { model: &mut self.model, actuation: &actuation, objective: &objective };
            let answer = tracker.frame(&mut question, options.quality, stop);
            out.milliseconds.push(clock.elapsed().as_secs_f64() * 1e3);
            let posture = tracker.posture();
            out.target_error.push(objective.target_error(&posture.x) * frame.length);
            out.iterations.push(answer.iterations);
            let out_of_time = stop();
            if !posture.in_equilibrium() {
                self.failures.push(self.unbalanced(Part::Frame(k), &posture.x, !out_of_time));
            } else if out_of_time && k + 1 < drag.frames.len() {
                self.failures.push(Failure::TimeBudget { part: Part::After(k) });
            }
            if drag.report.contains(&k) {
                let alpha_c: Vec<f64> =
                    actuation.contractions(&posture.beta).iter().map(|c| c * frame.length).collect();
                out.reported.push(ReportedFrame {
                    alpha_c,
                    frame: k,
                    residual: posture.residual * frame.force(),
                    x: frame.points(&posture.x),
                });
            }
            if out_of_time {
                break;
            }
        }
        self.out.drag = Some(out);
        Ok(())
    }

    /// Why a posture at `x` is not in equilibrium.
    fn unbalanced(&self, part: Part, x: &[f64], in_time: bool) -> Failure {
        if !in_time {
            return Failure::TimeBudget { part };
        }
        let (mut gradient, mut scale) = (vec![0.0; x.len()], vec![0.0; x.len()]);
        self.model.gradient(x, &mut gradient);
        self.model.force_scale_into(x, &mut scale);
        let away = self.model.is_pulled_away(&gradient, &scale);
        Failure::of(part, if away { Cause::FreeToMove } else { Cause::Stalled }, &self.model)
    }
}
