//! `bench winding`: is the pose that the realizable plushie is shown in the best that winding from rest reaches, and what does it
//! cost where problem files ask the same? Rigs of one to three winches are made from the seed.
//!
//! Reference: a dense scan of wound states. One winch: 200 states on the way from rest to the end of its range, each settled from
//! the one before. Two: 30 x 30, row by row: the first winch is wound to the row, then the second along it. What a row enters
//! and proportional winding from rest does not is not a state to be shown, so the states that are better than what is
//! shown are wound from rest once more, in proportion, the best first.

pub mod rigs;

use self::rigs::{Rig, rig};
use super::figures::significant;
use super::statistics::Summary;
use super::{BenchError, Cell, Report, Session, Table};
use crate::design::Target;
use crate::engine::compile::{Plushie, View, compile, objective};
use crate::engine::target_error;
use crate::engine::{Effort, Quality, Request, Setpoint, Shape, Solver};
use crate::soft_ik::contraction::GaussNewton;
use crate::soft_ik::winding::{self, Care, Search};
use crate::soft_ik::{Actuation, Budget, Method, Objective, Posture, Question};
use std::sync::Arc;
use std::time::Instant;

/// States of a scan along each winch, for one winch and for two.
pub const SCANNED: [usize; 2] = [200, 30];
/// States of a scan that are wound from rest once more at most, for each rig.
const PROVED: usize = 40;
/// Largest part of the error at rest that an answer may miss.
pub const MISSING: f64 = 0.01;
/// Two values of `O` are the same where they differ by at most this part of the whole decrease.
const SAME_VALUE: f64 = 1e-4;
/// Where winches hardly help, what is missing is compared with this part of `O` at rest.
const HARDLY: f64 = 1e-3;
/// Iterations of every method.
const ITERATIONS: usize = 300;
/// Times are the shortest of so many.
pub const RUNS: usize = 5;
/// Parts of the ranges from which the Gauss-Newton method starts; the best counts.
const STARTS: [f64; 3] = [0.0, 0.35, 0.7];

/// Shapes and rigs of the study.
pub struct Winding {
    pub shapes: Vec<String>,
    /// Rigs of each number of winches, one to three, over all shapes.
    pub rigs: usize,
    /// States of the scan along each winch, for one winch and for two ([`SCANNED`]).
    pub scanned: [usize; 2],
    /// Runs of each method, of whose times the shortest counts ([`RUNS`]).
    pub runs: usize,
}

/// What the scan says of a rig; errors as parts of the error at rest.
struct Scan {
    best: f64,
    /// The best of the states that proportional winding confirms.
    wound: f64,
}

impl Winding {
    /// Runs the study.
    ///
    /// # Errors
    /// A shape that cannot be meshed, or the study was cancelled.
    pub fn run(&self, session: &Session) -> Result<Report, BenchError> {
        let headings = [
            "rig",
            "shape",
            "fibres",
            "winches",
            "tendons",
            "rest",
            "shown",
            "scan",
            "wound",
            "missing",
            "1 mm off",
            "factorisations",
            "ms",
        ];
        let title = "Poses shown against dense scans of wound states; errors as parts of the error at rest, itself in body lengths";
        let mut poses = Table::new("poses", title, &headings);
        let title = "The same as questions of a problem file: missing part of the decrease of O, and work against Gauss-Newton alone";
        let headings = [
            "rig",
            "winches",
            "missing",
            "Gauss-Newton misses",
            "factorisations",
            "of its best start",
            "ratio of times",
        ];
        let mut problems = Table::new("problems", title, &headings);
        let (mut missing, mut parts, mut ratios) = (Vec::new(), Vec::new(), Vec::new());
        for winches in 1..=3 {
            for number in 0..self.rigs {
                let shape = &self.shapes[number % self.shapes.len()];
                session.next(&format!("{winches} winches, rig {} ({shape})", number + 1))?;
                let rig = rig(shape, winches, session.seed, number as u64, session.stop)?;
                if winches <= self.scanned.len() {
                    let (row, part) = self.pose(shape, number, &rig, session)?;
                    poses.push(row);
                    missing.push(part);
                }
                let (row, part, ratio) = self.problem(shape, number, &rig, session)?;
                problems.push(row);
                parts.push(part);
                ratios.push(ratio);
            }
        }
        let good = missing.iter().filter(|part| **part <= MISSING).count();
        let same = parts.iter().filter(|part| **part <= SAME_VALUE).count();
        let (missed, times) = (Summary::of(missing.iter().copied()), Summary::of(ratios.iter().copied()));
        let remarks = vec![
            format!(
                "{good} of {} poses are within {MISSING} of the error at rest of the best state that the scan finds and winding from \
                 rest confirms; the worst misses {}.",
                missing.len(),
                significant(missed.worst)
            ),
            format!(
                "As problems {same} of {} have the best known value; the worst misses {} of the decrease. \
                 Factorisations over those of Gauss-Newton from its best start: median {}, worst {}.",
                parts.len(),
                significant(Summary::of(parts.iter().copied()).worst),
                significant(times.median),
                significant(times.worst)
            ),
        ];
        let title = format!("Rigs of one to three winches, {} of each, seed {}", self.rigs, session.seed);
        Ok(Report { title, tables: vec![poses, problems], remarks, plots: Vec::new() })
    }

