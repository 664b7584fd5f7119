//! Few winches: the states that winding from rest reaches, looked at as a whole.
//!
//! A winch of several tendons has few neighbours and much effect: `O` over its activation has real valleys, and the nearest one
//! need not be the deepest. A soft body can also have several equilibria at the same activations, of which a plushie that is
//! wound from rest enters one. So what counts is `O` on the *wound states*: the equilibria on the way along straight lines from
//! rest, `beta(t) = beta_0 + t (beta - beta_0)`, `t` from 0 to 1, slowly. [`Search`] finds the best of them:
//!
//! 1. **Walk** (`walk`): continuation along lines to the edge of the winches' range (`rays`), in steps that the change of pose
//!    bounds. One winch has one line each way, and the walk is over when it has covered the range; two and three have lines
//!    through a lattice on the faces of the box of their ranges, more have lines spread over it.
//! 2. **Polish**: from the bottom of every valley that no lower one lies next to, the lowest first, Gauss-Newton in the
//!    activations; no more once several end where others have.
//! 3. **Prove** (`proof`): what is found is wound directly from rest, all winches in proportion, in ever more steps, until the
//!    end does not depend on their number. Where it ends elsewhere, the best state that can be proved between the valley on the
//!    line and what was found is taken. What winding does not enter is never the answer.
//!
//! The path is part of the meaning: with hysteresis, winding row by row may enter branches that proportional winding does not,
//! and the other way round. Proportional winding is what a timeline does that goes from rest to a pose.
//!
//! All of it is counted in factorisations and can be spread over frames.

mod care;
mod least;
mod proof;
mod rays;
mod recruit;
mod search;
mod walk;

pub use care::{Care, LATTICE};
pub use least::least;
pub use proof::wound;
pub use recruit::from_several;
pub use search::Search;
pub use walk::distance;
