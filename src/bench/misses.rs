//! `bench cold` over many scenes: how often is the best pose missed?
//!
//! A scene is a bundled shape or one that is made from the seed ([`silhouettes`]), at rest, and one to six targets 8 to 45 % of the body
//! length away. Three answers to it are compared with the best pose known: that of `soft_ik`'s default method, what a
//! drag shows after `EARLY` factorisations, and what it shows after `PATIENT` frames in which the hand rests. Best known is the
//! best of all that many starts lead to, the paper's gradient method among them.

use super::drags::{places_on, points, positions, towards};
use super::figures::significant;
use super::posing::{at_rest, free_fibers, optimum};
use super::shapes::{Field, Subject, design, names};
use super::statistics::{Summary, wilson};
use super::{BenchError, Cell, Quality, Report, Session, Table, Tracker, silhouettes};
use crate::random::Random;
use crate::soft_ik::gradient::Gradient;
use crate::soft_ik::tension::AllAtOnce;
use crate::soft_ik::{self, Budget, Method, Posture, Question};

/// How far targets are, in body lengths, and how many there are at most.
const DISTANCES: [f64; 2] = [0.08, 0.45];
const MOST_TARGETS: usize = 6;
/// Factorisations after which a drag is looked at, and the longest run that is begun to find when it was good, iterations.
const EARLY: usize = 40;
const LONGEST: usize = 120;
/// Frames of rest after which it is looked at again.
const PATIENT: usize = 60;
/// Frames in which targets are moved to their goals, for another start.
const SLOW: usize = 24;
/// Missing parts of the possible decrease: what counts as good, and what is never to happen.
const GOOD: f64 = 0.01;
const BAD: f64 = 0.05;
/// Iterations of the default method, of the gradient method from rest and from the best pose, and random starts.
const DEFAULT_ITERATIONS: usize = 300;
const GRADIENT_ITERATIONS: [usize; 2] = [150, 40];
const STARTS: usize = 6;
/// Strength of the random contractions, as a part of what is allowed.
const STRENGTH: f64 = 0.9;

/// Size and scenes of the study.
pub struct Misses {
    pub fibers: usize,
    /// Number of the first scene, and how many.
    pub first: usize,
    pub scenes: usize,
}

/// What became of a scene: missing parts of the possible decrease.
struct Scene {
    kind: String,
    fibers: usize,
    targets: usize,
    rest: f64,
    best: f64,
    /// Which start led to the best pose.
    by: String,
    solve: f64,
    early: f64,
    patient: f64,
    /// Factorisations from which on a drag misses no more than [`GOOD`].
    needed: Option<usize>,
}

impl Misses {
    /// Runs the study.
    ///
    /// # Errors
    /// A shape that cannot be meshed, or the study was cancelled.
    pub fn run(&self, session: &Session) -> Result<Report, BenchError> {
        let mut scenes = Vec::new();
        for number in self.first..self.first + self.scenes {
            let kinds = [names(), silhouettes::FAMILIES.map(str::to_owned).to_vec()].concat();
            let kind = &kinds[number % kinds.len()];
            session.next(&format!("scene {number}, {kind}"))?;
            scenes.push(self.scene(kind, number, session)?);
        }
        let title = format!("Seeded scenes of about {} fibres, seed {}", self.fibers, session.seed);
        let remarks = vec![
            rate("solve", &scenes, |s| s.solve),
            rate(&format!("drag, {EARLY} factorisations"), &scenes, |s| s.early),
            rate(&format!("drag, {PATIENT} frames of rest"), &scenes, |s| s.patient),
            format!(
                "Median to 1 %: {} factorisations.",
                significant(Summary::of(scenes.iter().map(|s| s.needed.map_or(f64::INFINITY, |k| k as f64))).median)
            ),
        ];
        Ok(Report { title, tables: vec![table(self.first, &scenes)], remarks, plots: Vec::new() })
    }

