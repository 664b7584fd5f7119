//! Whole studies of the solvers that anybody can repeat: one file a study, each returns a [`Report`].
//!
//! | study | question |
//! | --- | --- |
//! | [`drag`] | what does a frame under the hand cost, and how good is it? |
//! | [`cold`] | how fast is a far target approached from rest? ([`misses`]: how often is the best pose missed, on any shape?) |
//! | [`wander`] | does a pose come back when the hand does, and may every frame on the way be shown? |
//! | [`winding`] | is the pose shown the best that winding from rest reaches, and what does that cost? |
//! | [`trade`] | what does accuracy cost, and which settings are never worth it? ([`locking`] of the triangles) |
//! | [`resolution`] | how far do poses, activations and networks agree over mesh resolutions? |
//! | [`networks`] | what do the networks reach that are found, can they be sewn, and do they stay when targets move? |
//! | [`scene`] | what does each optional part of a scene cost? |
//! | [`import`] | how well do outlines that nobody here drew become meshes? |
//! | [`extremes`] | what do the solvers survive, and with how many digits? |
//! | [`properties`] | what holds for every problem and design, whatever is in it? |
//! | [`linear`] | which sparse factorisation is the fastest for our Hessians? |
//!
//! A study draws all its random numbers from the session's seed ([`crate::random`]), so that the same seed gives the same
//! targets; times differ from run to run, so comparisons are always made within one run. Lengths are mm, times ms,
//! target errors parts of the body length.

pub mod baseline;
pub mod cold;
pub mod drag;
pub mod drags;
pub mod extremes;
pub mod figures;
pub mod import;
pub mod linear;
pub mod locking;
pub mod misses;
pub mod networks;
pub mod ordering;
pub mod plot;
pub mod posing;
pub mod properties;
pub mod report;
pub mod resolution;
pub mod scene;
mod session;
pub mod shapes;
pub mod silhouettes;
pub mod statistics;
pub mod trade;
pub mod wander;
pub mod winding;

pub use crate::soft_ik::{Quality, Tracker};
pub use report::{Cell, Report, Table};
pub use session::{BenchError, Session};
