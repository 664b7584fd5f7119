//! What stands over the views: how the body is shown, and how one looks at it.

use super::rulers::WIDTH as WIDTH_OF_RULER;
use crate::picture::layers::look;
use crate::studio::action::Actions;
use crate::studio::canvas::Hit;
use crate::studio::commands::{self, Place};
use crate::studio::language::t;
use crate::studio::panels::buttons;
use crate::studio::session::Session;
use eframe::egui::{Align, Layout, Rect, Response, Ui, UiBuilder, menu, vec2};

/// Height of the strip, and its distance from the corner, logical pixels.
const HEIGHT: f32 = 26.0;
const INSET: f32 = 8.0;
/// Room that it takes at most.
const WIDTH: f32 = 260.0;

/// Two menus in the upper right corner of an area.
pub fn show(ui: &mut Ui, session: &Session, area: Rect, actions: &mut Actions) {
    let size = vec2(WIDTH.min(area.width() - 2.0 * INSET), HEIGHT);
    if size.x < 60.0 || area.height() < 3.0 * HEIGHT {
        return;
    }
    let below = if session.look().rulers { WIDTH_OF_RULER } else { 0.0 };
    let corner = area.right_top() + vec2(-INSET - size.x, INSET + below);
    let place = UiBuilder::new()
        .id_salt("how the views are shown")
        .max_rect(Rect::from_min_size(corner, size))
        .layout(Layout::right_to_left(Align::Center));
    ui.scope_builder(place, |ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let view = menu::MenuButton::new(t("View")).ui(ui, |ui| entries(ui, session, Place::ViewMenu, actions)).0;
        named(view, t("View"), t("Cameras, rulers, onion skins"));
        let label = look(session.look().body).map_or(t("Look"), |look| t(look.label));
        let button = menu::MenuButton::new(label).ui(ui, |ui| entries(ui, session, Place::LookMenu, actions)).0;
        named(button, t("Look"), t("How the body is shown, and figures on it"));
    });
}

fn named(button: Response, name: &str, tip: &str) {
    use eframe::egui::{Role, WidgetInfo};
    button.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
    button.on_hover_text(tip);
}

fn entries(ui: &mut Ui, session: &Session, place: Place, actions: &mut Actions) {
    ui.set_min_width(190.0);
    for command in commands::at(place) {
        buttons::ticked(ui, session, command, Hit::Nothing, actions);
    }
}