    fn scene(&self, kind: &str, number: usize, session: &Session) -> Result<Scene, BenchError> {
        let mut random = Random::of(session.seed, "cold scene", number as u64);
        let design = match silhouettes::FAMILIES.contains(&kind) {
            true => silhouettes::design(kind, self.fibers, &mut random)?,
            false => design(kind, self.fibers)?,
        };
        let mut subject = Subject::of(kind, design)?;
        let count = 1 + random.index(MOST_TARGETS);
        let at = points(&subject, &places_on(&subject.design, kind, count, &mut random)?);
        let begin = positions(&towards(&subject, &at, &vec![[0.0; 2]; count]), &subject.plushie.model.rest);
        let goals: Vec<_> = begin
            .iter()
            .map(|p| {
                let away = random.between(DISTANCES[0], DISTANCES[1]) * subject.length();
                let d = random.direction();
                [p[0] + away * d[0], p[1] + away * d[1]]
            })
            .collect();
        let objective = towards(&subject, &at, &goals);
        let starts: Vec<Vec<f64>> = (0..STARTS).map(|_| start(&subject, &mut random)).collect();
        let actuation = free_fibers(&subject);
        let mut question = Question { model: &mut subject.plushie.model, actuation: &actuation, objective: &objective };
        let found = judge(&mut question, &starts, session)?;
        Ok(Scene { kind: kind.to_owned(), fibers: actuation.winches.len(), targets: count, ..found })
    }
}

/// The best pose known so far, and which start led to it.
struct Known {
    posture: Posture,
    by: String,
}

impl Known {
    fn note(&mut self, posture: &Posture, by: String) {
        if posture.in_equilibrium() && posture.objective < self.posture.objective {
            *self = Self { posture: posture.clone(), by };
        }
    }
}

/// Random smooth activations of the fibres.
fn start(subject: &Subject, random: &mut Random) -> Vec<f64> {
    let field = Field::random(random, &subject.design.mesh.nodes, subject.length());
    let contractions = subject.contractions(&field, STRENGTH);
    subject.plushie.fibers.iter().map(|w| contractions[w.members[0].0] / w.members[0].1).collect()
}

/// All answers to a question, and the best pose known.
fn judge(question: &mut Question, starts: &[Vec<f64>], session: &Session) -> Result<Scene, BenchError> {
    let stop = session.stop;
    let rest = at_rest(question, stop);
    let course = course(question, &rest, stop);
    let shown = rested(question, &rest, stop);
    let zero = vec![0.0; question.actuation.winches.len()];
    let solved = soft_ik::solve(question, &zero, &Budget { iterations: DEFAULT_ITERATIONS, stop }).posture;
    session.check()?;

    let mut known = Known { posture: rest.clone(), by: "rest".into() };
    known.note(&shown, "frames of rest".into());
    known.note(&solved, "solve".into());
    for posture in course.iter().map(|(_, posture)| posture) {
        known.note(posture, "drag".into());
    }
    let slope = |question: &mut Question, from: &Posture, iterations: usize| {
        Gradient::default().solve(question, from, &Budget { iterations, stop }).posture
    };
    let descended = slope(question, &rest, GRADIENT_ITERATIONS[0]);
    known.note(&descended, "gradient".into());
    let dragged = dragged(question, &rest, stop);
    known.note(&dragged, "slow drag".into());
    let settled: Vec<Posture> = starts
        .iter()
        .map(|beta| {
            let x = question.model.rest.clone();
            question.settle(beta, &x, stop).0
        })
        .collect();
    let named = [
        (&rest, "rest"),
        (&shown, "frames of rest"),
        (&solved, "solve"),
        (&descended, "gradient"),
        (&dragged, "slow drag"),
    ];
    let named = named.map(|(from, name)| (from, format!("on from {name}")));
    let random = settled.iter().enumerate().map(|(k, from)| (from, format!("random start {k}")));
    for (from, by) in named.into_iter().chain(random) {
        if let Some(posture) = optimum(question, &[from], stop) {
            known.note(&posture, by);
        }
        session.check()?;
    }
    let last = slope(question, &known.posture, GRADIENT_ITERATIONS[1]);
    let by = format!("{}, gradient", known.by);
    known.note(&last, by);

    let Known { posture: Posture { objective: best, .. }, by } = known;
    let missing = |o: f64| (o - best) / (rest.objective - best).max(f64::MIN_POSITIVE);
    let courses: Vec<(usize, f64)> = course.iter().map(|(k, p)| (*k, missing(p.objective))).collect();
    Ok(Scene {
        kind: String::new(),
        fibers: 0,
        targets: 0,
        rest: rest.objective,
        best,
        by,
        solve: missing(solved.objective),
        early: courses.iter().take_while(|c| c.0 <= EARLY).last().map_or(1.0, |c| c.1),
        patient: missing(shown.objective),
        // From there on it stays good.
        needed: courses.iter().rev().take_while(|c| c.1 <= GOOD).last().map(|c| c.0),
    })
}

