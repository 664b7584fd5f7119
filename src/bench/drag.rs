//! `bench drag`: warm drags. What a frame costs and by which phase, how near it comes, how far it is from equilibrium, from the
//! converged optimum of the same objective, and what Algorithm 1 takes for the same target error.

use super::baseline::{Comparison, EQUAL_ERROR, End, follow};
use super::drags::{Path, goals, places, points, towards};
use super::figures::significant;
use super::linear::Unit;
use super::plot::{Plot, Series};
use super::posing::{at_rest, distance_from_equilibrium, free_fibers, may_be_shown, optimum};
use super::shapes::Subject;
use super::statistics::{Summary, growth_exponent};
use super::{BenchError, Cell, Quality, Report, Session, Table, Tracker};
use crate::random::Random;
use crate::soft_ik::Question;
use std::time::Instant;

/// Algorithm 1 is given up on a frame after this many times the time of the frame: a lower bound above any ratio of interest.
const PATIENCE: f64 = 100.0;
/// Frames between those that are compared with the optimum and with Algorithm 1.
const SAMPLING: usize = 10;

/// Shapes, sizes and drags of the study.
pub struct Drag {
    pub shapes: Vec<String>,
    pub fibers: Vec<usize>,
    pub targets: Vec<usize>,
    pub paths: Vec<Path>,
    pub frames: usize,
    pub quality: Quality,
    /// Algorithm 1 runs up to this many fibres.
    pub baseline_up_to: usize,
}

/// One drag, frame by frame. Times in ms, errors in body lengths.
#[derive(Default)]
struct Measured {
    times: Vec<f64>,
    /// On sampled frames: the fastest factorisation.
    units: Vec<f64>,
    /// Assembly, factorisation, solves, dual, line search.
    phases: Vec<[f64; 5]>,
    iterations: Vec<f64>,
    factorizations: Vec<f64>,
    errors: Vec<f64>,
    distances: Vec<f64>,
    /// The distance from equilibrium that the tracker itself states.
    claimed: Vec<f64>,
    not_shown: usize,
    /// On sampled frames: target error over that of the converged optimum.
    excess: Vec<f64>,
    /// Algorithm 1 on its own drag, every frame; and on sampled frames from our posture of the frame before.
    own: Comparison,
    handed: Comparison,
}

/// Times and errors of all drags, still empty.
fn tables() -> [Table; 2] {
    let key = ["shape", "fibres", "targets", "path"];
    let time = [
        "median",
        "p95",
        "worst",
        "assembly",
        "factor",
        "solves",
        "dual",
        "line search",
        "iterations",
        "factorisations",
        "fastest factor",
        "in factors",
        "p95 in factors",
        "worst in factors",
        "Alg. 1 / ours",
        "from ours",
        "reached",
        "gave up",
        "stalled",
    ];
    let quality = [
        "error, median",
        "p95",
        "worst",
        "excess, median",
        "excess, worst",
        "unbalanced, median",
        "unbalanced, worst",
        "claimed, worst",
        "not showable",
    ];
    let times = Table::new("drag-times", "Time of a frame, ms (phases: medians)", &[&key[..], &time].concat());
    let errors = Table::new(
        "drag-errors",
        "Target error and its excess over the converged optimum, in body lengths; unbalanced force over forces at work",
        &[&key[..], &quality].concat(),
    );
    [times, errors]
}

impl Drag {
    /// Runs the study.
    ///
    /// # Errors
    /// A shape that cannot be meshed, or the study was cancelled.
    pub fn run(&self, session: &Session) -> Result<Report, BenchError> {
        let [mut times, mut errors] = tables();
        let mut curves: Vec<Series> = Vec::new();
        let mut remarks = Vec::new();
        for shape in &self.shapes {
            for &fibers in &self.fibers {
                session.next(&format!("{shape}, {fibers} fibres"))?;
                let mut subject = Subject::new(shape, fibers)?;
                let mut unit = Unit::of(&mut subject, session)?;
                for &count in &self.targets {
                    for &path in &self.paths {
                        session.next(&format!("{shape}, {fibers} fibres, {count} targets, {}", path.name()))?;
                        let m = self.drag(&mut subject, count, path, &mut unit, session)?;
                        let key: Vec<Cell> = vec![
                            subject.name.clone().into(),
                            subject.fibers().into(),
                            count.into(),
                            path.name().into(),
                        ];
                        let median = Summary::of(m.times.iter().copied()).median;
                        times.push([key.clone(), m.time_cells()].concat());
                        errors.push([key, m.error_cells()].concat());
                        let label = format!("{shape}, {count} targets, {}", path.name());
                        let point = (subject.fibers() as f64, median);
                        match curves.iter_mut().find(|c| c.label == label) {
                            Some(curve) => curve.points.push(point),
                            None => curves.push(Series::line(label, vec![point])),
                        }
                    }
                }
            }
        }
        for curve in &curves {
            if let Some(exponent) = growth_exponent(&curve.points) {
                remarks.push(format!("{}: time grows as fibres^{exponent:.2}", curve.label));
            }
        }
        remarks.push(format!(
            "Alg. 1 / ours: median time of Algorithm 1, on a drag of its own, for our target error in the same frame ({} of the \
             body length more is enough), in units of our time; a stalled frame is infinite; > marks lower bounds (200 \
             iterations or {PATIENCE} times our frame). From ours: the same on every {SAMPLING}th frame, handed our posture of the \
             frame before. Reached, gave up, stalled: frames of its own drag.",
            significant(EQUAL_ERROR)
        ));
        let plot = Plot {
            name: "drag".into(),
            title: "Time of a frame under the hand (median)".into(),
            x_label: "muscle fibres".into(),
            y_label: "ms".into(),
            log_x: true,
            log_y: true,
            series: curves,
        };
        let title = format!(
            "Warm drags of {} frames, quality {:?}, seed {}, one thread",
            self.frames, self.quality, session.seed
        );
        Ok(Report { title, tables: vec![times, errors], remarks, plots: vec![plot] })
    }

