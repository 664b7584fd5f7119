//! `soft_ik` questions on many fibres: the question's own `O`, from several starts.
//!
//! `O` has many valleys: an element that is slack feels nothing of the targets, so what is slack at the start tends to stay so. The
//! starts are the answer of the all-at-once method, in whose objective slack elements take part; the activations given; and all
//! elements just taut. Each is followed by Newton's method until it gains little, and the best one to the end.

use super::newton::Newton;
use super::tension::AllAtOnce;
use super::{Answer, Budget, Method, Posture, Question};

/// A start is explored until it gains less than this part of `O` in an iteration, some times in a row.
const EXPLORED: f64 = 1e-3;
const EXPLORING_ITERATIONS: usize = 80;
/// Where two starts end within this part of each other, no more are tried.
const SAME: f64 = 1e-3;
/// What is explored is followed to the end where it is at most this part above the best.
const HOPEFUL: f64 = 1e-2;
/// Steps of the all-at-once method that are worth taking towards a start, and what ends them earlier.
const FORMING_ITERATIONS: usize = 80;
const FORMING_STEP: f64 = 1e-5;

/// Where a search begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Start {
    /// The answer of the all-at-once method, its slack elements at rest.
    Tension,
    /// The activations given.
    Given,
    /// All elements just taut.
    Taut,
}

/// The best of several starts. Converged where the projected gradient of `O` is small.
pub(super) fn solve(question: &mut Question, start: &Posture, budget: &Budget) -> Answer {
    let mut best = Answer { starts: 0, ..Answer::at(start) };
    let mut ends: Vec<Answer> = Vec::new();
    for kind in [Start::Tension, Start::Given, Start::Taut] {
        if (budget.stop)() || (kind == Start::Tension && !question.actuation.is_fibers_only()) {
            continue;
        }
        let Some(from) = posture(question, kind, start, budget, &mut best) else { continue };
        best.starts += 1;
        let exploring = Budget { iterations: budget.iterations.min(EXPLORING_ITERATIONS), stop: budget.stop };
        let found = Newton { relative_decrease: EXPLORED }.solve(question, &from, &exploring);
        let value = found.posture.objective;
        let same = ends.iter().any(|other| (other.posture.objective - value).abs() <= SAME * value);
        ends.push(found);
        if same {
            break;
        }
    }
    ends.sort_by(|a, b| a.posture.objective.total_cmp(&b.posture.objective));
    let lowest = ends.first().map_or(f64::INFINITY, |end| end.posture.objective);
    for (rank, mut end) in ends.into_iter().enumerate() {
        let hopeful = rank == 0 || end.posture.objective <= (1.0 + HOPEFUL) * best.posture.objective.min(lowest);
        if hopeful && !end.converged && !(budget.stop)() {
            let spent = [end.iterations, end.factorizations];
            end = Newton::default().solve(question, &end.posture, budget);
            end.iterations += spent[0];
            end.factorizations += spent[1];
        }
        best.absorb(end);
    }
    let contractions = question.actuation.contractions(&best.posture.beta);
    question.model.contractile.set_contractions(&contractions);
    best
}

/// The state in which a search begins; `None` where it has no equilibrium. Its work is added to `total`.
fn posture(
    question: &mut Question,
    kind: Start,
    given: &Posture,
    budget: &Budget,
    total: &mut Answer,
) -> Option<Posture> {
    let posture = match kind {
        Start::Given => given.clone(),
        Start::Taut => {
            let beta = taut(question, &given.x);
            let (posture, factorizations) = question.settle(&beta, &given.x, budget.stop);
            total.factorizations += factorizations;
            posture
        }
        Start::Tension => {
            let forming = Budget { iterations: budget.iterations.min(FORMING_ITERATIONS), stop: budget.stop };
            let formed = AllAtOnce { step_tolerance: FORMING_STEP }.solve(question, given, &forming);
            total.iterations += formed.iterations;
            total.factorizations += formed.factorizations;
            relaxed(question, formed.posture)
        }
    };
    posture.in_equilibrium().then_some(posture)
}

/// The same posture with every slack element contracted as little as its winch allows while it stays slack.
fn relaxed(question: &mut Question, mut posture: Posture) -> Posture {
    let elements = &question.model.contractile.elements;
    for (winch, beta) in question.actuation.winches.iter().zip(&mut posture.beta) {
        let (e, ratio) = winch.members[0];
        let slack = elements[e].alpha0 - elements[e].length(&posture.x) - elements[e].epsilon;
        if ratio * *beta <= slack {
            let least = if ratio > 0.0 { (slack / ratio).min(0.0) } else { (slack / ratio).max(0.0) };
            *beta = least.max(winch.lower).min(winch.upper);
        }
    }
    let contractions = question.actuation.contractions(&posture.beta);
    question.model.contractile.set_contractions(&contractions);
    posture.objective = question.objective_at(&posture.x, &contractions);
    posture
}

/// The activations, within their bounds, at which every winch has all its elements taut at `x`.
fn taut(question: &Question, x: &[f64]) -> Vec<f64> {
    let elements = &question.model.contractile.elements;
    let of = |&(e, r): &(usize, f64)| (elements[e].alpha0 - elements[e].length(x) + elements[e].epsilon) / r;
    let mut beta: Vec<f64> =
        question.actuation.winches.iter().map(|w| w.members.iter().map(of).fold(f64::NEG_INFINITY, f64::max)).collect();
    question.actuation.clamp(&mut beta);
    beta
}
