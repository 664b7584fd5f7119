//! Commands of winches and tendons that are changed by hand.

use super::command::{Command, Place, Scope};
use crate::operations::network::{Edit, Part};
use crate::outline::Point;
use crate::studio::acts;
use crate::studio::canvas::Hit;
use crate::studio::change::Change;
use crate::studio::icons::Icon;
use crate::studio::language::{mark, t};
use crate::studio::session::Session;

pub static ALL: [&Command; 11] =
    [&ADD_HOLE, &REMOVE_HOLE, &ADD_TENDON, &SPLIT, &REMOVE_TENDON, &REMOVE_WINCH, &MUTE, &SOLO, &UP, &DOWN, &SLACKEN];

const NO_TENDON: &str = mark("Select a tendon first, or point at one");

pub static ADD_HOLE: Command = Command {
    icon: Some(Icon::Plus),
    scope: Scope::Views,
    places: &[Place::ContextMenu],
    why_not: &|_, at| (!matches!(at, Hit::Part(Part::Piece(..)))).then_some(t("Point at a piece of cable first")),
    run: &|session, at| {
        if let Hit::Part(part @ Part::Piece(winch, tendon, piece)) = at
            && let Some(at) = part.place(session.design())
        {
            change(session, Edit::AddHole { winch, tendon, piece, at });
        }
    },
    ..Command::new("network.add-hole", "Add hole", "Put a hole in the middle of the piece of cable that is pointed at")
};

pub static REMOVE_HOLE: Command = Command {
    scope: Scope::Views,
    places: &[Place::ContextMenu],
    why_not: &|_, at| (!matches!(at, Hit::Part(Part::Hole(..)))).then_some(t("Select a hole or an end first")),
    run: &|session, at| remove(session, at),
    ..Command::new("network.remove-hole", "Remove hole", "Take out the hole or the end that is selected or pointed at")
};

pub static ADD_TENDON: Command = Command {
    scope: Scope::Views,
    places: &[Place::ContextMenu],
    why_not: &|session, at| new_end(session, at).is_none().then_some(t("Select a winch first, and point at the body")),
    run: &|session, at| {
        if let Some((winch, end)) = new_end(session, at) {
            change(session, Edit::AddTendon { winch, through: vec![end] });
        }
    },
    ..Command::new("network.add-tendon", "Add tendon to here", "Draw a tendon from the selected winch to the pointer")
};

pub static SPLIT: Command = Command {
    scope: Scope::Views,
    places: &[Place::ContextMenu],
    why_not: &|session, at| match tendon(at) {
        None => Some(t(NO_TENDON)),
        Some((winch, _)) => {
            let alone = session.design().networks.get(winch).is_none_or(|network| network.tendons.len() < 2);
            alone.then_some(t("The winch has no other tendon"))
        }
    },
    run: &|session, at| {
        if let Some((winch, tendon)) = tendon(at) {
            change(session, Edit::Split { winch, tendons: vec![tendon], at: None });
        }
    },
    ..Command::new("network.split", "Winch of its own", "Give the tendon a winch of its own beside the old one")
};

pub static REMOVE_TENDON: Command = Command {
    scope: Scope::Views,
    places: &[Place::ContextMenu],
    why_not: &|_, at| tendon(at).is_none().then_some(t(NO_TENDON)),
    run: &|session, at| {
        if let Some((winch, tendon)) = tendon(at) {
            change(session, Edit::Remove(Part::Tendon(winch, tendon)));
        }
    },
    ..Command::new("network.remove-tendon", "Remove tendon", "Take out the tendon that is selected or pointed at")
};

pub static REMOVE_WINCH: Command = Command {
    icon: Some(Icon::Trash),
    scope: Scope::Views,
    places: &[Place::ContextMenu],
    why_not: &|_, at| (!matches!(at, Hit::Part(Part::Winch(_)))).then_some(t("Select a winch first")),
    run: &|session, at| remove(session, at),
    ..Command::new(
        "network.remove",
        "Remove winch",
        "Take out the winch that is selected or pointed at, with its tendons",
    )
};

