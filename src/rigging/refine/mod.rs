//! All winches of a rig improved together: where winches, holes and ends are at rest, and the activations of all poses, by a
//! Levenberg-Marquardt method on exact sensitivities.
//!
//! With `f_k` the squared miss of pose `k`, as a part of that at rest, and `v` the violations of the rules of sewing, it brings down
//!
//! ```text
//! C = sum_k f_k^2 + W sum v^2 + S sum (beta / upper)^2
//! ```
//!
//! over the rest positions of all points and `0 <= beta <= upper` in each pose, every trial in equilibrium. The squares of `f` let
//! the worst pose count most. The derivatives of the targets by points and activations are exact ([`crate::soft_ik::routing`]); where the points
//! have moved, their places in the mesh, rest lengths and bounds follow.

mod improve;
mod local;
mod steady;
mod task;
mod trim;

pub(super) use improve::KEPT;
pub use task::{Fit, SEEN, Start, Task};
