//! The palette: every command by name, by keyboard alone.

use crate::studio::action::{Action, Actions};
use crate::studio::commands::{self, Command};
use crate::studio::language::t;
use crate::studio::session::{Overlay, Session};
use eframe::egui::{
    Button, Context, Id, Key, Modal, Modifiers, RichText, ScrollArea, TextEdit, Ui, accesskit::Role, vec2,
};

/// Room for a tip of two lines, logical pixels.
const TIP: f32 = 32.0;
/// Width and height of the list, logical pixels.
const SIZE: [f32; 2] = [460.0, 360.0];

/// The text that is looked for, and which of the commands found is chosen.
#[derive(Default)]
pub struct State {
    words: String,
    chosen: usize,
    /// It was open in the last frame.
    open: bool,
}

pub fn show(ctx: &Context, session: &Session, state: &mut State, actions: &mut Actions) {
    if session.overlay() != Some(Overlay::Palette) {
        *state = State::default();
        return;
    }
    let step = |key| ctx.input_mut(|i| i.consume_key(Modifiers::NONE, key));
    let (up, down, enter) = (step(Key::ArrowUp), step(Key::ArrowDown), step(Key::Enter));
    let modal = Modal::new(Id::unique("commands")).show(ctx, |ui| {
        ui.set_width(SIZE[0]);
        let field =
            TextEdit::singleline(&mut state.words).hint_text(t("Look for a command")).desired_width(f32::INFINITY);
        let field = ui.add(field).accessible_name(t("Look for a command"));
        if !field.has_focus() {
            field.request_focus();
        }
        if field.changed() {
            state.chosen = 0;
        }
        let found = matches(session, &state.words);
        state.chosen = match (up, down) {
            (true, _) => state.chosen.saturating_sub(1),
            (_, true) => state.chosen + 1,
            _ => state.chosen,
        };
        state.chosen = state.chosen.min(found.len().saturating_sub(1));
        list(ui, session, &found, state.chosen, up || down || field.changed(), actions);
        if let Some(command) = found.get(state.chosen).filter(|_| enter) {
            run(session, command, actions);
        }
    });
    // The key that opened it is not the one that closes it.
    if modal.should_close() && state.open {
        actions.push(Action::Overlay(None));
    }
    state.open = true;
}

fn list(ui: &mut Ui, session: &Session, found: &[&'static Command], chosen: usize, moved: bool, actions: &mut Actions) {
    // As high for few commands as for many, so that nothing moves under the pointer when it is opened again or typed into.
    ScrollArea::vertical().max_height(SIZE[1]).min_scrolled_height(SIZE[1]).auto_shrink(false).show(ui, |ui| {
        if found.is_empty() {
            ui.label(RichText::new(t("No command is called that")).weak());
        }
        ui.spacing_mut().item_spacing.y = 1.0;
        for (k, command) in found.iter().enumerate() {
            let refused = command.refused(session, session.selected());
            let row = |ui: &mut Ui| {
                let button = Button::selectable(k == chosen, command.label(session))
                    .right_text(RichText::new(command.keys_text()).small().weak())
                    .min_size(vec2(ui.available_width(), 26.0));
                ui.add(button)
            };
            let response = ui.add_enabled_ui(refused.is_none(), row).inner;
            let name = match refused {
                None => command.label(session).to_owned(),
                Some(why) => format!("{}: {why}", command.label(session)),
            };
            ui.ctx().accesskit_node_builder(response.id, |node| {
                node.set_role(Role::ListBoxOption);
                node.set_label(name);
                node.set_selected(k == chosen);
            });
            if k == chosen && moved {
                response.scroll_to_me(None);
            }
            if response.on_disabled_hover_text(refused.unwrap_or_default()).clicked() {
                run(session, command, actions);
            }
        }
    });
    // What the chosen one does, for the eye and for who listens.
    ui.separator();
    ui.scope(|ui| {
        ui.set_min_height(TIP);
        if let Some(command) = found.get(chosen) {
            let tip = command.refused(session, session.selected()).map_or_else(|| command.tip(session), str::to_owned);
            ui.label(RichText::new(tip).small().weak());
        }
    });
}

fn run(session: &Session, command: &'static Command, actions: &mut Actions) {
    actions.push(Action::Overlay(None));
    actions.push(Action::Run(command, session.selected()));
}

/// Commands that are there now and have all the words in label, tip or keys; those whose label begins with them first.
fn matches(session: &Session, words: &str) -> Vec<&'static Command> {
    let words = words.to_lowercase();
    let own = |command: &&Command| command.id != commands::files::PALETTE.id && command.applies(session);
    let mut found: Vec<(u8, &'static Command)> =
        commands::all().filter(own).filter_map(|command| Some((rank(session, command, &words)?, command))).collect();
    found.sort_by_key(|(rank, _)| *rank);
    found.into_iter().map(|(_, command)| command).collect()
}

/// How well a command fits, the best 0; none where a word is nowhere. What a page or a colleague calls it in English is found too.
fn rank(session: &Session, command: &Command, words: &str) -> Option<u8> {
    let labels = [command.label(session), command.label].map(str::to_lowercase);
    let tips = [&command.tip(session), t(command.tip), &command.keys_text()].join(" ").to_lowercase();
    let all = format!("{} {tips}", labels.join(" "));
    if !words.split_whitespace().all(|word| all.contains(word)) {
        return None;
    }
    let in_label = |label: &String| words.split_whitespace().all(|word| label.contains(word));
    Some(match (labels.iter().any(|label| label.starts_with(words.trim())), labels.iter().any(in_label)) {
        (true, _) => 0,
        (false, true) => 1,
        (false, false) => 2,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studio::canvas::Hit;
    use crate::studio::{blank, services};
    use std::sync::Arc;

    fn session() -> Session {
        Session::new(blank::design(), None, Arc::new(|| ()), services())
    }

    #[test]
    fn every_command_can_be_found_by_its_label() {
        let mut session = session();
        let mut found = vec![commands::files::PALETTE.id];
        for open in [false, true] {
            if open {
                (commands::outline::EDIT.run)(&mut session, Hit::Nothing);
            }
            for command in commands::all().filter(|c| c.applies(&session) && c.id != commands::files::PALETTE.id) {
                let first = matches(&session, command.label(&session));
                assert_eq!(first.first().map(|c| c.label(&session)), Some(command.label(&session)));
                found.push(command.id);
            }
        }
        assert!(commands::all().all(|command| found.contains(&command.id)));
    }

    #[test]
    fn the_beginning_of_a_label_counts_most_and_keys_count_too() {
        let session = session();
        let first = |words: &str| matches(&session, words).first().map(|command| command.id);
        assert_eq!(first("save"), Some("file.save"));
        assert_eq!(first("tool pin"), Some("tool.pin"));
        assert_eq!(first("F1"), Some("window.shortcuts"));
        assert_eq!(first("winch-tendon"), Some("discovery.propose"));
        assert_eq!(first("no such thing"), None);
    }
}
