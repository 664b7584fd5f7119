//! `bench wander`: wild drags that come back. Targets jump for a while, up to hundreds of body lengths away, in scenes of every
//! stiffness; then they rest near the body. Every frame must be fit to be shown, and the pose must end where a search from rest
//! ends, whatever the way there.

use super::drags::{places, points, positions, towards};
use super::figures::significant;
use super::posing::{at_rest, distance_from_equilibrium, free_fibers, may_be_shown};
use super::shapes::Subject;
use super::{BenchError, Cell, Quality, Report, Session, Table, Tracker};
use crate::random::Random;
use crate::soft_ik::{Actuation, Objective, Posture, Question};

/// Frames in which the targets jump, frames between jumps, and frames in which they rest.
const WILD_FRAMES: usize = 40;
const JUMP_EVERY: usize = 5;
pub const RESTING_FRAMES: usize = 60;
/// A pose counts as the same where no node is further away than this part of the body.
const SAME: f64 = 1e-3;
/// How far the targets rest from where the body has them at rest, in body lengths, at most.
const NEAR: f64 = 0.1;
/// What scenes are drawn from: fibre stiffness over shear modulus, smoothing over mean fibre length, largest contraction over
/// fibre length.
const STIFFNESSES: [f64; 7] = [0.1, 1.0, 3.0, 10.0, 100.0, 1e3, 1e6];
const SMOOTHINGS: [f64; 4] = [1e-1, 1e-2, 1e-3, 1e-5];
const LIMITS: [f64; 4] = [0.1, 0.3, 0.6, 0.95];

/// Shapes, size and drags of the study.
pub struct Wander {
    pub shapes: Vec<String>,
    pub fibers: usize,
    /// Drags of each shape.
    pub drags: usize,
}

/// A scene, by its figures.
struct Draw {
    stiffness: f64,
    smoothing: f64,
    limit: f64,
    lower: &'static str,
    targets: usize,
    away: f64,
    quality: Quality,
}

/// How a drag went.
struct Course {
    not_showable: usize,
    /// Largest unbalanced force over the forces at work.
    unbalanced: f64,
    /// Resting frames after which the pose stays the one found from rest, and how far it is from that in the end.
    back_after: Option<usize>,
    apart: f64,
    /// Target errors in the end: of the drag, and of the search from rest.
    errors: [f64; 2],
}

impl Wander {
    /// Runs the study.
    ///
    /// # Errors
    /// A shape that cannot be meshed, or the study was cancelled.
    pub fn run(&self, session: &Session) -> Result<Report, BenchError> {
        let headings = [
            "shape",
            "fibres",
            "K/mu",
            "epsilon/l",
            "limit",
            "lower",
            "targets",
            "away",
            "quality",
            "not showable",
            "unbalanced, worst",
            "back after",
            "apart",
            "error",
            "from rest",
        ];
        let title = "Wild drags that come back; lengths in body lengths";
        let mut table = Table::new("wander", title, &headings);
        let (mut drags, mut same, mut shown, mut unbalanced) = (0, 0, 0, 0.0_f64);
        for shape in &self.shapes {
            for number in 0..self.drags {
                session.next(&format!("{shape}, drag {}", number + 1))?;
                let mut subject = Subject::new(shape, self.fibers)?;
                let mut random = Random::of(session.seed, &format!("{} wander", subject.name), number as u64);
                let draw = Draw::random(&mut random);
                let course = draw.drag(&mut subject, &mut random, session)?;
                drags += 1;
                same += usize::from(course.apart <= SAME);
                shown += usize::from(course.not_showable == 0);
                unbalanced = unbalanced.max(course.unbalanced);
                table.push(row(&subject, &draw, &course));
            }
        }
        let remarks = vec![format!(
            "In {shown} of {drags} drags every frame could be shown (finite, uninverted, within the limits); the largest unbalanced \
             force is {} of the forces at work. {same} of {drags} end within {} of the pose that a search from rest finds in \
             {RESTING_FRAMES} frames.",
            significant(unbalanced),
            significant(SAME)
        )];
        let title = format!(
            "{WILD_FRAMES} frames with jumps of up to hundreds of body lengths, then {RESTING_FRAMES} at rest; seed {}",
            session.seed
        );
        Ok(Report { title, tables: vec![table], remarks, plots: Vec::new() })
    }
}

impl Draw {
    fn random(random: &mut Random) -> Self {
        Self {
            stiffness: STIFFNESSES[random.index(STIFFNESSES.len())],
            smoothing: SMOOTHINGS[random.index(SMOOTHINGS.len())],
            limit: LIMITS[random.index(LIMITS.len())],
            lower: ["none", "zero", "minus"][random.index(3)],
            targets: 1 + random.index(4),
            // 0.3 to 1000 body lengths.
            away: 10.0_f64.powf(random.between(-0.5, 3.0)),
            quality: Quality::ALL[random.index(Quality::ALL.len())],
        }
    }

