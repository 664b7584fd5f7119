//! A design with networks, and what it reaches.

use crate::bench::report::Cell;
use crate::bench::{BenchError, Session};
use crate::defaults;
use crate::design::{Design, Tendon};
use crate::engine::{Shape, pose_with_friction, target_error};
use crate::rigging::{self, Checked, RigError, RigOptions, rig};
use crate::threads::in_order;
use std::time::Instant;

/// A rig, each pose wound from rest without friction.
pub struct Rigged {
    pub design: Design,
    /// Error at rest and shape of every pose; the shape is missing where the pose does not settle.
    poses: Vec<(f64, Option<Shape>)>,
    seconds: f64,
}

impl Rigged {
    /// # Errors
    /// Cancelled.
    pub fn of(design: Design, seconds: f64, session: &Session) -> Result<Self, BenchError> {
        let poses: Vec<_> = design.poses.iter().filter(|pose| !pose.targets.is_empty()).collect();
        let poses = in_order(&poses, |pose| {
            let rest = target_error(&design, &pose.targets, &design.mesh.nodes).max(f64::MIN_POSITIVE);
            let shape = Checked::of(&design, &pose.targets, 0.0, session.cancel).shape;
            (rest, Some(shape).filter(|shape| shape.target_error.is_finite()))
        });
        session.check()?;
        Ok(Self { design, poses, seconds })
    }

    /// The networks that a search finds for a design that has none; no networks where it finds none.
    ///
    /// # Errors
    /// The design has no poses, or cancelled.
    pub fn found(design: &Design, options: &RigOptions, session: &Session) -> Result<Self, BenchError> {
        let mut bare = design.clone();
        bare.networks.clear();
        bare.keyframes.clear();
        let start = Instant::now();
        let rigged = match rig(&bare, options, &mut |_| (), session.cancel) {
            Ok(found) => found.design,
            Err(RigError::NothingFound | RigError::NothingToAdd) => bare,
            Err(RigError::Cancelled) => return Err(BenchError::Cancelled),
            Err(error @ (RigError::NoTargets | RigError::NoModel)) => {
                return Err(BenchError::Nothing(format!("{}: {error}", design.name)));
            }
        };
        Self::of(rigged, start.elapsed().as_secs_f64(), session)
    }

    /// The worst pose's error as a part of that at rest; `None` where a pose does not settle.
    pub fn error(&self) -> Option<f64> {
        self.worst(|_, shape| Some(shape.target_error))
    }

    /// The same under friction, all cables pulled.
    pub fn under(&self, mu: f64, session: &Session) -> Option<f64> {
        self.worst(|pose, shape| {
            let targets = &self.design.poses.iter().filter(|p| !p.targets.is_empty()).nth(pose)?.targets;
            let found = pose_with_friction(&self.design, targets, &shape.activations_mm, mu, session.stop);
            Some(found.ok()?.error)
        })
    }

    /// The same of so many plushies as hands sew them, ascending: others than those by which the search judges. Infinite where a pose does not
    /// settle.
    ///
    /// # Errors
    /// Cancelled.
    pub fn sewn(&self, plushies: usize, session: &Session) -> Result<Vec<f64>, BenchError> {
        let draws = defaults::SEWN_DRAWS..defaults::SEWN_DRAWS + plushies;
        let sewn = draws.map(|draw| Self::of(rigging::by_hand(&self.design, draw), 0.0, session));
        let mut errors =
            sewn.map(|sewn| Ok(sewn?.error().unwrap_or(f64::INFINITY))).collect::<Result<Vec<_>, BenchError>>()?;
        errors.sort_by(f64::total_cmp);
        Ok(errors)
    }

    fn worst(&self, error: impl Fn(usize, &Shape) -> Option<f64>) -> Option<f64> {
        let part = |(k, (rest, shape)): (usize, &(f64, Option<Shape>))| Some(error(k, shape.as_ref()?)? / rest);
        self.poses.iter().enumerate().map(part).try_fold(0.0, |worst, part| Some(f64::max(worst, part?)))
    }

    /// What the search took.
    pub fn seconds(&self) -> f64 {
        self.seconds
    }

    /// A row of the table of rigs.
    pub fn row(&self, design: &str, what: &str) -> Vec<Cell> {
        let tendons = || self.design.networks.iter().flat_map(|network| &network.tendons);
        let thread = tendons().map(|tendon| tendon.cable_mm(&self.design.mesh.nodes));
        vec![
            design.into(),
            self.poses.len().into(),
            what.into(),
            self.design.networks.len().into(),
            tendons().count().into(),
            self.error().into(),
            tendons().map(Tendon::holes).sum::<usize>().into(),
            thread.sum::<f64>().into(),
            self.design.breaches().len().into(),
            self.seconds.into(),
        ]
    }
}
