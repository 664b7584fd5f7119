//! How a fault in a document is reported, and the small checks that report it.

use super::{FORMAT_VERSION, MaterialPoint};
use crate::mesh::MeshError;
use thiserror::Error;

/// Where a document is unsound, and why.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{at}: {fault}")]
pub struct DesignError {
    /// Path of the offending value, such as `poses[2].targets[0].to`.
    pub at: String,
    pub fault: Fault,
}

/// The flaw at the place a [`DesignError`] names.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Fault {
    #[error("{index} is out of range, the mesh has {len} {what}")]
    OutOfRange { index: usize, len: usize, what: &'static str },
    #[error("{0} is not a finite number")]
    NotFinite(f64),
    #[error("{} is not greater than zero", short(*.0))]
    NotPositive(f64),
    #[error("{} is negative", short(*.0))]
    Negative(f64),
    #[error("{} is greater than {}", short(*.0), short(*.1))]
    TooLarge(f64, f64),
    #[error("{} is out of range: {} to {}{}", short(*value), short(*low), short(*high), spaced(unit))]
    OutOfBounds { value: f64, low: f64, high: f64, unit: &'static str },
    #[error("{} times mu is more than {} times", short(*factor), short(*most))]
    TooStiff { factor: f64, most: f64 },
    #[error("has {found} {what}, at most {most} are read")]
    TooMany { found: usize, most: usize, what: &'static str },
    #[error("has a character that cannot be shown (U+{0:04X})")]
    Hidden(u32),
    #[error("the weights sum to {}, not to 1", short(*.0))]
    WeightSum(f64),
    #[error("has {found} {what}, needs at least {least}")]
    TooFew { found: usize, least: usize, what: &'static str },
    #[error("has {found} entries for {expected} {what}")]
    Length { found: usize, expected: usize, what: &'static str },
    #[error("area {0} mm^2: corners must run counter-clockwise around a positive area")]
    Triangle(f64),
    #[error("area {0} mm^2: the outer polygon must run counter-clockwise around a positive area")]
    OuterPolygon(f64),
    #[error("area {0} mm^2: a hole must run clockwise around a positive area")]
    HolePolygon(f64),
    #[error(transparent)]
    Mesh(#[from] MeshError),
    #[error("node {0} stands twice in a row")]
    RepeatedNode(usize),
    #[error("{0} stands twice in a row")]
    RepeatedPoint(MaterialPoint),
    #[error("starts at {found}, the network's winch is at {winch}")]
    OtherWinch { found: MaterialPoint, winch: MaterialPoint },
    #[error("nodes {}, {} and {} are not a triangle of the mesh", .0[0], .0[1], .0[2])]
    NoTriangle([usize; 3]),
    #[error("{} s does not come after {} s", short(*time), short(*before))]
    NotAscending { time: f64, before: f64 },
    #[error("is empty")]
    Empty,
    #[error("{0}")]
    Drawing(&'static str),
    #[error("there is another {what} named {name:?}")]
    Duplicate { what: &'static str, name: String },
    #[error("there is no pose named {0:?}")]
    UnknownPose(String),
    #[error("{found} is not a version this program knows (1 to {FORMAT_VERSION})")]
    Version { found: u32 },
}

/// Outcome of a check.
pub(super) type Check = Result<(), DesignError>;

/// A number with its digits, or with an exponent where it would be long.
fn short(value: f64) -> String {
    if value != 0.0 && !(1e-3..1e7).contains(&value.abs()) { format!("{value:e}") } else { format!("{value}") }
}

fn spaced(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" {unit}") }
}

pub(super) fn finite(at: &str, v: f64) -> Check {
    require(v.is_finite(), at, || Fault::NotFinite(v))
}

pub(super) fn at_least(at: &str, found: usize, least: usize, what: &'static str) -> Check {
    require(found >= least, at, || Fault::TooFew { found, least, what })
}

pub(super) fn same_length(at: &str, found: usize, expected: usize, what: &'static str) -> Check {
    require(found == expected, at, || Fault::Length { found, expected, what })
}

pub(super) fn require(holds: bool, at: &str, fault: impl FnOnce() -> Fault) -> Check {
    if holds { Ok(()) } else { fail(at, fault()) }
}

pub(super) fn fail(at: impl Into<String>, fault: Fault) -> Check {
    Err(DesignError { at: at.into(), fault })
}
