//! The figures of a design: sizes, and how close both plushies come to each pose.

use super::posing::{self, solve};
use super::{Cancelled, Context, NoSuchPose, Unbalanced, View};
use crate::design::{Design, EditError, Pose, Target, TendonSettings, edit};
use crate::engine::{FrictionPose, FrictionPoseError, Setpoint, Shape, Warning, pose_with_friction, target_error};
use crate::motion::winch_labels;
use crate::rigging::{Sewn, sewn};
use crate::sewing::Breach;
use crate::threads::in_order;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::sync::Arc;

/// The scope of a check.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    /// Names of poses; none for all.
    pub poses: Vec<String>,
    /// Coefficient of friction of all tendons at their holes; none for the design's own.
    pub friction: Option<f64>,
    /// Whether it is worked out what a hand's inaccuracy costs.
    pub sewn: bool,
}

/// Why a design has no figures.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    NoSuchPose(#[from] NoSuchPose),
    /// A coefficient of friction that no design may have.
    #[error(transparent)]
    Friction(#[from] EditError),
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// A note of the solver about a pose.
#[derive(Clone, Debug, PartialEq)]
pub enum Note {
    /// The figures are those of the nearest state found.
    Unbalanced(Unbalanced),
    Warning {
        pose: String,
        view: View,
        warning: Warning,
    },
    /// Figures under friction that are missing, and why.
    Friction {
        pose: String,
        why: FrictionPoseError,
    },
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Unbalanced(unbalanced) => unbalanced.fmt(f),
            Self::Warning { pose, view, warning } => write!(f, "{pose}, {view}: {warning}"),
            Self::Friction { pose, why } => write!(f, "{pose}, no figure under friction: {why}"),
        }
    }
}

/// Sizes and poses. Errors are rms distances of the targets in body lengths.
#[derive(Clone, Debug, Serialize)]
pub struct Figures {
    pub name: String,
    pub fibers: usize,
    pub nodes: usize,
    pub triangles: usize,
    pub winches: usize,
    pub tendons: usize,
    /// Networks that are switched off: they are not among the winches and tendons, and wind nothing.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub switched_off: Vec<String>,
    pub body_length_mm: f64,
    pub poses: Vec<PoseFigures>,
    /// Rules of sewing that the design breaks, at rest and then pose by pose.
    pub sewing: Vec<Unsewable>,
    #[serde(skip)]
    pub notes: Vec<Note>,
}

/// A rule of sewing that is broken.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Unsewable {
    /// The pose in which the realizable plushie breaks it; none for the rest shape.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pose: Option<String>,
    #[serde(flatten)]
    pub breach: Breach,
    /// What winches are called in words, network by network.
    #[serde(skip)]
    names: Arc<[String]>,
}

impl fmt::Display for Unsewable {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match &self.pose {
            Some(pose) => write!(f, "{pose}: {}", self.breach.words(&self.names)),
            None => self.breach.words(&self.names).fmt(f),
        }
    }
}

/// How close both plushies come to a pose, and what that took.
#[derive(Clone, Debug, Serialize)]
pub struct PoseFigures {
    pub name: String,
    pub targets: usize,
    pub error_rest: f64,
    pub error_idealized: f64,
    pub error_realizable: f64,
    /// The worst error of the realizable plushie where one winch is a millimetre off; absent without winches.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_realizable_1mm_off: Option<f64>,
    /// The error of the realizable plushie at the activations that serve it best when cables rub and have been pulled; absent without
    /// friction, and where it is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_realizable_friction: Option<f64>,
    /// That of the same activations when all cables have been let out: the other end of what friction leaves open.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_realizable_letting_out: Option<f64>,
    /// What is left of the realizable plushie's error when a hand sews it, with friction where there is any; absent where it was not asked
    /// for. A figure is null where a pose has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error_realizable_sewn: Option<Sewn>,
    /// Whether that is so much worse that the pose counts as narrow.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub narrow: Option<bool>,
    pub milliseconds_idealized: f64,
    pub milliseconds_realizable: f64,
    /// Largest unbalanced force as a part of the forces at work.
    pub imbalance_idealized: f64,
    pub imbalance_realizable: f64,
}

