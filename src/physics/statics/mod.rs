//! Statics: where the plushie comes to rest (minimum of `E`), by an inversion-safe Newton method.
//!
//! The exact Hessian is factorised; only where that fails the projected one takes its place. A step is first capped so that
//! no triangle comes near inversion, then halved until the energy falls enough (Armijo). Near equilibrium, where the Hessian
//! hardly changes any more, steps are repeated with the same factor (Shamanskii's method).

mod continuation;
mod line_search;
mod negative_curvature;
mod newton;
mod reuse;
mod shifted_newton;
mod solve;
mod state;
mod workspace;

pub use reuse::Reuse;
pub use solve::{minimum, settle, solve};
pub use state::{Cause, Equilibrium, Progress, StaticsError, StaticsSettings};
pub use workspace::{Workspace, norm};
