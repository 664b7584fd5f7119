//! Network discovery on its thread, and what becomes of its proposals.

use super::change::Change;
use super::jobs::{Outcome, Running};
use super::session::Session;
use crate::picture::Stage;
use crate::rigging::Proposal;
use std::sync::Arc;

impl Session {
    pub(super) fn start_propose(&mut self) {
        if let Some(why) = self.cannot_propose() {
            self.messages.info(why);
            return;
        }
        self.discovery.proposals.clear();
        self.discovery.shown = None;
        let design = self.design().clone();
        let (targets, parameters) = (self.targets().to_vec(), self.discovery.parameters.clone());
        let propose = self.services.propose.clone();
        self.discovery.running = Some(self.jobs.start("Network discovery", move |cancel| {
            Outcome::Proposed(propose(&design, &targets, &parameters, cancel))
        }));
    }

    pub(super) fn take_proposals(&mut self, serial: u64, proposals: Vec<Proposal>) {
        if !Running::is(self.discovery.running.as_ref(), serial) {
            return;
        }
        self.discovery.running = None;
        if proposals.is_empty() {
            self.messages.warning("No network was found for this pose. Try more seeds or longer joining paths.");
        }
        self.discovery.proposals = proposals.into_iter().map(Arc::new).collect();
        self.discovery.shown = if self.discovery.proposals.is_empty() { None } else { Some(0) };
        self.discovery.stage = Stage::Result;
    }

    pub(super) fn cancel_propose(&mut self) {
        if let Some(running) = self.discovery.running.take() {
            running.cancel();
        }
    }

    /// Builds the network of the shown proposal in.
    pub(super) fn accept(&mut self) {
        if let Some(proposal) = self.shown_proposal().cloned() {
            self.discovery.proposals.clear();
            self.discovery.shown = None;
            self.change(Change::AcceptNetwork(proposal.network.clone()));
        }
    }

    /// Drops the shown proposal; the next one is shown.
    pub(super) fn reject(&mut self) {
        if let Some(index) = self.discovery.shown.filter(|&index| index < self.discovery.proposals.len()) {
            self.discovery.proposals.remove(index);
            let left = self.discovery.proposals.len();
            self.discovery.shown = left.checked_sub(1).map(|last| index.min(last));
        }
    }
}
