//! `bench trade`: error against time over mesh resolution, Newton tolerance (statics) and quality (posing), and which settings are
//! dominated: another is at least as fast and at least as exact.
//!
//! Errors are rms distances of common body points from a converged reference on a much finer mesh, in body lengths.

use super::drags::towards;
use super::locking;
use super::plot::{Plot, Series};
use super::posing::{at_rest, free_fibers, optimum};
use super::shapes::{Field, Subject, original};
use super::statistics::{Summary, pareto_front};
use super::{BenchError, Quality, Report, Session, Table, Tracker};
use crate::design::{Design, Target};
use crate::mesh::BodyPoint;
use crate::outline::Point;
use crate::physics::{StaticsSettings, statics};
use crate::random::Random;
use crate::soft_ik::Question;
use std::time::Instant;

/// Newton tolerances of statics: unbalanced force over forces at work.
const TOLERANCES: [f64; 5] = [1e-1, 1e-2, 1e-4, 1e-8, 1e-12];
/// Repetitions of a solve that is timed.
const REPEATS: usize = 5;
/// Frames in which the targets move from rest to the pose.
const FRAMES: usize = 30;
/// Part of the allowed contraction that loads the body in statics.
const STRENGTH: f64 = 0.5;

/// Shapes and sizes of the study.
pub struct Trade {
    pub shapes: Vec<String>,
    pub fibers: Vec<usize>,
    /// Fibres of the reference mesh.
    pub reference: usize,
}

/// One setting of the trade.
struct Setting {
    shape: String,
    fibers: usize,
    choice: String,
    milliseconds: f64,
    error: f64,
}

/// Places of the body at which meshes are compared: the nodes of the bundled mesh, at rest.
pub struct Common {
    places: Vec<Point>,
}

impl Common {
    /// The places at which poses of all resolutions are compared: nodes of the bundled mesh.
    ///
    /// # Errors
    /// A name that is no shape.
    pub fn of(shape: &str) -> Result<Self, BenchError> {
        Ok(Self { places: original(shape)?.mesh.nodes.clone() })
    }

    pub fn places(&self) -> &[Point] {
        &self.places
    }

    /// Where the places are when the nodes of `design` are at `x`.
    pub fn positions(&self, design: &Design, x: &[f64]) -> Vec<Point> {
        let mesh = &design.mesh;
        let nodes: Vec<Point> = x.chunks_exact(2).map(|p| [p[0], p[1]]).collect();
        let at = |p: &Point| mesh.locate_nearest(*p, &mesh.nodes).map_or(*p, |(at, _)| mesh.position(&at, &nodes));
        self.places.iter().map(at).collect()
    }
}

/// Root mean square distance of paired points.
pub fn rms(a: &[Point], b: &[Point]) -> f64 {
    let sum: f64 = a.iter().zip(b).map(|(p, q)| (p[0] - q[0]).powi(2) + (p[1] - q[1]).powi(2)).sum();
    (sum / a.len().max(1) as f64).sqrt()
}

impl Trade {
    /// Runs the study: statics, then posing, on every shape.
    ///
    /// # Errors
    /// A shape that cannot be meshed or posed, or the study was cancelled.
    pub fn run(&self, session: &Session) -> Result<Report, BenchError> {
        let (mut statics, mut posing) = (Vec::new(), Vec::new());
        for shape in &self.shapes {
            let common = Common::of(shape)?;
            self.statics(shape, &common, &mut statics, session)?;
            self.posing(shape, &common, &mut posing, session)?;
        }
        let mut report = Report {
            title: format!("Error against time, reference at {} fibres, seed {}", self.reference, session.seed),
            ..Default::default()
        };
        let parts = [
            ("statics", "tolerance", "Statics from rest under a smooth contraction of all fibres", statics),
            ("posing", "quality", "A frame towards the first pose of the design, reached in 30 frames", posing),
        ];
        for (name, choice, caption, settings) in parts {
            report.tables.push(table(name, choice, caption, &settings));
            report.plots.push(plot(name, caption, &settings));
            report.remarks.extend(verdict(name, &settings));
        }
        let locked = locking::Locking { edges: self.fibers.clone() };
        let (table, plot) = locked.run(session)?;
        report.tables.push(table);
        report.plots.push(plot);
        Ok(report)
    }

