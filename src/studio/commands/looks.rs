//! Commands that show the body in a look: one for each look of the pictures.

use super::command::{Command, Place, Scope};
use crate::picture::LOOKS;
use crate::picture::layers::LookEntry;
use crate::studio::session::Session;
use std::sync::LazyLock;

/// One for each look.
pub static ALL: LazyLock<Vec<Command>> = LazyLock::new(|| LOOKS.iter().map(command).collect());

fn command(look: &'static LookEntry) -> Command {
    Command {
        scope: Scope::Views,
        places: &[Place::LookMenu],
        on: Some(Box::leak(Box::new(move |session: &Session| session.look.body == look.name))),
        run: Box::leak(Box::new(move |session: &mut Session, _| session.look.body = look.name)),
        ..Command::new(Box::leak(format!("look.{}", look.name).into_boxed_str()), look.label, look.tip)
    }
}
