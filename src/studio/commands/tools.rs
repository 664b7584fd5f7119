//! Commands that take a tool: one for each.

use super::command::{Command, Group, Place, Scope};
use crate::studio::session::Session;
use crate::studio::tools::{self, Entry, taken};
use std::sync::LazyLock;

/// One for each tool, in the order of their table.
pub static ALL: LazyLock<Vec<Command>> = LazyLock::new(|| tools::ALL.into_iter().map(command).collect());

/// The command that takes a tool, by its id.
pub fn take(id: &str) -> Option<&'static Command> {
    ALL.iter().find(|command| command.id == id)
}

fn command(entry: &'static Entry) -> Command {
    let on_views = entry.canvas == Scope::Views;
    Command {
        icon: entry.icon,
        keys: entry.keys,
        scope: entry.canvas,
        places: if on_views { &[Place::Toolbar(Group::Tools)] } else { &[] },
        ends_drawing: !on_views,
        on: Some(Box::leak(Box::new(move |session: &Session| {
            taken(session, entry.canvas).id == entry.id && session.sketching().open != on_views
        }))),
        run: Box::leak(Box::new(move |session: &mut Session, _| session.tools[usize::from(!on_views)] = entry.id)),
        ..Command::new(entry.id, entry.label, entry.tip)
    }
}
