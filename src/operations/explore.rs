//! What more winches and more tendons bring: the error against their numbers.

use super::Context;
use super::rig::{self, Error, Options, Rigged};
use crate::design::{Design, Pose, Tendon};
use crate::engine::target_error;
use crate::rigging::{Checked, Method, RigError, Sewn, TendonChoice};
use crate::threads::in_order;
use serde::Serialize;
use std::sync::Arc;

/// The best rig found with at most so many winches and tendons. Errors are rms distances of the targets in body lengths, as a check says
/// them, with friction where the design has it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Point {
    /// New winches, and tendons of each, that were allowed.
    pub winches: usize,
    pub tendons: usize,
    /// New winches, and tendons in all, that it takes.
    pub takes: [usize; 2],
    /// Holes between winches and ends, and cable, of all new networks.
    pub holes: usize,
    pub thread_mm: f64,
    pub poses: Vec<PoseError>,
    /// The worst pose's error as a part of that at rest: what a maker may expect ([`Sewn::expected`]) where it is to be sewn.
    pub worst: f64,
    /// To be put into the design.
    #[serde(skip)]
    pub rigged: Rigged,
}

/// A pose of a point.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PoseError {
    pub name: String,
    pub error: f64,
    /// Without friction.
    pub exact: f64,
    /// What a hand leaves, where that was worked out.
    pub sewn: Option<Sewn>,
    pub rest: f64,
}

impl PoseError {
    /// What rigs are compared by.
    fn part(&self) -> f64 {
        self.sewn.map_or(self.error, |sewn| sewn.expected(self.error)) / self.rest.max(f64::MIN_POSITIVE)
    }
}

/// Looks for a rig with each number of winches up to the most of `options`, and each number of tendons that they allow for every winch. The
/// list is told as it grows; it is in that order. A point is never worse than those with fewer: where a search ends
/// worse, the smaller rig stands in its place.
///
/// # Errors
/// As [`rig::prepare`]; [`Error::Cancelled`], what was found until then having been told.
pub fn run(
    design: &Design,
    options: &Options,
    found: &mut dyn FnMut(&[Arc<Point>]),
    context: &mut Context,
) -> Result<Vec<Arc<Point>>, Error> {
    let numbers = tendons(&options.tendons);
    let mut points: Vec<Arc<Point>> = Vec::new();
    for winches in 1..=options.max_winches {
        for (k, &tendons) in numbers.iter().enumerate() {
            let choice = match (options.method, &options.tendons) {
                // As many as help: the joint search leaves out what costs little.
                (Method::Joint, TendonChoice::Between(low, _)) => TendonChoice::Between(*low, tendons),
                _ => TendonChoice::PerWinch(vec![tendons]),
            };
            let bounds = Options { max_winches: winches, tendons: choice, ..options.clone() };
            let searched = match rig::prepare(design, &bounds, context) {
                Ok(rigged) => Some(point(design, winches, tendons, rigged, context)?),
                Err(Error::Rig(RigError::NothingFound | RigError::NothingToAdd)) => None,
                Err(error) => return Err(error),
            };
            let of = |winches: usize, tendons: usize| {
                points.iter().find(|point| point.winches == winches && point.tendons == tendons)
            };
            let smaller = [
                winches.checked_sub(1).and_then(|fewer| of(fewer, tendons)),
                k.checked_sub(1).and_then(|k| of(winches, numbers[k])),
            ];
            let inherited =
                smaller.into_iter().flatten().map(|point| Point { winches, tendons, ..Point::clone(point) });
            let best = inherited.chain(searched).min_by(|a, b| a.worst.total_cmp(&b.worst));
            if let Some(best) = best {
                points.push(Arc::new(best));
                found(&points);
            }
        }
    }
    if points.is_empty() { Err(Error::Rig(RigError::NothingFound)) } else { Ok(points) }
}

