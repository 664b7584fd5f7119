//! Both plushies in a pose, with all effort and from rest: the same figures whoever asks.

use super::{Cancelled, Context};
use crate::design::{Design, Target};
use crate::engine::{Setpoint, Shape, Warning, solve_once};
use std::fmt;

/// One of the two plushies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    Idealized,
    Realizable,
}

/// A plushie that did not come to equilibrium; its shape is the nearest state found.
#[derive(Clone, Debug, PartialEq)]
pub struct Unbalanced {
    /// Of which pose, or when.
    pub place: String,
    pub view: View,
    /// Largest unbalanced force as a part of the forces at work.
    pub distance: f64,
    pub why: Option<Warning>,
}

/// A pose that the design does not have.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("no pose `{name}`; the design has: {}", known.join(", "))]
pub struct NoSuchPose {
    pub name: String,
    /// Those that it has.
    pub known: Vec<String>,
}

impl NoSuchPose {
    /// Of a design that has no pose of that name.
    pub(super) fn of(design: &Design, name: &str) -> Self {
        Self { name: name.to_owned(), known: design.poses.iter().map(|p| p.name.clone()).collect() }
    }
}

impl fmt::Display for View {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(match self {
            Self::Idealized => "idealized",
            Self::Realizable => "realizable",
        })
    }
}

impl fmt::Display for Unbalanced {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let why = self.why.as_ref().map_or("not in equilibrium".into(), |warning| warning.to_string());
        let why = why.trim_end_matches('.');
        let Self { place, view, distance, .. } = self;
        write!(f, "{place}, {view}: {why} (unbalanced forces are {distance:.1e} of those at work)")
    }
}

impl Unbalanced {
    /// Those of the two plushies, idealized first, that are off equilibrium.
    pub(super) fn of(place: &str, [idealized, realizable]: &[Shape; 2]) -> Vec<Self> {
        let views = [(View::Idealized, idealized), (View::Realizable, realizable)];
        views.into_iter().filter_map(|(view, shape)| Self::seen(place, view, shape)).collect()
    }

    /// The realizable plushie, where it is off equilibrium.
    pub(super) fn realizable(place: &str, shape: &Shape) -> Option<Self> {
        Self::seen(place, View::Realizable, shape)
    }

    fn seen(place: &str, view: View, shape: &Shape) -> Option<Self> {
        let (distance, why) = (shape.distance_from_equilibrium(), shape.warning.clone());
        (!shape.converged).then(|| Self { place: place.to_owned(), view, distance, why })
    }
}

/// The targets of a pose.
pub(super) fn targets(design: &Design, pose: &str) -> Result<Vec<Target>, NoSuchPose> {
    let found = design.poses.iter().find(|p| p.name == pose).map(|p| p.targets.clone());
    found.ok_or_else(|| NoSuchPose::of(design, pose))
}

/// Both plushies, idealized first, solved from rest; one that is not `wanted` stays at rest.
pub(super) fn solve(
    design: &Design,
    setpoint: Setpoint,
    wanted: [bool; 2],
    context: &Context,
) -> Result<[Shape; 2], Cancelled> {
    let outcome = solve_once(design, setpoint, wanted, context.cancel());
    context.check()?;
    let rest = || at_rest(design);
    Ok([outcome.idealized.unwrap_or_else(rest), outcome.realizable.unwrap_or_else(rest)])
}

/// A plushie that nothing pulls at.
pub(super) fn at_rest(design: &Design) -> Shape {
    Shape { nodes: design.mesh.nodes.clone(), converged: true, ..Shape::default() }
}
