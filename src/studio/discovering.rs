//! Network discovery on its thread, and what becomes of its proposals.

use super::change::Change;
use super::jobs::Report;
use super::session::{Running, Session};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

impl Session {
    pub(super) fn start_propose(&mut self) {
        if let Some(why) = self.cannot_propose() {
            self.messages.info(why);
            return;
        }
        let cancel = Arc::new(AtomicBool::new(false));
        self.discovery.serial += 1;
        self.discovery.running = Some(Running { started: Instant::now(), cancel: cancel.clone() });
        self.discovery.proposals.clear();
        self.discovery.shown = None;
        let (serial, design) = (self.discovery.serial, self.design().clone());
        let (targets, parameters) = (self.targets().to_vec(), self.discovery.parameters.clone());
        let propose = self.services.propose.clone();
        self.jobs.start("Network discovery", move || {
            let proposals = propose(&design, &targets, &parameters, &cancel);
            Report::Proposed { serial, proposals }
        });
    }

    pub(super) fn cancel_propose(&mut self) {
        if let Some(running) = self.discovery.running.take() {
            running.cancel.store(true, Ordering::Relaxed);
            // Whatever it still reports is not wanted.
            self.discovery.serial += 1;
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
