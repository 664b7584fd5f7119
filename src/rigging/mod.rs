//! Finds winches and tendons.
//!
//! | file | holds |
//! | --- | --- |
//! | `search` | a rig for all poses, without a hand: all winches together, or winch by winch |
//! | `joint` | the search for all winches together: islands of layouts, changed and improved |
//! | `schedule` | when the search leaves its islands, gathers the best, drops the rules |
//! | `layout`, `moves` | where winches and cables are at rest; random layouts, and random changes of one |
//! | `kinds` | which networks are the same in kind |
//! | `minimax` | what counts of the errors of several poses |
//! | `refine` | all points of a layout and all activations improved together, on exact sensitivities |
//! | `linear_score`, `annealing` | layouts ranked by the body linearised at rest, at its goals or in between, and annealed there, before any is simulated |
//! | `sewable`, `depths` | the rules of sewing as figures that a search brings to zero; how deep points lie in a body |
//! | `prune` | points, tendons and winches that cost little are left out |
//! | `greedy` | the paper's loop: solve, discover, try out, accept, winch by winch (section 3) |
//! | `propose/` | networks for one pose, for somebody to choose from, as they are found |
//! | `checked` | a pose of a rig as a check has it |
//! | `robust` | what the inaccuracy of a hand costs |
//! | `generators/`, `criteria/` | where their candidates come from, and what makes one better than another |
//! | `trial`, `rank` | a design wound from rest towards a pose; many candidates tried out and put in order |
//!
//! The score of Algorithm 2 is a heuristic: small differences in activations change the network it finds, and it knows one pose. The joint
//! search asks the body. A point of a cable is a point of the body, with exact derivatives of every pose's miss by its place
//! ([`crate::soft_ik::routing`]); so a layout runs downhill by itself, rules included, and chance has only to find the valley. Both count
//! what a simulated network really reaches, wound from rest.

pub mod activation;
mod annealing;
mod candidate;
mod checked;
pub mod criteria;
pub mod criterion;
mod depths;
pub mod generator;
pub mod generators;
mod greedy;
mod joint;
mod kinds;
mod layout;
mod linear_score;
mod minimax;
mod moves;
mod options;
mod propose;
mod prune;
mod rank;
mod refine;
mod robust;
mod schedule;
mod search;
mod sewable;
mod trial;

pub use candidate::{Baseline, Candidate, with_network};
pub use checked::Checked;
pub use options::{BadTendons, Found, Method, Progress, RigError, RigOptions, TendonChoice, Trims, Wound};
pub use propose::{PoseServed, Proposal, ProposeOptions, propose};
pub use robust::{Sewn, by_hand, sewn};
pub use search::rig;
pub use trial::{Reached, Scrutiny, Trial};

#[cfg(test)]
mod tests;
