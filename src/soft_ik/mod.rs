//! Soft IK: which contractions bring the body closest to its targets (section 5).
//!
//! Minimises, over the activations `beta` of the free winches within their bounds, with `x` in equilibrium,
//!
//! ```text
//! O = 1/2 sum_T q_t |S_t x - x'_t|^2 + 1/2 sum_i q_i |x_i - X_i|^2 + lambda/2 sum (alpha_c/alpha_0)^2 + rho/2 sum_free tau^2
//! ```
//!
//! `S_t x` is a point of the body. A muscle fibre is a winch with a single element. Four methods implement [`Method`]:
//!
//! | method | unknowns | for |
//! | --- | --- | --- |
//! | [`gradient`] | `xi`, the paper's reparametrisation | the baseline: Algorithm 1 as printed; may stall where elements go slack |
//! | [`contraction`] | `beta`, Gauss-Newton with true bounds | winches |
//! | [`newton`] | `beta`, Newton with true bounds, sparse | the question's own objective, at any number of fibres |
//! | [`tension`] | `x` and the tensions of the free elements, all at once | many fibres under the hand |
//!
//! [`solve`] is the default: it chooses and combines them, and never returns an answer stuck in the slack stall.

pub mod actuation;
pub mod contraction;
pub mod default_method;
mod fibers;
pub mod frame;
pub mod friction;
pub mod gradient;
mod method;
pub mod methods;
pub mod newton;
pub mod objective;
pub(crate) mod quadratic;
pub mod question;
pub mod routing;
pub mod sensitivity;
pub mod tension;
pub mod tracker;
pub mod winding;

pub use actuation::{Actuation, Winch};
pub use default_method::solve;
pub use frame::{Frame, Phases, Quality};
pub use method::{Answer, Budget, Method};
pub use methods::{METHODS, method};
pub use objective::{Objective, PointTarget};
pub use question::{Posture, Question};
pub use tracker::Tracker;
