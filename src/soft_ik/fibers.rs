//! Many fibres: the question's own `O`, from several starts.
//!
//! **With a weight on tensions** ([`least_tense`]) the all-at-once method minimises it. A soft body buckles in more than one way on the
//! way to far targets, so that the start matters: besides the given one, contractions that change smoothly over the body, to
//! one side and to the other, are tried.
//!
//! **Without** ([`solve`]), `O` is that of problem files:
//!
//! `O` has many valleys: an element that is slack feels nothing of the targets, so what is slack at the start tends to stay so. The
//! starts are the answer of the all-at-once method, in whose objective slack elements take part; the activations given; and all
//! elements just taut. Each is followed by Newton's method until it gains little, or too little to reach the best, and the
//! best one to the end.

use super::newton::Newton;
use super::tension::AllAtOnce;
use super::{Answer, Budget, Method, Posture, Question};

/// A start is explored until it gains less than this part of `O` in an iteration, some times in a row.
const EXPLORED: f64 = 1e-3;
const EXPLORING_ITERATIONS: usize = 80;
/// Where two starts end within this part of each other no more are tried.
const SAME: f64 = 1e-3;
/// Nor where one ends this part above another: where the targets cannot be reached, what begins with slack elements is no match for the
/// all-at-once method (of 60 seeded problems, those that are just taut were never better then).
const WORSE: f64 = 1e-2;
/// Where the best has not come to its end, what was explored is followed as well if it is at most this part above.
const HOPEFUL: f64 = 2e-3;
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

/// Smooth starts: half waves across the body along these directions, by this part of the winches' range at their tops.
const WAVES: [[f64; 2]; 6] = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0], [0.7, 0.7], [-0.7, -0.7]];
const WAVE_STRENGTH: f64 = 0.6;
/// Range of a winch without an upper bound, in lengths of its element.
const UNBOUNDED_RANGE: f64 = 0.5;

/// The best that the all-at-once method finds from the given posture and from smooth contractions. Every winch winds one element.
pub(super) fn least_tense(question: &mut Question, start: &Posture, budget: &Budget) -> Answer {
    let mut best = AllAtOnce::default().solve(question, start, budget);
    for direction in WAVES {
        if (budget.stop)() {
            break;
        }
        let beta = wave(question, direction);
        let (from, factorizations) = question.settle(&beta, &start.x, budget.stop);
        best.factorizations += factorizations;
        if from.in_equilibrium() {
            best.starts += 1;
            best.absorb(AllAtOnce::default().solve(question, &from, budget));
        }
    }
    let contractions = question.actuation.contractions(&best.posture.beta);
    question.model.contractile.set_contractions(&contractions);
    best
}

/// Activations that rise smoothly across the body in a direction, within their bounds.
fn wave(question: &Question, direction: [f64; 2]) -> Vec<f64> {
    let (rest, elements) = (&question.model.rest, &question.model.contractile.elements);
    let along = |[x, y]: [f64; 2]| x * direction[0] + y * direction[1];
    let nodes = rest.chunks_exact(2).map(|p| [p[0], p[1]]);
    let (low, high) = nodes.map(along).fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    let mut beta: Vec<f64> = question
        .actuation
        .winches
        .iter()
        .map(|w| {
            let (e, ratio) = w.members[0];
            let range = if w.upper.is_finite() { w.upper } else { UNBOUNDED_RANGE * elements[e].alpha0 / ratio };
            let part = (along(elements[e].routing[0].at(rest)) - low) / (high - low).max(f64::MIN_POSITIVE);
            WAVE_STRENGTH * range * 0.5 * (1.0 - (std::f64::consts::PI * part).cos())
        })
        .collect();
    question.actuation.clamp(&mut beta);
    beta
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
        let rival = ends.iter().map(|end| end.posture.objective).fold(f64::INFINITY, f64::min);
        let found = Newton { relative_decrease: EXPLORED, rival }.solve(question, &from, &exploring);
        let value = found.posture.objective;
        let same = ends.iter().any(|other| (other.posture.objective - value).abs() <= SAME * value);
        let worse = ends.iter().any(|other| value > (1.0 + WORSE) * other.posture.objective);
        ends.push(found);
        if same || worse {
            break;
        }
    }
    ends.sort_by(|a, b| a.posture.objective.total_cmp(&b.posture.objective));
    for (rank, mut end) in ends.into_iter().enumerate() {
        let near = end.posture.objective <= (1.0 + HOPEFUL) * best.posture.objective;
        let hopeful = rank == 0 || !best.converged && near;
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
            let mut beta = question.just_taut(&given.x);
            question.actuation.clamp(&mut beta);
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

/// A posture with every slack element contracted as little as its winch allows while it stays slack.
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