    fn statics(
        &self,
        shape: &str,
        common: &Common,
        out: &mut Vec<Setting>,
        session: &Session,
    ) -> Result<(), BenchError> {
        let mut random = Random::of(session.seed, &format!("{shape} trade"), 0);
        let field = Field::random(&mut random, &original(shape)?.mesh.nodes, original(shape)?.body_length_mm());
        session.next(&format!("{shape}, statics, reference"))?;
        let mut fine = Subject::new(shape, self.reference)?;
        let contractions = fine.contractions(&field, STRENGTH);
        let rest = fine.plushie.model.rest.clone();
        let x = fine.settle(&contractions, &rest, session.stop)?;
        let reference = common.positions(&fine.design, &x);
        for &fibers in &self.fibers {
            session.next(&format!("{shape}, statics, {fibers} fibres"))?;
            let mut subject = Subject::new(shape, fibers)?;
            let contractions = subject.contractions(&field, STRENGTH);
            subject.plushie.model.contractile.set_contractions(&contractions);
            let rest = subject.plushie.model.rest.clone();
            for tolerance in TOLERANCES {
                let settings = StaticsSettings { tolerance, ..StaticsSettings::default() };
                let mut times = Vec::new();
                let mut x = rest.clone();
                for _ in 0..REPEATS {
                    session.check()?;
                    let clock = Instant::now();
                    let solved = statics::solve(&mut subject.plushie.model, &rest, &settings, session.stop);
                    times.push(1e3 * clock.elapsed().as_secs_f64());
                    x = solved.map_or_else(|e| e.best.x, |s| s.x);
                }
                let error = rms(&common.positions(&subject.design, &x), &reference) / subject.length();
                out.push(Setting {
                    shape: shape.to_owned(),
                    fibers: subject.fibers(),
                    choice: format!("{tolerance:.0e}"),
                    milliseconds: Summary::of(times).median,
                    error,
                });
            }
        }
        Ok(())
    }

    fn posing(
        &self,
        shape: &str,
        common: &Common,
        out: &mut Vec<Setting>,
        session: &Session,
    ) -> Result<(), BenchError> {
        session.next(&format!("{shape}, posing, reference"))?;
        let mut fine = Subject::new(shape, self.reference)?;
        let x = pose(&mut fine, session)?;
        let reference = common.positions(&fine.design, &x);
        for &fibers in &self.fibers {
            session.next(&format!("{shape}, posing, {fibers} fibres"))?;
            let mut subject = Subject::new(shape, fibers)?;
            for quality in Quality::ALL {
                let (times, x) = frames(&mut subject, quality, session)?;
                out.push(Setting {
                    shape: shape.to_owned(),
                    fibers: subject.fibers(),
                    choice: format!("{quality:?}").to_lowercase(),
                    milliseconds: Summary::of(times).median,
                    error: rms(&common.positions(&subject.design, &x), &reference) / subject.length(),
                });
            }
        }
        Ok(())
    }
}

/// The targets of the first pose of a design: points and goals, mm.
///
/// # Errors
/// A design without a pose that has targets.
pub fn first_pose(design: &Design) -> Result<(Vec<BodyPoint>, Vec<Point>), BenchError> {
    let targets: &[Target] = design.poses.first().map_or(&[], |pose| &pose.targets);
    if targets.is_empty() {
        return Err(BenchError::Nothing(format!("{} has no pose with targets", design.name)));
    }
    Ok(targets.iter().map(|t| (t.at, t.to)).unzip())
}

