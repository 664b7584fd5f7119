//! Seeded targets and the paths they are dragged along.
//!
//! The dragged points are nodes of the bundled design's own mesh, carried to other meshes by their rest positions, so that
//! all resolutions are asked the same. A *reachable* path is read off equilibria under a smooth random contraction that is
//! swept sinusoidally; an *unreachable* one leads a body length away and back.

use super::shapes::{Field, Subject, carry, original};
use super::{BenchError, Session};
use crate::design::{Design, Target};
use crate::engine::compile::objective;
use crate::mesh::BodyPoint;
use crate::outline::Point;
use crate::random::Random;
use crate::soft_ik::Objective;
use std::f64::consts::TAU;

/// Frames of one sweep: two seconds at 60 Hz. A shorter drag is the beginning of it, at the same speed.
pub const SWEEP_FRAMES: usize = 120;
/// How far an unreachable path leads, in body lengths.
const UNREACHABLE: f64 = 1.0;
/// Share of the allowed contraction at the height of a reachable sweep.
const STRENGTH: f64 = 0.8;
/// Wanted distances of dragged points from pins and from each other, in body lengths; shortened until enough points are found.
const FROM_PINS: f64 = 0.15;
const APART: f64 = 0.1;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Path {
    Reachable,
    Unreachable,
}

impl Path {
    pub fn name(self) -> &'static str {
        match self {
            Self::Reachable => "reachable",
            Self::Unreachable => "unreachable",
        }
    }
}

/// Seeded points of a shape: `count` nodes of the bundled mesh, by their rest positions.
///
/// # Errors
/// A name that is no shape, or a shape with too few nodes away from its pins.
pub fn places(shape: &str, count: usize, random: &mut Random) -> Result<Vec<Point>, BenchError> {
    places_on(&original(shape)?, shape, count, random)
}

/// Seeded points of any design: `count` nodes of its mesh, away from pins and from each other.
///
/// # Errors
/// A design with too few nodes away from its pins.
pub fn places_on(design: &Design, shape: &str, count: usize, random: &mut Random) -> Result<Vec<Point>, BenchError> {
    let (mesh, length) = (&design.mesh, design.body_length_mm());
    let pins: Vec<Point> = design.pins.iter().map(|pin| mesh.position(&pin.at, &mesh.nodes)).collect();
    let mut order: Vec<usize> = (0..mesh.nodes.len()).collect();
    for k in (1..order.len()).rev() {
        order.swap(k, random.index(k + 1));
    }
    let far =
        |p: Point, from: &[Point], distance: f64| from.iter().all(|q| (p[0] - q[0]).hypot(p[1] - q[1]) >= distance);
    let mut part = 1.0;
    loop {
        let mut chosen: Vec<Point> = Vec::new();
        for &node in &order {
            let p = mesh.nodes[node];
            if chosen.len() < count
                && far(p, &pins, part * FROM_PINS * length)
                && far(p, &chosen, part * APART * length)
            {
                chosen.push(p);
            }
        }
        if chosen.len() == count {
            return Ok(chosen);
        }
        if part < 1e-3 {
            return Err(BenchError::Nothing(format!("{shape} has fewer than {count} points to drag")));
        }
        part *= 0.8;
    }
}

/// The places as points of the mesh of `subject`.
pub fn points(subject: &Subject, places: &[Point]) -> Vec<BodyPoint> {
    let mesh = &subject.design.mesh;
    places.iter().filter_map(|p| mesh.locate_nearest(*p, &mesh.nodes)).map(|(at, _)| at).collect()
}

/// A point of the bundled design on the mesh of `subject`.
///
/// # Errors
/// A name that is no shape.
pub fn carried(subject: &Subject, at: &BodyPoint) -> Result<Option<BodyPoint>, BenchError> {
    Ok(carry(&original(&subject.name)?.mesh, at, &subject.design.mesh))
}

/// The objective that pulls these points to these goals, mm.
pub fn towards(subject: &Subject, points: &[BodyPoint], goals: &[Point]) -> Objective {
    let targets: Vec<Target> =
        points.iter().zip(goals).map(|(at, to)| Target { at: *at, to: *to, weight: 1.0 }).collect();
    objective(&subject.design, &subject.plushie, &targets)
}

/// Where the points of an objective are at `x`.
pub fn positions(objective: &Objective, x: &[f64]) -> Vec<Point> {
    let place = |t: &crate::soft_ik::PointTarget| {
        let [dx, dy] = t.offset(x);
        [t.goal[0] + dx, t.goal[1] + dy]
    };
    objective.targets.iter().map(place).collect()
}