    fn drag(
        &self,
        subject: &mut Subject,
        count: usize,
        path: Path,
        unit: &mut Unit,
        session: &Session,
    ) -> Result<Measured, BenchError> {
        let mut random = Random::of(session.seed, &subject.name, count as u64);
        let at = points(subject, &places(&subject.name, count, &mut random)?);
        let goals = goals(subject, &at, path, self.frames, session)?;
        let actuation = free_fibers(subject);
        let length = subject.length();
        let with_baseline = subject.fibers() <= self.baseline_up_to;
        let mut m = Measured::default();
        let mut tracker: Option<Tracker> = None;
        let mut rival = None;
        let mut last_optimum = None;
        for (k, goals) in goals.iter().enumerate() {
            session.check()?;
            let objective = towards(subject, &at, goals);
            let mut question =
                Question { model: &mut subject.plushie.model, actuation: &actuation, objective: &objective };
            if tracker.is_none() {
                let rest = at_rest(&mut question, session.stop);
                tracker = Some(Tracker::new(&mut question, &rest));
                rival = with_baseline.then_some(rest);
            }
            let Some(tracker) = &mut tracker else { continue };
            let sampled = k % SAMPLING == SAMPLING / 2;
            let before = sampled.then(|| tracker.posture().clone());
            let clock = Instant::now();
            let frame = tracker.frame(&mut question, self.quality, session.stop);
            let time = 1e3 * clock.elapsed().as_secs_f64();
            let posture = tracker.posture();
            let error = objective.target_error(&posture.x);
            let p = &frame.phases;
            m.times.push(time);
            m.phases.push([p.assembly, p.factorization, p.solves, p.dual, p.line_search].map(|s| 1e3 * s));
            m.iterations.push(frame.iterations as f64);
            m.factorizations.push(frame.factorizations as f64);
            m.errors.push(error / length);
            m.distances.push(distance_from_equilibrium(question.model, &actuation, posture));
            m.claimed.push(frame.residual / frame.force_scale.max(f64::MIN_POSITIVE));
            m.not_shown += usize::from(!may_be_shown(question.model, posture));
            let posture = posture.clone();
            let enough = error + EQUAL_ERROR * length;
            let patience = PATIENCE * time;
            if let Some(rival) = &mut rival {
                let (end, needed) = follow(&mut question, rival, enough, patience, session.stop);
                m.own.push(end, needed / time);
            }
            let Some(mut before) = before else { continue };
            m.units.push(unit.time());
            let starts: Vec<&_> = [Some(&posture), last_optimum.as_ref()].into_iter().flatten().collect();
            if let Some(best) = optimum(&mut question, &starts, session.stop) {
                m.excess.push((error - objective.target_error(&best.x)) / length);
                last_optimum = Some(best);
            }
            if with_baseline {
                let (end, needed) = follow(&mut question, &mut before, enough, patience, session.stop);
                m.handed.push(end, needed / time);
            }
        }
        session.check()?;
        Ok(m)
    }
}

impl Measured {
    fn time_cells(&self) -> Vec<Cell> {
        let unit = Summary::of(self.units.iter().copied()).median;
        let time = Summary::of(self.times.iter().copied());
        let median = |of: &dyn Fn(&[f64; 5]) -> f64| Cell::from(Summary::of(self.phases.iter().map(of)).median);
        let mut cells = vec![time.median.into(), time.p95.into(), time.worst.into()];
        cells.extend((0..5).map(|phase| median(&|p| p[phase])));
        cells.push(Summary::of(self.iterations.iter().copied()).median.into());
        cells.push(Summary::of(self.factorizations.iter().copied()).median.into());
        cells.push(unit.into());
        cells.extend([time.median, time.p95, time.worst].map(|time| Cell::from(time / unit)));
        for comparison in [&self.own, &self.handed] {
            cells.push(match comparison.median() {
                None => Cell::Missing,
                Some((ratio, _)) if ratio.is_infinite() => "never".into(),
                Some((ratio, true)) => Cell::AtLeast(ratio),
                Some((ratio, false)) => ratio.into(),
            });
        }
        cells.extend([End::Reached, End::GaveUp, End::Stalled].map(|end| Cell::from(self.own.count(end))));
        cells
    }

    fn error_cells(&self) -> Vec<Cell> {
        let error = Summary::of(self.errors.iter().copied());
        let excess = Summary::of(self.excess.iter().copied());
        let distance = Summary::of(self.distances.iter().copied());
        vec![
            error.median.into(),
            error.p95.into(),
            error.worst.into(),
            excess.median.into(),
            excess.worst.into(),
            distance.median.into(),
            distance.worst.into(),
            Summary::of(self.claimed.iter().copied()).worst.into(),
            self.not_shown.into(),
        ]
    }
}
