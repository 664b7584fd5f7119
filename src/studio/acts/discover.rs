//! Network discovery on its thread, and what becomes of its proposals.

use super::edit;
use crate::rigging::{Proposal, ProposeOptions};
use crate::studio::change::Change;
use crate::studio::jobs::{Outcome, Running};
use crate::studio::language::{mark, t};
use crate::studio::session::Session;
use std::sync::Arc;

/// Begins to look for networks; what is looked for elsewhere is given up.
pub fn start_propose(session: &mut Session) {
    if let Some(why) = session.cannot_propose() {
        session.messages.info(why);
        return;
    }
    session.discovery.cancel();
    take_back(session);
    let (design, targets) = (session.design().clone(), session.targets().to_vec());
    session.discovery.ask(&design, &targets);
    let options = session.discovery.options.clone();
    let propose = session.services.propose.clone();
    let (coming, wake) = (session.discovery.coming.clone(), session.jobs.wake());
    session.discovery.running = Some(session.jobs.start(mark("Network discovery"), move |cancel| {
        let mut found = |list: &[Arc<Proposal>]| {
            if let Ok(mut coming) = coming.lock() {
                *coming = Some(list.to_vec());
            }
            wake();
        };
        Outcome::Proposed(propose(&design, &targets, &options, &mut found, cancel))
    }));
}

/// Other parameters: where there was a search, it begins anew with them as soon as the hand is off.
pub fn set_options(session: &mut Session, options: ProposeOptions) {
    session.discovery.restart |= session.discovery.has_asked() && !session.discovery.is_stale();
    session.discovery.options = options;
}

/// Begins the search anew that other parameters ask for.
pub fn live(session: &mut Session, hands_off: bool) {
    if hands_off && std::mem::take(&mut session.discovery.restart) {
        session.discovery.cancel();
        start_propose(session);
    }
}

/// Takes what has been found by now, and finds out whether it still belongs to what is there.
pub fn follow(session: &mut Session) {
    if session.discovery.has_asked() {
        let (design, targets) = (session.design().clone(), session.targets().to_vec());
        session.discovery.follow(&design, &targets);
        session.discovery.take_coming();
        if !session.discovery.has_asked() {
            take_back(session);
        }
    }
}

/// Nothing was found, but for another body or pose.
fn take_back(session: &mut Session) {
    [true, false].into_iter().for_each(|rules| session.messages.take_back(nothing(rules)));
}

/// The search is over.
pub fn take_proposals(session: &mut Session, serial: u64, proposals: Vec<Arc<Proposal>>) {
    if !Running::is(session.discovery.running.as_ref(), serial) {
        return;
    }
    session.discovery.running = None;
    let (design, targets) = (session.design().clone(), session.targets().to_vec());
    if proposals.is_empty() && session.discovery.is_for(&design, &targets) {
        session.messages.warning(nothing(session.discovery.options.rules));
    }
    session.discovery.take(proposals);
}

/// What is said where nothing was found, `rules` kept or not.
fn nothing(rules: bool) -> &'static str {
    match rules {
        true => t(
            "No network that can be sewn was found for this pose. Move its goals nearer, allow more tendons, or take “Only what can be sewn” off under Advanced.",
        ),
        false => t("No network was found for this pose. Move its goals nearer, or allow more tendons."),
    }
}

/// Builds the network of the shown proposal in. The others are of a body without it.
pub fn accept(session: &mut Session) {
    if session.discovery.is_stale() {
        return;
    }
    if let Some(proposal) = session.shown_proposal().cloned() {
        session.discovery.cancel();
        session.discovery.clear();
        edit::change(session, Change::AcceptNetwork(proposal.network.clone()));
    }
}
