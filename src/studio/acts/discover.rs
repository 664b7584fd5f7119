//! Network discovery on its thread, and what becomes of its proposals.

use super::edit;
use crate::picture::Stage;
use crate::rigging::Proposal;
use crate::studio::change::Change;
use crate::studio::jobs::{Outcome, Running};
use crate::studio::session::Session;
use std::sync::Arc;

/// Begins to look for networks.
pub fn start_propose(session: &mut Session) {
    if let Some(why) = session.cannot_propose() {
        session.messages.info(why);
        return;
    }
    session.discovery.clear();
    let design = session.design().clone();
    let (targets, parameters) = (session.targets().to_vec(), session.discovery.parameters.clone());
    let propose = session.services.propose.clone();
    session.discovery.running =
        Some(session.jobs.start("Network discovery", move |cancel| {
            Outcome::Proposed(propose(&design, &targets, &parameters, cancel))
        }));
}

/// The search is over.
pub fn take_proposals(session: &mut Session, serial: u64, proposals: Vec<Proposal>) {
    if !Running::is(session.discovery.running.as_ref(), serial) {
        return;
    }
    session.discovery.running = None;
    if proposals.is_empty() {
        session.messages.warning("No network was found for this pose. Try more seeds or longer joining paths.");
    }
    session.discovery.proposals = proposals.into_iter().map(Arc::new).collect();
    session.discovery.shown = if session.discovery.proposals.is_empty() { None } else { Some(0) };
    session.discovery.stage = Stage::Result;
}

/// Builds the network of the shown proposal in.
pub fn accept(session: &mut Session) {
    if let Some(proposal) = session.shown_proposal().cloned() {
        session.discovery.clear();
        edit::change(session, Change::AcceptNetwork(proposal.network.clone()));
    }
}

/// Drops the shown proposal; the next one is shown.
pub fn reject(session: &mut Session) {
    if let Some(index) = session.discovery.shown.filter(|&index| index < session.discovery.proposals.len()) {
        session.discovery.proposals.remove(index);
        let left = session.discovery.proposals.len();
        session.discovery.shown = left.checked_sub(1).map(|last| index.min(last));
    }
}
