//! Networks for a pose, tried out by simulation, the best first.

use super::posing::{self, NoSuchPose};
use super::{Cancelled, Context, Progress};
use crate::design::edit::{self, EditError};
use crate::design::{Design, Network, Target};
use crate::rigging::{self, Proposal, ProposeOptions};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Which pose is served, and how networks are looked for.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Options {
    pub pose: String,
    pub search: ProposeOptions,
}

/// Why there is no proposal.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    #[error(transparent)]
    NoSuchPose(#[from] NoSuchPose),
    #[error("the pose has no targets to be reached")]
    NoTargets,
    #[error("no network brings the pose closer to its targets")]
    NothingFound,
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Looks for networks that bring the realizable plushie closer to a pose, and tells the list of them as it grows. The design stays as it is: accepting one is an edit.
///
/// # Errors
/// There is no such pose, it has no targets, nothing helps; [`Error::Cancelled`].
pub fn run(design: &Design, options: &Options, context: &mut Context) -> Result<Vec<Arc<Proposal>>, Error> {
    let targets = posing::targets(design, &options.pose)?;
    for_targets(design, &targets, &options.search, context)
}

/// [`run`] for the targets of a pose.
///
/// # Errors
/// As [`run`].
pub fn for_targets(
    design: &Design,
    targets: &[Target],
    options: &ProposeOptions,
    context: &mut Context,
) -> Result<Vec<Arc<Proposal>>, Error> {
    if targets.is_empty() {
        return Err(Error::NoTargets);
    }
    let cancel = context.cancel();
    let mut found = |list: &[Arc<Proposal>]| context.tell(&Progress::Proposals(list.to_vec()));
    let proposals = rigging::propose(design, targets, options, &mut found, cancel);
    context.check()?;
    if proposals.is_empty() { Err(Error::NothingFound) } else { Ok(proposals) }
}

/// Builds the network of a proposal in, slack in every keyframe so far; its index among the networks.
///
/// # Errors
/// It was proposed for another mesh; the design stays as it was.
pub fn accept(design: &mut Design, network: Network) -> Result<usize, EditError> {
    edit::accept_network(design, network)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::testing;
    use std::sync::atomic::AtomicBool;

    #[test]
    fn what_cannot_be_proposed_for_is_told_apart() {
        let design = testing::sample();
        let (go, stop) = (AtomicBool::new(false), AtomicBool::new(true));
        let of = |pose: &str, cancel| {
            let options = Options { pose: pose.to_owned(), ..Options::default() };
            run(&design, &options, &mut Context::new(cancel)).map(|proposals| proposals.len())
        };
        assert!(matches!(of("none", &go), Err(Error::NoSuchPose(_))));
        assert_eq!(of("rest", &go), Err(Error::NoTargets));
        assert_eq!(of("lean", &stop), Err(Error::Cancelled(Cancelled)));
    }
}
