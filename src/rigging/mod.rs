//! Finds winches and tendons: networks are generated, tried out by simulation, judged, and the best accepted.
//!
//! | file | holds |
//! | --- | --- |
//! | `generators/` | where candidate networks come from, one way a file |
//! | `criteria/` | what makes one network better than another, one measure a file |
//! | `trial` | a design wound from rest towards a pose: what is really reached |
//! | `rank` | many candidates tried out and put in order |
//! | `polish` | small changes of a network's paths, as long as they help |
//! | `propose` | networks for one pose, for somebody to choose from |
//! | `search` | the design loop over all poses, without a hand (section 3) |
//!
//! The score of Algorithm 2 is a heuristic, and small differences in activations change the network it finds. So what counts
//! is the pose error that a simulated network really reaches.

pub mod activation;
mod candidate;
pub mod criteria;
pub mod criterion;
pub mod generator;
pub mod generators;
mod greedy;
pub mod joint;
pub mod layout;
mod linear_score;
pub mod moves;
mod options;
mod propose;
mod prune;
mod rank;
pub mod refine;
mod search;
pub mod sewable;
mod trial;
mod truth;

pub use candidate::{Baseline, Candidate, with_network};
pub use options::{BadTendons, Method, Progress, RigError, RigOptions, TendonChoice};
pub use propose::{Proposal, propose};
pub use search::rig;
pub use trial::{Reached, Scrutiny, Trial};

#[cfg(test)]
mod tests;