/// Solves poses from rest, as many at a time as the machine has cores. Each pose has a solver of its own, so that its figures do
/// not depend on how many there are.
///
/// # Errors
/// [`Error::NoSuchPose`] for a name that none has; [`Error::Friction`] for a coefficient out of its range; [`Error::Cancelled`].
pub fn run(design: &Design, options: &Options, context: &Context) -> Result<Figures, Error> {
    options.poses.iter().try_for_each(|name| posing::targets(design, name).map(drop))?;
    let wanted = |pose: &&Pose| options.poses.is_empty() || options.poses.contains(&pose.name);
    let wanted: Vec<&Pose> = design.poses.iter().filter(wanted).collect();
    let mut friction = design.tendons.friction;
    if let Some(mu) = options.friction {
        let tendons = TendonSettings { friction: mu, ..design.tendons.clone() };
        edit::set_tendons(&mut design.clone(), tendons)?;
        friction = mu;
    }
    // A context belongs to one thread; what tells it to stop does not.
    let cancel = context.cancel();
    let solved = in_order(&wanted, |pose| pose_figures(design, pose, friction, &Context::new(cancel)));
    let names: Arc<[String]> = winch_labels(design).into();
    let unsewable =
        |pose: Option<&str>, breach: Breach| Unsewable { pose: pose.map(str::to_owned), breach, names: names.clone() };
    let mut figures = Figures {
        name: design.name.clone(),
        fibers: design.fiber_routings().len(),
        nodes: design.mesh.nodes.len(),
        triangles: design.mesh.triangles.len(),
        winches: design.acting_numbers().len(),
        tendons: design.networks.iter().filter(|n| !n.muted).map(|n| n.tendons.len()).sum(),
        switched_off: design.muted_names().map(str::to_owned).collect(),
        body_length_mm: design.body_length_mm(),
        poses: Vec::new(),
        sewing: design.breaches().into_iter().map(|breach| unsewable(None, breach)).collect(),
        notes: Vec::new(),
    };
    // Every pose shares its processors with the other draws.
    let targets: Vec<&[Target]> = wanted.iter().map(|pose| pose.targets.as_slice()).collect();
    let by_hand = if options.sewn { sewn(design, &targets, friction, cancel) } else { Vec::new() };
    context.check()?;
    let mut by_hand = by_hand.into_iter();
    for solved in solved {
        let Posed { figures: pose, outside, notes } = solved?;
        figures.sewing.extend(outside.into_iter().map(|breach| unsewable(Some(&pose.name), breach)));
        figures.poses.push(PoseFigures { error_realizable_sewn: by_hand.next(), ..pose });
        figures.notes.extend(notes);
    }
    Ok(figures)
}

/// A pose that was solved.
struct Posed {
    figures: PoseFigures,
    /// Pieces of cable outside of the realizable plushie.
    outside: Vec<Breach>,
    notes: Vec<Note>,
}

