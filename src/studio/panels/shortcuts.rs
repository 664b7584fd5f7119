//! The page of shortcuts: what every key does.

use super::widgets::{dialog_frame, heading, scroll};
use crate::studio::action::{Action, Actions};
use crate::studio::commands;
use crate::studio::language::t;
use crate::studio::session::{Overlay, Session};
use eframe::egui::{Context, Grid, Id, Modal, RichText};

/// Logical pixels.
const SIZE: [f32; 2] = [520.0, 480.0];
/// Width of the keys, so that what they do stands in one column in every language, logical pixels.
const KEYS: f32 = 210.0;

pub fn show(ctx: &Context, session: &Session, actions: &mut Actions) {
    if session.overlay() != Some(Overlay::Shortcuts) {
        return;
    }
    let modal = Modal::new(Id::unique("shortcuts")).frame(dialog_frame(ctx)).show(ctx, |ui| {
        ui.set_width(SIZE[0]);
        ui.heading(t("Keyboard shortcuts"));
        scroll(SIZE[1]).show(ui, |ui| {
            for (subject, list) in commands::ALL.iter() {
                ui.add_space(6.0);
                heading(ui, t(subject));
                Grid::new(*subject).num_columns(2).min_col_width(KEYS).spacing([12.0, 3.0]).show(ui, |ui| {
                    for command in list.iter().filter(|command| !command.keys.is_empty()) {
                        ui.label(RichText::new(command.keys_text()).monospace());
                        ui.label(t(command.label).trim_end_matches('…')).on_hover_text(t(command.tip));
                        ui.end_row();
                    }
                });
            }
        });
        ui.add_space(6.0);
        if ui.button(t("Close")).clicked() {
            actions.push(Action::Overlay(None));
        }
    });
    if modal.should_close() {
        actions.push(Action::Overlay(None));
    }
}