    /// A pose as it is shown, against the scan; with what it misses.
    fn pose(&self, shape: &str, number: usize, rig: &Rig, session: &Session) -> Result<(Vec<Cell>, f64), BenchError> {
        let rest = rest_error(rig);
        let shown = shown(rig, session);
        session.check()?;
        let scan = scan(shape, rig, shown.target_error / rest, &self.scanned, session)?;
        let missing = (shown.target_error / rest - scan.wound).max(0.0);
        let design = &rig.design;
        let row = vec![
            (number + 1).into(),
            shape.into(),
            design.fiber_routings().len().into(),
            design.networks.len().into(),
            design.networks.iter().map(|n| n.tendons.len()).sum::<usize>().into(),
            rest.into(),
            (shown.target_error / rest).into(),
            scan.best.into(),
            scan.wound.into(),
            missing.into(),
            shown.play.map(|play| play.error / rest).into(),
            shown.factorizations.into(),
            shown.milliseconds.into(),
        ];
        Ok((row, missing))
    }

    /// The rig as a question of a problem file, with the missing part of the decrease of `O` and the ratio of factorisations.
    fn problem(
        &self,
        shape: &str,
        number: usize,
        rig: &Rig,
        session: &Session,
    ) -> Result<(Vec<Cell>, f64, f64), BenchError> {
        let mut posed = Posed::new(shape, rig)?;
        let mut question = posed.question();
        let rest = question.model.rest.clone();
        let winches = question.actuation.winches.clone();
        let zero = vec![0.0; winches.len()];
        let (start, _) = question.settle(&zero, &rest, session.stop);
        let budget = Budget { iterations: ITERATIONS, stop: session.stop };
        let mut best = Search::new(&question, &start, Care { proved: false, ..Care::THOROUGH })
            .run(&mut question, session.stop)
            .posture
            .objective;
        // Gauss-Newton alone, from all combinations of starts.
        let mut alone: Option<(f64, usize, f64)> = None;
        for code in 0..STARTS.len().pow(winches.len() as u32) {
            let part = |j: usize| STARTS[code / STARTS.len().pow(j as u32) % STARTS.len()];
            let beta: Vec<f64> = winches.iter().enumerate().map(|(j, w)| part(j) * w.upper).collect();
            let (time, (answer, settling)) = fastest(self.runs, || {
                let (from, settling) = question.settle(&beta, &rest, session.stop);
                (GaussNewton::default().solve(&mut question, &from, &budget), settling)
            });
            session.check()?;
            let value = answer.posture.objective;
            let decrease = (start.objective - value).max(HARDLY * start.objective).max(f64::MIN_POSITIVE);
            let better = alone.is_none_or(|(o, _, t)| {
                value < o - SAME_VALUE * decrease || value <= o + SAME_VALUE * decrease && time < t
            });
            if answer.posture.in_equilibrium() && better {
                alone = Some((value, answer.factorizations + settling, time));
            }
        }
        let (time, answer) = fastest(self.runs, || crate::soft_ik::solve(&mut question, &zero, &budget));
        session.check()?;
        let value = answer.posture.objective;
        let (alone, fewest, shortest) = alone.unwrap_or((start.objective, 1, f64::NAN));
        best = best.min(alone).min(value);
        let decrease = (start.objective - best).max(HARDLY * start.objective).max(f64::MIN_POSITIVE);
        let (missing, alone) = ((value - best) / decrease, (alone - best) / decrease);
        let row = vec![
            (number + 1).into(),
            winches.len().into(),
            missing.into(),
            alone.into(),
            answer.factorizations.into(),
            fewest.into(),
            (time / shortest).into(),
        ];
        Ok((row, missing, answer.factorizations as f64 / fewest.max(1) as f64))
    }
}

/// The shortest time of a few runs, s, with the result.
fn fastest<T>(runs: usize, mut work: impl FnMut() -> T) -> (f64, T) {
    let mut timed = || {
        let clock = Instant::now();
        let result = work();
        (clock.elapsed().as_secs_f64(), result)
    };
    let mut best = timed();
    for _ in 1..runs {
        let (time, _) = timed();
        best.0 = best.0.min(time);
    }
    best
}