    /// Gives the fibres of a plushie their stiffness, smoothing and limits.
    fn dress(&self, subject: &mut Subject) {
        let plushie = &mut subject.plushie;
        let mu = plushie.model.body.material().shear_modulus();
        let elements = &mut plushie.model.contractile.elements;
        let mean = elements.iter().map(|e| e.alpha0).sum::<f64>() / elements.len().max(1) as f64;
        for element in elements.iter_mut() {
            element.stiffness = self.stiffness * mu;
            element.epsilon = self.smoothing * mean;
        }
        for winch in &mut plushie.fibers {
            let most = self.limit * elements[winch.members[0].0].alpha0;
            winch.upper = most;
            winch.lower = match self.lower {
                "none" => f64::NEG_INFINITY,
                "zero" => 0.0,
                _ => -most,
            };
        }
    }

    fn drag(&self, subject: &mut Subject, random: &mut Random, session: &Session) -> Result<Course, BenchError> {
        self.dress(subject);
        let at = points(subject, &places(&subject.name, self.targets, random)?);
        let mut objective = towards(subject, &at, &vec![[0.0; 2]; self.targets]);
        let length = subject.length();
        let mut near = positions(&objective, &subject.plushie.model.rest);
        scatter(&mut near, NEAR * length, random);
        let jumps: Vec<_> = (0..WILD_FRAMES / JUMP_EVERY)
            .map(|_| {
                let mut goals = near.clone();
                scatter(&mut goals, self.away * length, random);
                goals
            })
            .collect();
        let actuation = free_fibers(subject);
        let model = &mut subject.plushie.model;
        let mut run = |objective: &mut Objective, wild: usize| -> Result<(Course, Vec<Posture>), BenchError> {
            let mut course =
                Course { not_showable: 0, unbalanced: 0.0, back_after: None, apart: 0.0, errors: [0.0; 2] };
            let mut resting = Vec::new();
            let mut question = Question { model, actuation: &actuation, objective };
            let rest = at_rest(&mut question, session.stop);
            let mut tracker = Tracker::new(&mut question, &rest);
            for frame in 0..wild + RESTING_FRAMES {
                session.check()?;
                let goals = if frame < wild { &jumps[frame / JUMP_EVERY] } else { &near };
                for (target, goal) in objective.targets.iter_mut().zip(goals) {
                    target.goal = *goal;
                }
                let mut question = Question { model, actuation: &actuation, objective };
                tracker.frame(&mut question, self.quality, session.stop);
                let posture = tracker.posture();
                let fit = may_be_shown(question.model, posture) && within_limits(&actuation, posture);
                course.not_showable += usize::from(!fit);
                let distance = distance_from_equilibrium(question.model, &actuation, posture);
                course.unbalanced = course.unbalanced.max(distance);
                if frame >= wild {
                    resting.push(posture.clone());
                }
            }
            Ok((course, resting))
        };
        let (mut course, resting) = run(&mut objective, WILD_FRAMES)?;
        let (_, afresh) = run(&mut objective, 0)?;
        let (Some(last), Some(goal)) = (resting.last(), afresh.last()) else { return Ok(course) };
        let same = resting.iter().rev().take_while(|p| apart(&p.x, &goal.x) <= SAME * length).count();
        course.back_after = (same > 0).then_some(RESTING_FRAMES - same);
        course.apart = apart(&last.x, &goal.x) / length;
        course.errors = [last, goal].map(|p| objective.target_error(&p.x) / length);
        Ok(course)
    }
}

fn row(subject: &Subject, draw: &Draw, course: &Course) -> Vec<Cell> {
    vec![
        subject.name.clone().into(),
        subject.fibers().into(),
        draw.stiffness.into(),
        draw.smoothing.into(),
        draw.limit.into(),
        draw.lower.into(),
        draw.targets.into(),
        draw.away.into(),
        format!("{:?}", draw.quality).to_lowercase().into(),
        course.not_showable.into(),
        course.unbalanced.into(),
        course.back_after.map_or(Cell::Missing, Cell::from),
        course.apart.into(),
        course.errors[0].into(),
        course.errors[1].into(),
    ]
}

/// Moves every point by up to `most` along each axis.
fn scatter(points: &mut [[f64; 2]], most: f64, random: &mut Random) {
    for value in points.iter_mut().flatten() {
        *value += random.between(-most, most);
    }
}

fn within_limits(actuation: &Actuation, posture: &Posture) -> bool {
    actuation.winches.iter().zip(&posture.beta).all(|(w, b)| *b >= w.lower - 1e-12 && *b <= w.upper + 1e-12)
}

/// Distance of the nodes that are furthest apart.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    let pairs = a.chunks_exact(2).zip(b.chunks_exact(2));
    pairs.map(|(p, q)| (p[0] - q[0]).hypot(p[1] - q[1])).fold(0.0, f64::max)
}
