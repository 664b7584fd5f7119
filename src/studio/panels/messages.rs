//! Messages at the foot of a side panel, beside the work; nothing waits for them.

use super::widgets::frame;
use crate::studio::action::{Action, Actions};
use crate::studio::commands::files::LOG;
use crate::studio::icons::{self, Icon};
use crate::studio::language::t;
use crate::studio::messages::{Level, Message};
use crate::studio::session::Session;
use eframe::egui::{Color32, Frame, Label, Panel, RichText, ScrollArea, Sense, Ui, UiBuilder, Visuals, vec2};

/// Part of the side panel's height that messages take at most.
const MOST: f32 = 0.22;
/// What the button takes on the right, logical pixels.
const CLOSE: f32 = 28.0;

/// A side panel with messages at its foot, as long as there is something to say. However they come and go, the widgets above keep their ids: a click
/// or a drag that is under way finds them again, and so does the keyboard.
pub fn below(ui: &mut Ui, session: &Session, actions: &mut Actions, panel: impl FnOnce(&mut Ui, &mut Actions)) {
    let own = UiBuilder::new().scope_id(ui.unique_id().with("above messages"));
    if !session.messages.list().is_empty() {
        foot(ui, session, actions);
    }
    ui.scope_builder(own, |ui| panel(ui, actions));
}

fn foot(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let most = MOST * ui.available_height();
    let panel = Panel::bottom("messages").frame(Frame::new()).resizable(false).show_separator_line(false);
    let shown = panel.show(ui, |ui| {
        // The newest on top, from its beginning: that is what somebody looks for.
        ScrollArea::vertical().id_salt("messages").max_height(most).auto_shrink([false, true]).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 4.0;
            for message in session.messages.list().iter().rev() {
                row(ui, message, actions);
            }
        });
        if ui.link(t("All messages")).on_hover_text(t(LOG.tip)).clicked() {
            actions.push(Action::Run(&LOG, session.selected()));
        }
    });
    // A panel has the height of what was in it in the frame before.
    let (id, height) = (shown.response.id.with("height"), shown.response.rect.height());
    if ui.data(|data| data.get_temp(id)) != Some(height) {
        ui.data_mut(|data| data.insert_temp(id, height));
        ui.ctx().request_repaint();
    }
}

fn row(ui: &mut Ui, message: &Message, actions: &mut Actions) {
    let color = color(ui.visuals(), message.level);
    frame().inner_margin(6).fill(ui.visuals().faint_bg_color).corner_radius(6).show(ui, |ui| {
        ui.horizontal_top(|ui| {
            let (bar, _) = ui.allocate_exact_size(vec2(3.0, 16.0), Sense::hover());
            ui.painter().rect_filled(bar, 1.5, color);
            ui.vertical(|ui| {
                ui.set_width((ui.available_width() - CLOSE).max(1.0));
                ui.add(Label::new(RichText::new(&message.text).small().color(color)).wrap());
            });
            if icons::small_button(ui, Icon::Close, t("Dismiss message"), t("Dismiss")).clicked() {
                actions.push(Action::DismissMessage(message.id));
            }
        });
    });
}

/// The colour of a level of message.
pub fn color(visuals: &Visuals, level: Level) -> Color32 {
    match level {
        Level::Info => visuals.text_color(),
        Level::Warning => visuals.warn_fg_color,
        Level::Error => visuals.error_fg_color,
    }
}
