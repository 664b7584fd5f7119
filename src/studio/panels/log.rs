//! Everything that the window has said, the newest first.

use super::messages::color;
use super::widgets::{dialog_frame, scroll};
use crate::studio::action::{Action, Actions};
use crate::studio::language::t;
use crate::studio::session::{Overlay, Session};
use eframe::egui::{Context, Id, Label, Modal, RichText, Ui};

pub fn show(ctx: &Context, session: &Session, actions: &mut Actions) {
    if session.overlay() != Some(Overlay::Log) {
        return;
    }
    let modal = Modal::new(Id::unique("log of messages")).frame(dialog_frame(ctx)).show(ctx, |ui| {
        ui.set_width(520.0);
        ui.heading(t("Messages"));
        ui.add_space(6.0);
        let most = 0.6 * ui.ctx().content_rect().height();
        scroll(most).show(ui, |ui| lines(ui, session));
        ui.add_space(6.0);
        if ui.button(t("Close")).clicked() {
            actions.push(Action::Overlay(None));
        }
    });
    if modal.should_close() {
        actions.push(Action::Overlay(None));
    }
}

fn lines(ui: &mut Ui, session: &Session) {
    if session.messages().log().next().is_none() {
        ui.label(RichText::new(t("Nothing has been said yet")).weak());
    }
    for (said_s, message) in session.messages().log().rev() {
        ui.horizontal_top(|ui| {
            let minutes = said_s / 60.0;
            let when = format!("{:>3.0}:{:02.0}", minutes.floor(), (said_s % 60.0).floor());
            ui.label(RichText::new(when).monospace().weak()).on_hover_text(t("Minutes and seconds since the start"));
            let text = RichText::new(&message.text).color(color(ui.visuals(), message.level));
            ui.add(Label::new(text).wrap().selectable(true));
        });
    }
}
