//! Commands that choose the language of the window: that of the system, and one for each that it speaks.

use super::command::Command;
use crate::studio::language::{self, Language, tf};
use crate::studio::session::Session;
use std::sync::LazyLock;

pub static SYSTEM: Command = Command {
    on: Some(&|session| session.look.language.chosen.is_none()),
    run: &|session, _| session.look.language.chosen = None,
    ..Command::new("language.system", "System language", "Language of the window: that of the system")
};

/// One for each language, in the order of their table.
pub static EACH: LazyLock<Vec<Command>> = LazyLock::new(|| language::ALL.iter().map(command).collect());

/// That of the system first.
pub fn all() -> impl Iterator<Item = &'static Command> {
    std::iter::once(&SYSTEM).chain(EACH.iter())
}

fn command(language: &'static Language) -> Command {
    let name = language.name;
    Command {
        on: Some(Box::leak(Box::new(move |session: &Session| session.look.language.chosen == Some(language)))),
        run: Box::leak(Box::new(move |session: &mut Session, _| session.look.language.chosen = Some(language))),
        detail: Box::leak(Box::new(move |_: &Session| Some(tf!("Language of the window: {name}", name)))),
        ..Command::new(
            Box::leak(format!("language.{}", language.code).into_boxed_str()),
            name,
            Box::leak(format!("Language of the window: {name}").into_boxed_str()),
        )
    }
}
