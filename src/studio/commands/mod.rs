//! The table of commands: what a user can ask for, once.
//!
//! A command is a `static` in the file of its subject and a line in the `ALL` of that file; a new subject is a file and a line here.

pub mod animation;
pub mod command;
pub mod discovery;
pub mod document;
pub mod files;
pub mod languages;
pub mod layers;
pub mod looks;
pub mod motors;
pub mod networks;
pub mod outline;
pub mod panels;
pub mod posing;
pub mod tools;
pub mod view;

pub use command::{Command, Group, Place};

use crate::studio::language::mark;
use std::sync::LazyLock;

/// The commands by subject, in the order of the page of shortcuts.
pub static ALL: LazyLock<Vec<(&str, Vec<&Command>)>> = LazyLock::new(|| {
    vec![
        (mark("Files"), files::ALL.to_vec()),
        (mark("Document"), document::ALL.to_vec()),
        (mark("Posing"), posing::ALL.to_vec()),
        (mark("Tools"), tools::ALL.iter().collect()),
        (mark("View"), view::ALL.to_vec()),
        (mark("Layers"), layers::ALL.iter().collect()),
        (mark("Looks"), looks::ALL.iter().collect()),
        (mark("Language"), languages::all().collect()),
        (mark("Networks"), discovery::ALL.to_vec()),
        (mark("Winches and tendons"), networks::ALL.to_vec()),
        (mark("Animation"), animation::ALL.to_vec()),
        (mark("Motors"), motors::ALL.to_vec()),
        (mark("Panels"), panels::ALL.iter().collect()),
        (mark("Outline"), outline::ALL.to_vec()),
    ]
});

/// All of them, in order.
pub fn all() -> impl Iterator<Item = &'static Command> {
    ALL.iter().flat_map(|(_, commands)| commands.iter().copied())
}

/// Those that stand in a place.
pub fn at(place: Place) -> impl Iterator<Item = &'static Command> {
    all().filter(move |command| command.stands(place))
}

#[cfg(test)]
mod tests {
    use super::command::Scope;
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_command_has_an_id_a_label_and_a_tip_of_its_own() {
        for of in [|c: &Command| c.id, |c: &Command| c.tip] {
            let found: BTreeSet<&str> = all().map(of).collect();
            assert_eq!(found.len(), all().count());
            assert!(found.iter().all(|text| text.len() > 3 && !text.ends_with('.')), "{found:?}");
        }
        for scope in [Scope::Views, Scope::Outline] {
            let there = || all().filter(|command| command.scope == Scope::Anywhere || command.scope == scope);
            let labels: BTreeSet<&str> = there().map(|command| command.label).collect();
            assert_eq!(labels.len(), there().count());
        }
        assert!(all().all(|command| {
            command.id.split_once('.').is_some_and(|(subject, name)| !subject.is_empty() && !name.is_empty())
        }));
    }

    #[test]
    fn no_key_runs_two_commands() {
        for scope in [Scope::Views, Scope::Outline] {
            let mut seen = BTreeSet::new();
            for command in all().filter(|command| command.scope == Scope::Anywhere || command.scope == scope) {
                for keys in command.keys {
                    assert!(seen.insert(keys.text()), "{} stands twice while {scope:?} are shown", keys.text());
                }
            }
        }
    }

    #[test]
    fn every_place_is_filled_and_an_icon_is_there_where_the_toolbar_shows_one() {
        let groups = [Group::File, Group::History, Group::Tools, Group::Shown, Group::Views, Group::Right];
        for place in [Place::FileMenu, Place::ContextMenu, Place::LookMenu, Place::ViewMenu]
            .into_iter()
            .chain(groups.map(Place::Toolbar))
        {
            assert!(at(place).count() > 0, "{place:?}");
        }
        for command in at(Place::Toolbar(Group::Tools)).chain(at(Place::Toolbar(Group::Shown))) {
            assert!(command.icon.is_some(), "{}", command.id);
        }
    }

    #[test]
    fn words_are_followed_by_the_keys() {
        assert_eq!(document::REDO.hint("Again"), format!("Again ({})", document::REDO.keys_text()));
        assert_eq!(document::REDO.keys_text().replace("Cmd", "Ctrl"), "Ctrl+Shift+Z or Ctrl+Y");
        assert_eq!(view::ZOOM_IN.keys[0].text(), "Plus");
    }
}
