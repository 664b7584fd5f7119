//! `bench scene`: what each optional part of a scene costs per frame when it is present, and that it costs nothing when absent.
//!
//! All scenes are dragged along the same path in one run, frame by frame in turn, so that whatever else the machine does falls
//! on all of them alike. The first row is measured twice, as two scenes: their ratio is the noise.

use super::drags::{Path, goals, places, points, towards};
use super::posing::{at_rest, free_fibers};
use super::shapes::{Subject, original};
use super::statistics::Summary;
use super::{BenchError, Quality, Report, Session, Table, Tracker};
use crate::design::{Design, Gravity, Target};
use crate::engine::{self, Request, Solver};
use crate::mesh::BodyPoint;
use crate::outline::Point;
use crate::physics::{StVenantKirchhoff, StaticsSettings, statics};
use crate::random::Random;
use crate::soft_ik::{Actuation, Question};
use std::sync::Arc;
use std::time::Instant;

/// Weight of the plushie in the scene with gravity, as a part of shear modulus times body length: it bends visibly.
const WEIGHT: f64 = 0.01;
/// m/s^2.
const STANDARD_GRAVITY: f64 = 9.81;
/// Part of its range that every fixed winch is wound.
const WOUND: f64 = 0.3;
const TARGETS: usize = 4;

/// Shapes and frames of the study. Shapes are the bundled designs on their own meshes, since networks belong to those.
pub struct Scene {
    pub shapes: Vec<String>,
    pub frames: usize,
}

/// Makes one frame with these goals.
type MakeFrame<'a> = Box<dyn FnMut(&[Point]) + 'a>;

/// A scene: what is in it, how one frame of it is made, and the times so far, ms.
struct Run<'a> {
    what: &'static str,
    frame: MakeFrame<'a>,
    times: Vec<f64>,
}

impl Scene {
    /// Runs the study.
    ///
    /// # Errors
    /// A shape that cannot be meshed, or the study was cancelled.
    pub fn run(&self, session: &Session) -> Result<Report, BenchError> {
        let mut table = Table::new(
            "scene",
            "Time of a frame, ms, and its ratio to the first scene of the shape (median of the ratios frame by frame)",
            &["shape", "scene", "median", "p95", "ratio"],
        );
        for shape in &self.shapes {
            session.next(shape)?;
            let design = original(shape)?;
            let bare = Design { networks: Vec::new(), keyframes: Vec::new(), ..design.clone() };
            let mut subject = Subject::of(shape, bare.clone())?;
            let mut random = Random::of(session.seed, &format!("{shape} scene"), 0);
            let at = points(&subject, &places(shape, TARGETS, &mut random)?);
            let path = goals(&mut subject, &at, Path::Reachable, self.frames, session)?;
            let mut runs = scenes(shape, &design, &bare, &at, session)?;
            for goals in &path {
                for run in &mut runs {
                    session.check()?;
                    let clock = Instant::now();
                    (run.frame)(goals);
                    run.times.push(1e3 * clock.elapsed().as_secs_f64());
                }
            }
            let base = runs.first().map(|run| run.times.clone()).unwrap_or_default();
            for run in &runs {
                let time = Summary::of(run.times.iter().copied());
                let ratio = Summary::of(run.times.iter().zip(&base).map(|(a, b)| a / b)).median;
                table.push(vec![
                    shape.clone().into(),
                    run.what.into(),
                    time.median.into(),
                    time.p95.into(),
                    ratio.into(),
                ]);
            }
        }
        let title = format!(
            "Scenes dragged for {} frames with {TARGETS} targets, seed {}, one thread",
            self.frames, session.seed
        );
        Ok(Report { title, tables: vec![table], ..Default::default() })
    }
}

