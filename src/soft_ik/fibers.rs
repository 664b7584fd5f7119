//! `soft_ik` questions on many fibres: Newton's method on the question's own `O`, from several starts.

use super::newton::Newton;
use super::tension::AllAtOnce;
use super::{Answer, Budget, Method, Posture, Question};

pub(super) fn solve(question: &mut Question, start: &Posture, budget: &Budget) -> Answer {
    let names = std::env::var("STARTS").unwrap_or("zero,taut,tension".into());
    let mut best = Answer { posture: start.clone(), iterations: 0, factorizations: 0, converged: false };
    for name in names.split(',') {
        let clock = std::time::Instant::now();
        let from = match name {
            "zero" => start.clone(),
            "tension" => {
                let tension = AllAtOnce { step_tolerance: 1e-3 };
                let found = tension.solve(question, start, &Budget { iterations: 40, stop: budget.stop });
                best.factorizations += found.factorizations;
                relaxed(question, found.posture, budget)
            }
            _ => {
                let part: f64 = name.parse().unwrap_or(0.0);
                let beta = graded(question, start, part);
                let (posture, factorizations) = question.settle(&beta, &start.x, budget.stop);
                best.factorizations += factorizations;
                posture
            }
        };
        if !from.in_equilibrium() { continue; }
        let first = from.objective;
        let t0 = clock.elapsed().as_secs_f64();
        let found = Newton::default().solve(question, &from, &Budget { iterations: 300, stop: budget.stop });
        if std::env::var("SHOW").is_ok() {
            eprintln!("{name}: {:.4e} -> {:.6e} its {} fac {} conv {} ms {:.0} + {:.0}", first, found.posture.objective, found.iterations, found.factorizations, found.converged, t0*1e3, (clock.elapsed().as_secs_f64()-t0)*1e3);
        }
        best.iterations += found.iterations;
        best.factorizations += found.factorizations;
        if found.posture.objective < best.posture.objective || !best.posture.in_equilibrium() {
            best.posture = found.posture;
            best.converged = found.converged;
        }
    }
    best
}

/// Slack fibres need no contraction: as near zero as they stay slack.
fn relaxed(question: &mut Question, mut posture: Posture, _budget: &Budget) -> Posture {
    let elements = &question.model.contractile.elements;
    for (winch, b) in question.actuation.winches.iter().zip(&mut posture.beta) {
        let (e, r) = winch.members[0];
        let slack = (elements[e].alpha0 - elements[e].length(&posture.x) - elements[e].epsilon) / r;
        if *b <= slack + 1e-12 {
            *b = slack.min(0.0_f64.max(*b)).min(*b).max(winch.lower).max(0.0_f64.min(*b));
        }
    }
    let contractions = question.actuation.contractions(&posture.beta);
    question.model.contractile.set_contractions(&contractions);
    posture.objective = question.objective_at(&posture.x, &contractions);
    posture
}

fn graded(question: &Question, start: &Posture, part: f64) -> Vec<f64> {
    let elements = &question.model.contractile.elements;
    let mut beta: Vec<f64> = question.actuation.winches.iter().map(|w| {
        let taut = w.members.iter().map(|&(e, r)| (elements[e].alpha0 - elements[e].length(&start.x) + elements[e].epsilon) / r).fold(f64::NEG_INFINITY, f64::max);
        let upper = if w.upper.is_finite() { w.upper } else { taut.max(0.5 * w.members.iter().map(|&(e, r)| elements[e].alpha0 / r).fold(f64::INFINITY, f64::min)) };
        taut + part * (upper - taut).max(0.0)
    }).collect();
    question.actuation.clamp(&mut beta);
    beta
}