/// The goals of every frame of a drag, mm. The same seed, shape, count and path give the same drag.
///
/// # Errors
/// A name that is no shape, a pose without equilibrium, or the study was cancelled.
pub fn goals(
    subject: &mut Subject,
    points: &[BodyPoint],
    path: Path,
    frames: usize,
    session: &Session,
) -> Result<Vec<Vec<Point>>, BenchError> {
    let purpose = format!("{} {}", subject.name, path.name());
    let mut random = Random::of(session.seed, &purpose, points.len() as u64);
    let rest = subject.plushie.model.rest.clone();
    let pull = towards(subject, points, &vec![[0.0; 2]; points.len()]);
    let begin = positions(&pull, &rest);
    let mut out = Vec::with_capacity(frames);
    match path {
        Path::Unreachable => {
            let length = UNREACHABLE * subject.length();
            let directions: Vec<[f64; 2]> = points.iter().map(|_| random.direction()).collect();
            for frame in 1..=frames {
                let (s, _) = sweep(frame);
                let away =
                    begin.iter().zip(&directions).map(|(p, d)| [p[0] + s * length * d[0], p[1] + s * length * d[1]]);
                out.push(away.collect());
            }
        }
        Path::Reachable => {
            let nodes = original(&subject.name)?.mesh.nodes.clone();
            let fields = [0, 1].map(|_| Field::random(&mut random, &nodes, subject.length()));
            let strongest = fields.each_ref().map(|field| subject.contractions(field, STRENGTH));
            let mut x = rest;
            for frame in 1..=frames {
                session.check()?;
                let (a, b) = sweep(frame);
                // At most one in sum: 1/2 (1 - cos t) and its half-strength octave.
                let mixed = strongest[0].iter().zip(&strongest[1]);
                let contractions: Vec<f64> = mixed.map(|(c, d)| 0.6 * a * c + 0.4 * b * d).collect();
                x = subject.settle(&contractions, &x, session.stop)?;
                out.push(positions(&pull, &x));
            }
        }
    }
    Ok(out)
}

/// `1/2 (1 - cos t)` and `1/2 (1 - cos 2t)` with `t` once around in a sweep: from rest, away, and back.
fn sweep(frame: usize) -> (f64, f64) {
    let t = TAU * frame as f64 / SWEEP_FRAMES as f64;
    (0.5 * (1.0 - t.cos()), 0.5 * (1.0 - (2.0 * t).cos()))
}

#[cfg(test)]
mod tests {
    use super::*;

    static CANCEL: std::sync::atomic::AtomicBool = std::sync::atomic::AtomicBool::new(false);

    fn session(seed: u64) -> Session<'static> {
        Session { seed, stop: &|| false, cancel: &CANCEL, progress: &|_| {}, found: &|_| {} }
    }

    #[test]
    fn the_same_seed_gives_the_same_drag() {
        let drag = |seed, path| {
            let mut subject = Subject::new("pig", 414).unwrap();
            let places = places("pig", 3, &mut Random::of(seed, "pig", 3)).unwrap();
            let points = points(&subject, &places);
            goals(&mut subject, &points, path, 3, &session(seed)).unwrap()
        };
        for path in [Path::Reachable, Path::Unreachable] {
            assert_eq!(drag(1, path), drag(1, path));
            assert_ne!(drag(1, path), drag(2, path));
        }
    }

    #[test]
    fn twelve_points_are_found_on_every_shape_and_stay_where_they_are() {
        for name in super::super::shapes::names() {
            let chosen = places(&name, 12, &mut Random::new(5)).unwrap();
            let subject = Subject::new(&name, 1055).unwrap();
            let objective = towards(&subject, &points(&subject, &chosen), &chosen);
            assert_eq!(objective.targets.len(), 12);
            assert!(objective.target_error(&subject.plushie.model.rest) < 0.02 * subject.length(), "{name}");
        }
    }

    #[test]
    fn an_unreachable_path_leads_a_body_length_away() {
        let mut subject = Subject::new("e", 414).unwrap();
        let chosen = places("e", 1, &mut Random::new(5)).unwrap();
        let at = points(&subject, &chosen);
        let path = goals(&mut subject, &at, Path::Unreachable, SWEEP_FRAMES, &session(1)).unwrap();
        let away = path.iter().map(|g| (g[0][0] - chosen[0][0]).hypot(g[0][1] - chosen[0][1])).fold(0.0, f64::max);
        assert!((away / subject.length() - 1.0).abs() < 0.01, "{away}");
    }
}