/// The poses that ever longer runs from rest lead to, by the factorisations that each took, settling included.
fn course(question: &mut Question, rest: &Posture, stop: &dyn Fn() -> bool) -> Vec<(usize, Posture)> {
    let mut course = Vec::new();
    let mut iterations = 1;
    while iterations <= LONGEST && !stop() {
        let answer = AllAtOnce::default().solve(question, rest, &Budget { iterations, stop });
        course.push((answer.factorizations, answer.posture));
        if answer.converged {
            break;
        }
        iterations += 1 + iterations / EARLY;
    }
    course.sort_by_key(|c| c.0);
    course
}

/// What is shown after [`PATIENT`] frames towards the same targets, settled.
fn rested(question: &mut Question, rest: &Posture, stop: &dyn Fn() -> bool) -> Posture {
    let mut tracker = Tracker::new(question, rest);
    for _ in 0..PATIENT {
        tracker.frame(question, Quality::Balanced, stop);
    }
    let shown = tracker.posture().clone();
    question.settle(&shown.beta, &shown.x, stop).0
}

/// Where the targets lead that are moved to their goals in [`SLOW`] frames, settled.
fn dragged(question: &mut Question, rest: &Posture, stop: &dyn Fn() -> bool) -> Posture {
    let mut tracker = Tracker::new(question, rest);
    let mut moved = question.objective.clone();
    let begin = positions(question.objective, &rest.x);
    for frame in 1..=SLOW {
        let part = frame as f64 / SLOW as f64;
        for ((target, from), to) in moved.targets.iter_mut().zip(&begin).zip(&question.objective.targets) {
            target.goal = [0, 1].map(|axis| from[axis] + part * (to.goal[axis] - from[axis]));
        }
        let mut question = Question { model: &mut *question.model, actuation: question.actuation, objective: &moved };
        tracker.frame(&mut question, Quality::Balanced, stop);
    }
    let shown = tracker.posture().clone();
    question.settle(&shown.beta, &shown.x, stop).0
}

/// How often an answer is good, with what 300 scenes can say about it, and how much it misses at worst.
fn rate(what: &str, scenes: &[Scene], missing: impl Fn(&Scene) -> f64) -> String {
    let good = scenes.iter().filter(|s| missing(s) <= GOOD).count();
    let bad = scenes.iter().filter(|s| missing(s) > BAD).count();
    let (low, high) = wilson(good, scenes.len());
    let worst = Summary::of(scenes.iter().map(&missing)).worst;
    format!(
        "{what}: {good} of {} within 1 % ({:.1} to {:.1} % with 95 % confidence); {bad} miss more than 5 %, the worst {}.",
        scenes.len(),
        100.0 * low,
        100.0 * high,
        significant(worst)
    )
}

fn table(first: usize, scenes: &[Scene]) -> Table {
    let headings =
        ["scene", "shape", "fibres", "targets", "O rest", "O best", "found by", "solve", "early", "rested", "to 1 %"];
    let mut table = Table::new("misses", "Missing part (O - O best) / (O rest - O best); O in mm^2", &headings);
    for (k, s) in scenes.iter().enumerate() {
        let mut row: Vec<Cell> = vec![(first + k).into(), s.kind.clone().into(), s.fibers.into(), s.targets.into()];
        row.extend([Cell::from(s.rest), s.best.into(), s.by.clone().into()]);
        row.extend([s.solve, s.early, s.patient].map(Cell::from));
        row.push(s.needed.map_or(Cell::AtLeast(LONGEST as f64), Cell::from));
        table.push(row);
    }
    table
}
