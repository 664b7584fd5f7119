//! Messages in a corner, over the views; nothing waits for them.

use crate::studio::action::{Action, Actions};
use crate::studio::icons::{self, Icon};
use crate::studio::messages::Level;
use crate::studio::session::Session;
use eframe::egui::{Align2, Area, Context, Frame, Id, Label, Order, Sense, vec2};

/// Width of a message's text, logical pixels.
const TEXT_WIDTH: f32 = 400.0;

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
                // A row as high as its text: centred layouts would take all the height there is.
                ui.horizontal_top(|ui| {
                    let (bar, _) = ui.allocate_exact_size(vec2(4.0, 18.0), Sense::hover());
                    ui.painter().rect_filled(bar, 2.0, color);
                    ui.vertical(|ui| {
                        ui.set_width(TEXT_WIDTH);
                        ui.add(Label::new(eframe::egui::RichText::new(&message.text).color(color)).wrap());
                    });
                    if icons::small_button(ui, Icon::Close, "Dismiss message", "Dismiss").clicked() {
                        actions.push(Action::DismissMessage(message.id));
                    }
                });
            });
        }
    });
}