fn scenes<'a>(
    shape: &str,
    design: &Design,
    bare: &Design,
    at: &'a [BodyPoint],
    session: &'a Session,
) -> Result<Vec<Run<'a>>, BenchError> {
    let heavy = Design { gravity: Some(gravity(bare)), ..bare.clone() };
    let mu = bare.material.shear_modulus();
    let other = Design { material: StVenantKirchhoff { mu, lambda: mu }.into(), ..bare.clone() };
    let tracked = |what, design: &Design| tracked(what, shape, design.clone(), at, session);
    Ok(vec![
        tracked("fibres, no gravity, no winches", bare)?,
        tracked("the same again (noise)", bare)?,
        tracked("with gravity", &heavy)?,
        tracked("with winches, fixed", design)?,
        tracked("St. Venant-Kirchhoff material", &other)?,
        without_targets("no targets: statics alone", shape, bare.clone(), session)?,
        viewed("studio frame: idealized view, no winches", bare, [true, false], at),
        viewed("studio frame: idealized view, with winches", design, [true, false], at),
        viewed("studio frame: realizable view alone", design, [false, true], at),
        viewed("studio frame: both views", design, [true, true], at),
        viewed("studio frame: both views hidden", design, [false, false], at),
    ])
}

/// A scene under the tracker; winches of the design stay where they are, wound by [`WOUND`] of their range.
fn tracked<'a>(
    what: &'static str,
    shape: &str,
    design: Design,
    at: &'a [BodyPoint],
    session: &'a Session,
) -> Result<Run<'a>, BenchError> {
    let mut subject = Subject::of(shape, design)?;
    let plushie = &subject.plushie;
    let count = plushie.fiber_elements.end;
    let all = Actuation { winches: plushie.winches.clone(), fixed: vec![0.0; count] };
    let wound: Vec<f64> = plushie.winches.iter().map(|w| WOUND * w.upper).collect();
    let actuation = Actuation { fixed: all.contractions(&wound), ..free_fibers(&subject) };
    let mut tracker: Option<Tracker> = None;
    let frame = move |goals: &[Point]| {
        let objective = towards(&subject, at, goals);
        let mut question = Question { model: &mut subject.plushie.model, actuation: &actuation, objective: &objective };
        if tracker.is_none() {
            let rest = at_rest(&mut question, session.stop);
            tracker = Some(Tracker::new(&mut question, &rest));
        }
        if let Some(tracker) = &mut tracker {
            tracker.frame(&mut question, Quality::Balanced, session.stop);
        }
    };
    Ok(Run { what, frame: Box::new(frame), times: Vec::new() })
}

/// Statics from the state before, nothing to pose.
fn without_targets<'a>(
    what: &'static str,
    shape: &str,
    design: Design,
    session: &'a Session,
) -> Result<Run<'a>, BenchError> {
    let mut subject = Subject::of(shape, design)?;
    let mut x = subject.plushie.model.rest.clone();
    let frame = move |_: &[Point]| {
        if let Ok(state) = statics::solve(&mut subject.plushie.model, &x, &StaticsSettings::default(), session.stop) {
            x = state.x;
        }
    };
    Ok(Run { what, frame: Box::new(frame), times: Vec::new() })
}

/// A frame as the studio asks for it, with the views `[idealized, realizable]` shown.
fn viewed<'a>(what: &'static str, design: &Design, show: [bool; 2], at: &'a [BodyPoint]) -> Run<'a> {
    let design = Arc::new(design.clone());
    let mut solver = Solver::default();
    let cancel = std::sync::atomic::AtomicBool::new(false);
    let frame = move |goals: &[Point]| {
        let targets = at.iter().zip(goals).map(|(at, to)| Target { at: *at, to: *to, weight: 1.0 }).collect();
        let setpoint = engine::Setpoint::Targets(targets);
        let [show_idealized, show_realizable] = show;
        let quality = Quality::Balanced;
        let request = Request { id: 0, design: design.clone(), setpoint, quality, show_idealized, show_realizable };
        solver.solve(&request, &cancel);
    };
    Run { what, frame: Box::new(frame), times: Vec::new() }
}

/// Gravity across the body that gives it [`WEIGHT`].
fn gravity(design: &Design) -> Gravity {
    let mu = design.material.shear_modulus();
    let surface_density = WEIGHT * mu * design.body_length_mm() / (STANDARD_GRAVITY * design.mesh.area());
    Gravity { acceleration: [0.0, -STANDARD_GRAVITY], surface_density }
}
