//! How a fault in a document is reported, and the small checks that report it.

use super::FORMAT_VERSION;
use crate::mesh::MeshError;
use thiserror::Error;

/// Where a document is unsound, and why.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{at}: {problem}")]
pub struct DesignError {
    /// Path of the offending value, such as `poses[2].targets[0].to`.
    pub at: String,
    pub problem: Problem,
}

/// What is wrong at the place a [`DesignError`] names.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Problem {
    #[error("{index} is out of range, the mesh has {len} {what}")]
    OutOfRange { index: usize, len: usize, what: &'static str },
    #[error("{0} is not a finite number")]
    NotFinite(f64),
    #[error("{0} is not greater than zero")]
    NotPositive(f64),
    #[error("{0} is negative")]
    Negative(f64),
    #[error("{0} is greater than {1}")]
    TooLarge(f64, f64),
    #[error("the weights sum to {0}, not to 1")]
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
    #[error("starts at node {found}, the network's winch is at node {winch}")]
    OtherWinch { found: usize, winch: usize },
    #[error("{time} s does not come after {before} s")]
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

pub(super) fn finite(at: &str, v: f64) -> Check {
    require(v.is_finite(), at, || Problem::NotFinite(v))
}

pub(super) fn positive(at: &str, v: f64) -> Check {
    finite(at, v)?;
    require(v > 0.0, at, || Problem::NotPositive(v))
}

pub(super) fn not_negative(at: &str, v: f64) -> Check {
    finite(at, v)?;
    require(v >= 0.0, at, || Problem::Negative(v))
}

pub(super) fn fraction(at: &str, v: f64) -> Check {
    not_negative(at, v)?;
    require(v <= 1.0, at, || Problem::TooLarge(v, 1.0))
}

pub(super) fn at_least(at: &str, found: usize, least: usize, what: &'static str) -> Check {
    require(found >= least, at, || Problem::TooFew { found, least, what })
}

pub(super) fn same_length(at: &str, found: usize, expected: usize, what: &'static str) -> Check {
    require(found == expected, at, || Problem::Length { found, expected, what })
}

pub(super) fn require(holds: bool, at: &str, problem: impl FnOnce() -> Problem) -> Check {
    if holds { Ok(()) } else { fail(at, problem()) }
}

pub(super) fn fail(at: impl Into<String>, problem: Problem) -> Check {
    Err(DesignError { at: at.into(), problem })
}
