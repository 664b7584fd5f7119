//! Commands of network discovery.

use super::command::{Command, Keys, Scope};
use crate::studio::acts;
use crate::studio::jobs;
use crate::studio::language::t;
use crate::studio::session::Session;
use eframe::egui::{Key, Modifiers};

pub static ALL: [&Command; 10] =
    [&PROPOSE, &PROPOSE_AGAIN, &CANCEL, &ACCEPT, &REJECT, &RIG, &KEEP_RIG, &CANCEL_RIG, &CURVE, &CANCEL_CURVE];

pub static PROPOSE: Command = Command {
    keys: &[Keys::plain(Key::G)],
    scope: Scope::Views,
    why_not: &|session, _| session.cannot_propose(),
    run: &|session, _| acts::discover::start_propose(session),
    ..Command::new("discovery.propose", "Propose networks", "Look for winch-tendon networks that reach this pose")
};

pub static PROPOSE_AGAIN: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| match session.discovery().is_stale() {
        true => session.cannot_propose(),
        false => Some(t("What was proposed is for this body and pose")),
    },
    run: &|session, _| acts::discover::start_propose(session),
    ..Command::new("discovery.again", "Propose again", "Look for networks for the body and the pose as they are now")
};

pub static CANCEL: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| session.discovery().running.is_none().then_some(t("No networks are being looked for")),
    run: &|session, _| session.discovery.cancel(),
    ..Command::new("discovery.cancel", "Stop looking", "Stop looking for networks")
};

pub static ACCEPT: Command = Command {
    keys: &[Keys::plain(Key::Enter)],
    scope: Scope::Views,
    why_not: &|session, _| none_shown(session),
    run: &|session, _| acts::discover::accept(session),
    ..Command::new("discovery.accept", "Accept", "Build this network in")
};

pub static REJECT: Command = Command {
    keys: &[Keys { modifiers: Modifiers::SHIFT, key: Key::Backspace }],
    scope: Scope::Views,
    why_not: &|session, _| none_shown(session),
    run: &|session, _| session.discovery.reject(),
    ..Command::new("discovery.reject", "Reject", "Drop this proposal")
};

pub static RIG: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| session.cannot_rig(),
    run: &|session, _| acts::rig::start_rig(session),
    ..Command::new(
        "rig.start",
        "Rig all poses",
        "Look for winches and tendons that serve all poses, and lay the poses on an empty timeline",
    )
};

pub static KEEP_RIG: Command = Command {
    why_not: &|session, _| match &session.rigging().running {
        None => Some(t("No rig is being looked for")),
        Some(_) => session.rigging().ending.then(|| t("Stopping")),
    },
    run: &|session, _| session.rigging.keep_best(),
    ..Command::new(
        "rig.keep",
        "Take the best so far",
        "Stop looking, and build in the best winches and tendons that were found by now",
    )
};

pub static CANCEL_RIG: Command = Command {
    why_not: &|session, _| session.rigging().running.is_none().then_some(t("No rig is being looked for")),
    run: &|session, _| session.rigging.cancel(),
    ..Command::new("rig.cancel", "Cancel rigging", "Stop looking for winches and tendons; the plushie stays as it is")
};

pub static CURVE: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| session.cannot_rig(),
    run: &|session, _| acts::rig::start_curve(session),
    ..Command::new(
        "rig.curve",
        "Compare numbers of winches",
        "Look for a rig with every number of winches and tendons up to the most, to choose from. Takes minutes",
    )
};

pub static CANCEL_CURVE: Command = Command {
    why_not: &|session, _| session.rigging().curve.running.is_none().then_some(t("No rigs are being compared")),
    run: &|session, _| jobs::cancel(&mut session.rigging.curve.running),
    ..Command::new("rig.curve.cancel", "Stop comparing", "Stop looking for more rigs; those that were found stay")
};

fn none_shown(session: &Session) -> Option<&'static str> {
    if session.discovery().is_stale() {
        return Some(t("What was proposed is for another body or pose: propose again"));
    }
    session.shown_proposal().is_none().then_some(t("No proposal is shown"))
}