/// The converged optimum of the first pose.
///
/// # Errors
/// A design without a pose that has targets, or the study was cancelled.
pub fn pose(subject: &mut Subject, session: &Session) -> Result<Vec<f64>, BenchError> {
    let (at, goals) = first_pose(&subject.design)?;
    let objective = towards(subject, &at, &goals);
    let actuation = free_fibers(subject);
    let mut question = Question { model: &mut subject.plushie.model, actuation: &actuation, objective: &objective };
    let rest = at_rest(&mut question, session.stop);
    let best = optimum(&mut question, &[&rest], session.stop);
    session.check()?;
    let lost = || BenchError::Nothing(format!("{}: the pose has no equilibrium", subject.name));
    best.map(|posture| posture.x).ok_or_else(lost)
}

/// The first pose under the hand: the targets move there in [`FRAMES`] frames. Times of the frames, ms, and the last state.
fn frames(subject: &mut Subject, quality: Quality, session: &Session) -> Result<(Vec<f64>, Vec<f64>), BenchError> {
    let (at, goals) = first_pose(&subject.design)?;
    let begin: Vec<Point> = at.iter().map(|at| subject.design.mesh.position(at, &subject.design.mesh.nodes)).collect();
    let actuation = free_fibers(subject);
    let mut tracker: Option<Tracker> = None;
    let mut times = Vec::new();
    for frame in 1..=FRAMES {
        session.check()?;
        let s = frame as f64 / FRAMES as f64;
        let between = begin.iter().zip(&goals).map(|(p, q)| [p[0] + s * (q[0] - p[0]), p[1] + s * (q[1] - p[1])]);
        let objective = towards(subject, &at, &between.collect::<Vec<_>>());
        let mut question = Question { model: &mut subject.plushie.model, actuation: &actuation, objective: &objective };
        if tracker.is_none() {
            let rest = at_rest(&mut question, session.stop);
            tracker = Some(Tracker::new(&mut question, &rest));
        }
        if let Some(tracker) = &mut tracker {
            let clock = Instant::now();
            tracker.frame(&mut question, quality, session.stop);
            times.push(1e3 * clock.elapsed().as_secs_f64());
        }
    }
    let x = tracker.map(|t| t.posture().x.clone()).unwrap_or_default();
    Ok((times, x))
}

fn points(settings: &[Setting]) -> Vec<(f64, f64)> {
    settings.iter().map(|s| (s.milliseconds, s.error)).collect()
}

fn table(name: &str, choice: &str, caption: &str, settings: &[Setting]) -> Table {
    let mut table = Table::new(name, caption, &["shape", "fibres", choice, "ms", "error", "dominated"]);
    for shape in settings.chunk_by(|a, b| a.shape == b.shape) {
        for (s, best) in shape.iter().zip(pareto_front(&points(shape))) {
            table.push(vec![
                s.shape.clone().into(),
                s.fibers.into(),
                s.choice.clone().into(),
                s.milliseconds.into(),
                s.error.into(),
                if best { "" } else { "yes" }.into(),
            ]);
        }
    }
    table
}

fn plot(name: &str, caption: &str, settings: &[Setting]) -> Plot {
    let mut series: Vec<Series> = Vec::new();
    for part in settings.chunk_by(|a, b| a.shape == b.shape && a.fibers == b.fibers) {
        series.push(Series::line(format!("{}, {} fibres", part[0].shape, part[0].fibers), points(part)));
    }
    Plot {
        name: format!("trade-{name}"),
        title: caption.to_owned(),
        x_label: "ms".into(),
        y_label: "error, body lengths".into(),
        log_x: true,
        log_y: true,
        series,
    }
}

/// Which settings nothing beats.
fn verdict(name: &str, settings: &[Setting]) -> Vec<String> {
    let front = |shape: &[Setting]| {
        let kept = shape.iter().zip(pareto_front(&points(shape))).filter(|(_, best)| *best);
        let kept: Vec<String> = kept.map(|(s, _)| format!("{} fibres {}", s.fibers, s.choice)).collect();
        format!("{name}, {}: not dominated are {}.", shape[0].shape, kept.join(", "))
    };
    settings.chunk_by(|a, b| a.shape == b.shape).map(front).collect()
}
