//! Messages in a corner, over the views; nothing waits for them.

use super::Actions;
use crate::studio::action::Action;
use crate::studio::icons::{self, Icon};
use crate::studio::messages::Level;
use crate::studio::session::Session;
use eframe::egui::{Align, Align2, Area, Context, Frame, Id, Label, Layout, Order, Sense, vec2};

/// `above` is how much the panels at the bottom take, logical pixels.
pub fn show(ctx: &Context, session: &Session, above: f32, actions: &mut Actions) {
    if session.messages.list().is_empty() {
        return;
    }
    let area =
        Area::new(Id::unique("messages")).order(Order::Foreground).anchor(Align2::CENTER_BOTTOM, [0.0, -above - 12.0]);
    area.show(ctx, |ui| {
        ui.set_max_width(460.0);
        for message in session.messages.list() {
            let visuals = ui.visuals();
            let color = match message.level {
                Level::Info => visuals.text_color(),
                Level::Warning => visuals.warn_fg_color,
                Level::Error => visuals.error_fg_color,
            };
            Frame::popup(ui.style()).inner_margin(8).show(ui, |ui| {
                ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                    if icons::small_button(ui, Icon::Close, "Dismiss message", "Dismiss").clicked() {
                        actions.push(Action::DismissMessage(message.id));
                    }
                    ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                        let (bar, _) = ui.allocate_exact_size(vec2(4.0, 18.0), Sense::hover());
                        ui.painter().rect_filled(bar, 2.0, color);
                        ui.add(Label::new(eframe::egui::RichText::new(&message.text).color(color)).wrap());
                    });
                });
            });
        }
    });
}
