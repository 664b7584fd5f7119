//! Buttons of commands: what they are called, what they say and whether they can be pressed comes from the table.

use super::widgets;
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::Hit;
use crate::studio::commands::command::Command;
use crate::studio::commands::document::CANCEL_MESHING;
use crate::studio::icons;
use crate::studio::language::t;
use crate::studio::session::Session;
use eframe::egui::{Button, Response, RichText, Spinner, Ui};

/// Side of an icon in lists and headings, logical pixels.
const SMALL: f32 = 22.0;

/// A square with the icon.
pub fn icon(ui: &mut Ui, session: &Session, command: &'static Command, actions: &mut Actions) {
    square(ui, session, command, icons::BUTTON, actions);
}

/// For lists and headings.
pub fn small_icon(ui: &mut Ui, session: &Session, command: &'static Command, actions: &mut Actions) {
    square(ui, session, command, SMALL, actions);
}

/// Its label without the dots that promise a dialog.
pub fn text(ui: &mut Ui, session: &Session, command: &'static Command, actions: &mut Actions) {
    let label = command.label(session).trim_end_matches('…');
    show(ui, session, command, actions, |ui| ui.button(label));
}

/// One that can be on or off, as text.
pub fn choice(ui: &mut Ui, session: &Session, command: &'static Command, actions: &mut Actions) {
    show(ui, session, command, actions, |ui| ui.selectable_label(command.is_on(session), command.label(session)));
}

/// One that can be on or off, as a box to tick.
pub fn tick(ui: &mut Ui, session: &Session, command: &'static Command, actions: &mut Actions) {
    let mut on = command.is_on(session);
    show(ui, session, command, actions, |ui| ui.checkbox(&mut on, command.label(session)));
}

/// `widgets::primary` of a command. `ready`: whether what the panel knows allows it.
pub fn primary(
    ui: &mut Ui,
    session: &Session,
    command: &'static Command,
    ready: bool,
    width: f32,
    actions: &mut Actions,
) {
    let text = command.label(session);
    ui.add_enabled_ui(ready, |ui| show(ui, session, command, actions, |ui| widgets::primary(ui, true, text, width)));
}

/// A button of a given width, its text in the middle.
pub fn wide(ui: &mut Ui, session: &Session, command: &'static Command, width: f32, actions: &mut Actions) {
    let button = Button::new(command.label(session));
    show(ui, session, command, actions, |ui| widgets::wide(ui, button, width));
}

/// A line of a menu; `at` is what the menu is about.
pub fn entry(ui: &mut Ui, session: &Session, command: &'static Command, at: Hit, actions: &mut Actions) {
    let keys = command.keys.first().map(|keys| keys.text()).unwrap_or_default();
    let button = Button::new(command.label(session)).shortcut_text(RichText::new(keys).weak());
    let response = ui.add(button).accessible_name(command.label(session));
    if response.on_hover_text(command.tip(session)).clicked() {
        actions.push(Action::Run(command, at));
        ui.close();
    }
}

/// A line of a menu that is on or off.
pub fn ticked(ui: &mut Ui, session: &Session, command: &'static Command, at: Hit, actions: &mut Actions) {
    let keys = command.keys.first().map(|keys| keys.text()).unwrap_or_default();
    let refused = command.refused(session, at);
    let button = Button::selectable(command.is_on(session), command.label(session));
    let button = button.shortcut_text(RichText::new(keys).weak());
    let response = ui.add_enabled(refused.is_none(), button).accessible_name(command.label(session));
    let why = command.hint(refused.unwrap_or(t(command.tip)));
    if response.on_hover_text(command.tip(session)).on_disabled_hover_text(why).clicked() {
        actions.push(Action::Run(command, at));
        ui.close();
    }
}

fn square(ui: &mut Ui, session: &Session, command: &'static Command, side: f32, actions: &mut Actions) {
    let Some(icon) = command.icon(session) else { return text(ui, session, command, actions) };
    // One that changes its face says what a press does, not what is.
    let on = command.on.filter(|_| command.face_on.is_none()).map(|on| on(session));
    show(ui, session, command, actions, |ui| icons::draw_button(ui, icon, command.label(session), on, side));
}

/// A spinner with a way to cancel, in the place of a button that is at work.
pub fn meshing(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ui.horizontal(|ui| {
        ui.add(Spinner::new());
        ui.label(t("Meshing"));
        text(ui, session, &CANCEL_MESHING, actions);
    });
}

/// Whatever button it is: runs its command, and says what that does or why it cannot be done.
fn show(
    ui: &mut Ui,
    session: &Session,
    command: &'static Command,
    actions: &mut Actions,
    add: impl FnOnce(&mut Ui) -> Response,
) {
    let at = session.selected();
    let refused = command.refused(session, at);
    // Only where it must be: what is in a part of its own does not go to the next line with the rest.
    let response = if refused.is_none() { add(ui) } else { ui.add_enabled_ui(false, add).inner };
    let why = command.hint(refused.unwrap_or(t(command.tip)));
    if response.on_hover_text(command.tip(session)).on_disabled_hover_text(why).clicked() {
        actions.push(Action::Run(command, at));
    }
}