pub static MUTE: Command = Command {
    scope: Scope::Views,
    places: &[Place::ContextMenu],
    on: Some(&|session| selected(session).is_some_and(|winch| session.design().networks[winch].muted)),
    face_on: Some((Icon::Check, "Switch on", "Let the winch pull again")),
    why_not: &|session, at| network(session, at).is_none().then_some(t(NO_WINCH)),
    run: &|session, at| {
        if let Some(winch) = network(session, at) {
            let muted = !session.design().networks[winch].muted;
            change(session, Edit::Mute { winch, muted });
        }
    },
    ..Command::new(
        "network.mute",
        "Switch off",
        "As if the winch were not there, in poses, figures and blueprints; its keyframes stay",
    )
};

pub static SOLO: Command = Command {
    scope: Scope::Views,
    on: Some(&|session| {
        let name = selected(session).map(|winch| session.design().networks[winch].name.as_str());
        name.is_some() && session.solo().name() == name
    }),
    why_not: &|session, at| (network(session, at).is_none() && session.solo().name().is_none()).then_some(t(NO_WINCH)),
    run: &|session, at| {
        let name = network(session, at).map(|winch| session.design().networks[winch].name.clone());
        session.solo.toggle(name);
    },
    ..Command::new(
        "network.solo",
        "Solo",
        "Show what this winch does alone, in this window only; the document stays as it is",
    )
};

pub static UP: Command = Command {
    scope: Scope::Views,
    why_not: &|session, at| match network(session, at) {
        None => Some(t(NO_WINCH)),
        Some(0) => Some(t("It is the first one")),
        Some(_) => None,
    },
    run: &|session, at| {
        if let Some(winch) = network(session, at) {
            change(session, Edit::Reorder { winch, to: winch.saturating_sub(1) });
        }
    },
    ..Command::new("network.up", "Up", "Move the network up in the list")
};

pub static DOWN: Command = Command {
    scope: Scope::Views,
    why_not: &|session, at| match network(session, at) {
        None => Some(t(NO_WINCH)),
        Some(winch) => (winch + 1 >= session.design().networks.len()).then_some(t("It is the last one")),
    },
    run: &|session, at| {
        if let Some(winch) = network(session, at) {
            change(session, Edit::Reorder { winch, to: winch + 1 });
        }
    },
    ..Command::new("network.down", "Down", "Move the network down in the list")
};

pub static SLACKEN: Command = Command {
    scope: Scope::Views,
    why_not: &|session, _| session.design().networks.is_empty().then_some(t("There are no winches")),
    run: &|session, _| acts::wind::slacken(session),
    ..Command::new("network.slacken", "All slack", "Wind nothing, by hand")
};

const NO_WINCH: &str = mark("Select a winch first");

/// The network that is selected.
fn selected(session: &Session) -> Option<usize> {
    session.selection().network().filter(|&winch| winch < session.design().networks.len())
}

/// The network that is pointed at, or else selected.
fn network(session: &Session, at: Hit) -> Option<usize> {
    match at {
        Hit::Part(part) => Some(part.winch()).filter(|&winch| winch < session.design().networks.len()),
        Hit::Nothing => selected(session),
        _ => None,
    }
}

fn change(session: &mut Session, edit: Edit) {
    acts::edit::change(session, Change::Network(edit));
}

fn remove(session: &mut Session, at: Hit) {
    if let Hit::Part(part) = at {
        change(session, Edit::Remove(part));
    }
}

fn tendon(at: Hit) -> Option<(usize, usize)> {
    match at {
        Hit::Part(part) => Some((part.winch(), part.tendon()?)),
        _ => None,
    }
}

/// The winch that is selected, and the place at rest of the body under the pointer.
fn new_end(session: &Session, at: Hit) -> Option<(usize, Point)> {
    let Hit::Body(at) = at else { return None };
    let mesh = &session.design().mesh;
    Some((session.selection().network()?, mesh.position(&at, &mesh.nodes)))
}
