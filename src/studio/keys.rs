//! Keys that run commands, and files dropped on the window.

use super::action::{Action, FileAction};
use super::canvas;
use super::commands::animation::{COPY, CUT};
use super::commands::{self, Command};
use super::session::Session;
use eframe::egui::{Context, Event, Key, Popup};

/// Takes from the input the keys of commands.
pub fn collect(ctx: &Context, session: &Session, actions: &mut Vec<Action>) {
    for file in ctx.input(|i| i.raw.dropped_files.clone()) {
        actions.push(Action::File(FileAction::Dropped(file.path().to_path_buf())));
    }
    if session.is_covered() {
        return;
    }
    let typing = ctx.text_edit_focused();
    let focused = ctx.memory(|m| m.focused()).is_some() && !canvas::has_focus(ctx);
    let popup = Popup::is_any_open(ctx);
    let free = |command: &Command, key: Key| match key {
        // A focused button is pressed by them.
        Key::Space | Key::Enter => !focused,
        // An open menu or list is closed by it instead.
        Key::Escape => !popup && !typing,
        _ => !typing || command.while_typing,
    };
    ctx.input_mut(|input| {
        input.events.retain(|event| {
            // egui makes these of the keys, or of what the system says.
            let clipboard = match event {
                Event::Copy => Some(Action::Run(&COPY, session.selected())),
                Event::Cut => Some(Action::Run(&CUT, session.selected())),
                Event::Paste(text) => Some(Action::Paste(text.clone())),
                _ => None,
            };
            if let Some(action) = clipboard.filter(|_| !typing && !session.sketching().open) {
                actions.push(action);
                return false;
            }
            let Event::Key { key, pressed: true, modifiers, .. } = event else { return true };
            let is = |command: &&Command| {
                let mut keys = command.keys.iter();
                keys.any(|keys| keys.key == *key && modifiers.matches_exact(keys.modifiers)) && free(command, *key)
            };
            let Some(command) = commands::all().filter(|command| command.applies(session)).find(is) else {
                return true;
            };
            actions.push(Action::Run(command, session.selected()));
            false
        });
    });
}