fn pose_figures(design: &Design, pose: &Pose, friction: f64, context: &Context) -> Result<Posed, Cancelled> {
    let shapes = solve(design, Setpoint::Targets(pose.targets.clone()), [true, true], context)?;
    let mut notes: Vec<Note> = Unbalanced::of(&pose.name, &shapes).into_iter().map(Note::Unbalanced).collect();
    for (view, shape) in [View::Idealized, View::Realizable].into_iter().zip(&shapes) {
        let warning = shape.warning.clone();
        notes.extend(warning.map(|warning| Note::Warning { pose: pose.name.clone(), view, warning }));
    }
    let [idealized, realizable] = shapes;
    let (rubbed, why) = rubbed(design, pose, &realizable, friction, context)?;
    notes.extend(why.into_iter().map(|why| Note::Friction { pose: pose.name.clone(), why }));
    let figures = PoseFigures {
        name: pose.name.clone(),
        targets: pose.targets.len(),
        error_rest: target_error(design, &pose.targets, &design.mesh.nodes),
        error_idealized: idealized.target_error,
        error_realizable: realizable.target_error,
        error_realizable_1mm_off: realizable.play.map(|play| play.error),
        error_realizable_friction: rubbed[0],
        error_realizable_letting_out: rubbed[1],
        error_realizable_sewn: None,
        narrow: realizable.play.map(|_| matches!(realizable.warning, Some(Warning::Narrow { .. }))),
        milliseconds_idealized: idealized.milliseconds,
        milliseconds_realizable: realizable.milliseconds,
        imbalance_idealized: idealized.distance_from_equilibrium(),
        imbalance_realizable: realizable.distance_from_equilibrium(),
    };
    Ok(Posed { figures, outside: design.breaches_in(&realizable.nodes), notes })
}

/// Errors of the realizable plushie under friction, pulled and let out, and why one of them is missing.
fn rubbed(
    design: &Design,
    pose: &Pose,
    realizable: &Shape,
    friction: f64,
    context: &Context,
) -> Result<([Option<f64>; 2], Option<FrictionPoseError>), Cancelled> {
    // What is off equilibrium, or where nothing can be wound, has no friction to ask for.
    if friction <= 0.0 || !realizable.converged || design.networks.is_empty() || pose.targets.is_empty() {
        return Ok(([None; 2], None));
    }
    let stop = || context.check().is_err();
    let found = pose_with_friction(design, &pose.targets, &realizable.activations_mm, friction, &stop);
    context.check()?;
    Ok(match found {
        Ok(FrictionPose { error, error_letting_out: Ok(let_out), .. }) => ([Some(error), Some(let_out)], None),
        Ok(FrictionPose { error, error_letting_out: Err(why), .. }) => ([Some(error), None], Some(why.into())),
        Err(why) => ([None; 2], Some(why)),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::testing;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn the_poses_asked_for_are_checked_and_others_refused() {
        let mut design = testing::sample();
        design.pins.clear();
        let first = design.poses[0].name.clone();
        let go = AtomicBool::new(false);
        let of = |name: &str| {
            run(&design, &Options { poses: vec![name.to_owned()], ..Options::default() }, &Context::new(&go))
        };
        let figures = of(&first).unwrap();
        assert_eq!((figures.poses.len(), &figures.poses[0].name), (1, &first));
        // Nothing holds the body.
        assert!(figures.notes.iter().any(|note| note.to_string().contains("free to move")), "{:?}", figures.notes);
        assert!(matches!(of("none"), Err(Error::NoSuchPose(NoSuchPose { name, .. })) if name == "none"));
        // Both tendons of the left winch end in corners.
        let told = figures.sewing.iter().find(|broken| broken.pose.is_none()).unwrap();
        assert_eq!(told.to_string(), "left, tendon 1: hole 1 from the winch is 0.0 mm from the seam, less than 5.0");
        let record = serde_json::json!({
            "rule": "hole_to_seam", "winch": 1, "tendon": 1, "hole": 1, "value": 0.0, "limit": 5.0, "severity": 2.0
        });
        assert_eq!(serde_json::to_value(told).unwrap(), record);
        let posed = Unsewable { pose: Some(first.clone()), ..told.clone() };
        assert_eq!(serde_json::to_value(&posed).unwrap()["pose"], *first);
        assert!(posed.to_string().starts_with(&format!("{first}: left, ")));
        let stop = AtomicBool::new(true);
        let stopped = run(&design, &Options::default(), &Context::new(&stop));
        assert!(matches!(stopped, Err(Error::Cancelled(_))));
    }
}
