//! More winches: Newton's method from several starts.

use super::rays::reach;
use super::walk::passing;
use crate::soft_ik::contraction::GaussNewton;
use crate::soft_ik::newton::Newton;
use crate::soft_ik::{Actuation, Answer, Budget, Method, Posture, Question, Winch};

/// Iterations and relative decrease from each of several starts; the best is then followed to the end.
const EXPLORING_ITERATIONS: usize = 40;
const EXPLORING_DECREASE: f64 = 1e-5;
const NEWTON_DECREASE: f64 = 1e-3;
/// Up to this many winches are also recruited one by one.
const SEQUENTIAL_LIMIT: usize = 12;
/// Steps in which a new winch is wound over its range.
const SEQUENTIAL_STEPS: usize = 8;
/// Recruiting may take so many times the factorisations of the starts before, which may all have ended in the same, poor valley.
const SEQUENTIAL_WORK: f64 = 2.0;
/// A winch is not wound on where `O` has risen so many times in a row, and to so many times its least: it has drawn the body past the
/// targets.
const RISES: usize = 2;
const FAR: f64 = 1.5;
/// How well forces balance in these, as a part of those at work: enough to see where the body comes closest.
const BALANCE: f64 = 1e-2;
/// Parts of the winches' range, from taut to their upper bounds, at which a search begins.
const PARTS: [f64; 3] = [0.15, 0.4, 0.7];
/// Starts are no longer tried once so many have ended in the value that is the best.
const REPEATS: usize = 2;
/// Two values are the same where they differ by less than this part: so much is left to gain where exploring ends.
const SAME_VALUE: f64 = 1e-3;

/// The best of several starts, and of recruiting the winches one by one.
pub fn from_several(question: &mut Question, start: &Posture, budget: &Budget) -> Answer {
    let mut best = Answer::at(start);
    let count = question.actuation.winches.len();
    let method = exploring(question);
    let exploring = Budget { iterations: budget.iterations.min(EXPLORING_ITERATIONS), stop: budget.stop };
    let mut repeats = 0;
    for beta in starts(question, start) {
        if (budget.stop)() || repeats >= REPEATS {
            break;
        }
        let (posture, factorizations) = question.settle(&beta, &start.x, budget.stop);
        best.factorizations += factorizations;
        if posture.in_equilibrium() {
            let before = best.posture.objective;
            let answer = method.solve(question, &posture, &exploring);
            let after = answer.posture.objective;
            repeats = match () {
                _ if (after - before).abs() <= SAME_VALUE * before => repeats + 1,
                _ if after < before => 0,
                _ => repeats,
            };
            best.starts += 1;
            best.absorb(answer);
        }
    }
    if count > 1 && count <= SEQUENTIAL_LIMIT && !(budget.stop)() {
        best.starts += 1;
        let most = (SEQUENTIAL_WORK * best.factorizations as f64) as usize;
        best.absorb(one_by_one(question, start, method.as_ref(), &exploring, most));
    }
    let from = best.posture.clone();
    let last: Box<dyn Method> =
        if has_newton(question) { Box::new(Newton::default()) } else { Box::new(GaussNewton::default()) };
    best.absorb(last.solve(question, &from, budget));
    let contractions = question.actuation.contractions(&best.posture.beta);
    question.model.contractile.set_contractions(&contractions);
    best
}

/// Newton's method, quick on winches, knows no weight on tensions.
fn has_newton(question: &Question) -> bool {
    question.objective.tension_weight == 0.0
}

fn exploring(question: &Question) -> Box<dyn Method> {
    if has_newton(question) {
        Box::new(Newton { relative_decrease: NEWTON_DECREASE, ..Newton::default() })
    } else {
        Box::new(GaussNewton { relative_decrease: EXPLORING_DECREASE })
    }
}

/// Recruits the winches one after another: each is wound over its range, then adjusted together with those before it, while
/// those after it wait. Large bends that one winch must begin are found this way.
///
/// After `most` factorisations no further one is recruited: those that wait stay paid out.
fn one_by_one(question: &mut Question, start: &Posture, method: &dyn Method, budget: &Budget, most: usize) -> Answer {
    let all = question.actuation;
    // Waiting winches pay out as far as they may: a cable that is not yet in use must not hold the body back.
    let mut beta: Vec<f64> =
        all.winches.iter().zip(&start.beta).map(|(w, b)| if w.lower.is_finite() { w.lower } else { *b }).collect();
    let (posture, factorizations) = question.settle(&beta, &start.x, budget.stop);
    let mut best = Answer { factorizations, ..Answer::at(&posture) };
    for count in 1..=all.winches.len() {
        if best.factorizations > most {
            break;
        }
        let some = Actuation { winches: all.winches[..count].to_vec(), fixed: all.contractions(&beta) };
        let mut inner = Question { model: &mut *question.model, actuation: &some, objective: question.objective };
        let winch = &all.winches[count - 1];
        let upper = if winch.upper.is_finite() { winch.upper } else { reach(&inner, count - 1) };
        let from = Posture { beta: beta[..count].to_vec(), ..best.posture.clone() };
        best.posture.beta = from.beta.clone();
        let (mut posture, factorizations) = inner.settle(&from.beta, &from.x, budget.stop);
        best.factorizations += factorizations;
        // Wind the new winch slowly and go on from where the body came closest.
        let mut closest = posture.clone();
        let mut rises = 0;
        let slack = posture.beta[count - 1].max(0.0_f64.max(winch.lower));
        for step in 1..=SEQUENTIAL_STEPS {
            if (budget.stop)() || rises >= RISES && posture.objective > FAR * closest.objective {
                break;
            }
            let mut tried = from.beta.clone();
            tried[count - 1] = slack + (upper - slack) * step as f64 / SEQUENTIAL_STEPS as f64;
            some.clamp(&mut tried);
            let (next, factorizations) = inner.settle_to(&tried, &posture.x, &passing(BALANCE), budget.stop);
            best.factorizations += factorizations;
            rises = if next.objective > posture.objective { rises + 1 } else { 0 };
            posture = next;
            if posture.in_equilibrium() && posture.objective < closest.objective {
                closest = posture.clone();
            }
        }
        let (closest, factorizations) = inner.settle(&closest.beta, &closest.x, budget.stop);
        best.factorizations += factorizations;
        best.absorb(method.solve(&mut inner, &closest, budget));
        beta[..count].copy_from_slice(&best.posture.beta);
    }
    best.posture.beta = beta;
    best
}

/// Starting activations: the given ones, all winches just taut, and parts of the range.
fn starts(question: &Question, start: &Posture) -> Vec<Vec<f64>> {
    let taut = question.just_taut(&start.x);
    let winches = question.actuation.winches.iter().enumerate().zip(&taut);
    let top =
        |((j, w), t): ((usize, &Winch), &f64)| if w.upper.is_finite() { w.upper } else { t.max(reach(question, j)) };
    let upper: Vec<f64> = winches.map(top).collect();
    let part = |s: f64| taut.iter().zip(&upper).map(|(t, u)| t + s * (u - t).max(0.0)).collect();
    let mut out = vec![start.beta.clone(), taut.clone()];
    out.extend(PARTS.map(part));
    for beta in &mut out {
        question.actuation.clamp(beta);
    }
    out.dedup();
    out
}