/// A rig's realizable plushie with its question.
struct Posed {
    plushie: Plushie,
    actuation: Actuation,
    objective: Objective,
}

impl Posed {
    fn new(shape: &str, rig: &Rig) -> Result<Self, BenchError> {
        let fail = |source| BenchError::Model { shape: shape.to_owned(), source };
        let plushie = compile(&rig.design, View::Realizable).map_err(fail)?;
        let actuation = Actuation { winches: plushie.winches.clone(), fixed: vec![0.0; plushie.tendons.len()] };
        let objective = objective(&rig.design, &plushie, &rig.targets);
        Ok(Self { plushie, actuation, objective })
    }

    fn question(&mut self) -> Question<'_> {
        Question { model: &mut self.plushie.model, actuation: &self.actuation, objective: &self.objective }
    }
}

fn rest_error(rig: &Rig) -> f64 {
    target_error(&rig.design, &rig.targets, &rig.design.mesh.nodes).max(f64::MIN_POSITIVE)
}

fn error(rig: &Rig, targets: &[Target], x: &[f64]) -> f64 {
    let nodes: Vec<[f64; 2]> = x.chunks_exact(2).map(|p| [p[0], p[1]]).collect();
    target_error(&rig.design, targets, &nodes)
}

/// The realizable plushie as `check` shows it.
fn shown(rig: &Rig, session: &Session) -> Shape {
    let request = Request {
        id: 0,
        design: Arc::new(rig.design.clone()),
        setpoint: Setpoint::Targets(rig.targets.clone()),
        quality: Quality::Accurate,
        show_idealized: false,
        show_realizable: true,
    };
    let outcome = Solver::default().solve_with(&request, Effort::Thorough, session.cancel);
    outcome.realizable.unwrap_or_default()
}

/// The dense scan, and which of its states that are better than `shown` winding from rest confirms.
fn scan(shape: &str, rig: &Rig, shown: f64, scanned: &[usize; 2], session: &Session) -> Result<Scan, BenchError> {
    let mut posed = Posed::new(shape, rig)?;
    let mut question = posed.question();
    let rest = question.model.rest.clone();
    let winches = question.actuation.winches.clone();
    let (start, _) = question.settle(&vec![0.0; winches.len()], &rest, session.stop);
    let unit = rest_error(rig);
    let count = scanned[winches.len() - 1];
    let at = |j: usize, k: usize| winches[j].upper * k as f64 / count as f64;
    let last = winches.len() - 1;
    let mut states: Vec<(f64, Vec<f64>)> = Vec::new();
    let mut row = start.clone();
    for k in 0..=if winches.len() > 1 { count } else { 0 } {
        session.check()?;
        let mut beta = row.beta.clone();
        if winches.len() > 1 {
            beta[0] = at(0, k);
            row = question.settle(&beta, &row.x, session.stop).0;
        }
        let mut now: Posture = row.clone();
        for i in 0..=count {
            beta[last] = at(last, i);
            now = question.settle(&beta, &now.x, session.stop).0;
            if now.in_equilibrium() {
                states.push((error(rig, &rig.targets, &now.x) / unit, beta.clone()));
            }
        }
    }
    states.sort_by(|a, b| a.0.total_cmp(&b.0));
    let best = states.first().map_or(1.0, |state| state.0);
    // With one winch the scan itself is winding from rest.
    let mut wound = if winches.len() == 1 { best } else { f64::INFINITY };
    for (_, beta) in states.iter().take_while(|state| state.0 < shown && winches.len() > 1).take(PROVED) {
        session.check()?;
        if let (Some(posture), _) = winding::wound(&mut question, &start, beta, session.stop) {
            wound = wound.min(error(rig, &rig.targets, &posture.x) / unit);
        }
    }
    Ok(Scan { best, wound: if wound.is_finite() { wound } else { shown } })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn poses_of_seeded_rigs_are_as_good_as_a_scan() {
        let cancel = AtomicBool::new(false);
        let session = Session { seed: 3, stop: &|| false, cancel: &cancel, progress: &|_| {}, found: &|_| {} };
        let shapes = vec!["e".to_owned()];
        let report = Winding { shapes, rigs: 1, scanned: [60, 8], runs: 1 }.run(&session).unwrap();
        for row in &report.tables[0].rows {
            let Cell::Number(missing) = row[9] else { panic!("no figure") };
            assert!(missing <= MISSING, "{row:?}");
        }
        for row in &report.tables[1].rows {
            let Cell::Number(missing) = row[2] else { panic!("no figure") };
            assert!(missing <= 0.01, "{row:?}");
        }
    }
}