/// The numbers of tendons that a choice allows for a winch, ascending.
fn tendons(choice: &TendonChoice) -> Vec<usize> {
    match choice {
        TendonChoice::Between(low, high) => ((*low).max(1)..=(*high).max(*low).max(1)).collect(),
        TendonChoice::PerWinch(list) => {
            let mut numbers: Vec<usize> = list.iter().map(|n| (*n).max(1)).collect();
            numbers.sort_unstable();
            numbers.dedup();
            numbers
        }
    }
}

fn point(design: &Design, winches: usize, tendons: usize, rigged: Rigged, context: &Context) -> Result<Point, Error> {
    let mut with = design.clone();
    rigged.clone().apply(&mut with)?;
    let cancel = context.cancel();
    let posed = design.poses.iter().filter(|pose| !pose.targets.is_empty());
    let sewn = rigged.sewn.iter().copied().chain(std::iter::repeat(None));
    let posed: Vec<(&Pose, Option<Sewn>)> = posed.zip(sewn).collect();
    let poses = in_order(&posed, |(pose, sewn)| {
        let checked = Checked::of(&with, &pose.targets, with.tendons.friction, cancel);
        PoseError {
            name: pose.name.clone(),
            error: checked.real_error(),
            exact: checked.error(),
            sewn: *sewn,
            rest: target_error(design, &pose.targets, &design.mesh.nodes),
        }
    });
    context.check()?;
    let cables = rigged.networks.iter().flat_map(|network| &network.tendons);
    Ok(Point {
        winches,
        tendons,
        takes: [rigged.networks.len(), cables.clone().count()],
        holes: cables.clone().map(Tendon::holes).sum(),
        thread_mm: cables.map(|tendon| tendon.cable_mm(&design.mesh.nodes)).sum(),
        worst: poses.iter().map(PoseError::part).fold(0.0, f64::max),
        poses,
        rigged,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::testing;
    use std::sync::atomic::{AtomicBool, Ordering};

    #[test]
    fn numbers_of_tendons_are_those_that_a_choice_allows() {
        assert_eq!(tendons(&TendonChoice::Between(2, 4)), [2, 3, 4]);
        assert_eq!(tendons(&TendonChoice::Between(3, 0)), [3]);
        assert_eq!(tendons(&TendonChoice::PerWinch(vec![3, 1, 3])), [1, 3]);
    }

    #[test]
    fn more_never_serve_worse_and_every_point_is_a_rig_with_its_figures() {
        let mut design = testing::sample();
        (design.networks, design.keyframes) = (Vec::new(), Vec::new());
        let options = Options {
            max_winches: 2,
            tendons: TendonChoice::Between(1, 2),
            rounds: 0,
            rules: false,
            ..Options::default()
        };
        let (go, mut told) = (AtomicBool::new(false), Vec::new());
        let mut hear = |list: &[Arc<Point>]| told.push(list.len());
        let points = run(&design, &options, &mut hear, &mut Context::new(&go)).unwrap();
        assert_eq!(told, [1, 2, 3, 4]);
        let numbers: Vec<[usize; 2]> = points.iter().map(|p| [p.winches, p.tendons]).collect();
        assert_eq!(numbers, [[1, 1], [1, 2], [2, 1], [2, 2]]);
        for more in &points {
            let fewer = points.iter().filter(|p| p.winches <= more.winches && p.tendons <= more.tendons);
            assert!(fewer.clone().all(|fewer| more.worst <= fewer.worst));
            assert!(more.takes[0] <= more.winches && more.takes[1] <= more.winches * more.tendons);
            let mut with = design.clone();
            more.rigged.clone().apply(&mut with).unwrap();
            with.validate().unwrap();
            for (pose, told) in with.poses.iter().filter(|pose| !pose.targets.is_empty()).zip(&more.poses) {
                let checked = Checked::of(&with, &pose.targets, with.tendons.friction, &go);
                assert_eq!(checked.real_error().to_bits(), told.error.to_bits());
            }
        }
        go.store(true, Ordering::Relaxed);
        assert!(matches!(run(&design, &options, &mut |_| (), &mut Context::new(&go)), Err(Error::Cancelled(_))));
    }
}
