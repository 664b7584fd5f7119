//! Commands that show a panel: one for each.

use super::command::{Command, Scope};
use crate::studio::panels::{self, Entry};
use crate::studio::session::Session;
use std::sync::LazyLock;

/// One for each panel, in the order of their tabs.
pub static ALL: LazyLock<Vec<Command>> = LazyLock::new(|| panels::ALL.into_iter().map(command).collect());

fn command(entry: &'static Entry) -> Command {
    Command {
        scope: Scope::Views,
        on: Some(Box::leak(Box::new(|session: &Session| {
            session.panel(&panels::ALL.map(|entry| entry.id)) == entry.id
        }))),
        run: Box::leak(Box::new(|session: &mut Session, _| session.panel = entry.id)),
        ..Command::new(entry.id, Box::leak(format!("Panel {}", entry.label).into_boxed_str()), entry.tip)
    }
}
