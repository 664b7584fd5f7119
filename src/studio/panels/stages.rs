//! The stages by which Algorithm 2 has found a proposal (fig. 6).

use crate::picture::Stage;
use crate::studio::action::{Action, Actions};
use crate::studio::language::t;
use crate::studio::session::Session;
use crate::studio::style;
use crate::studio::viewport::thumbnail::Thumbnails;
use eframe::egui::{Align2, FontId, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, vec2};

/// Height of a picture, logical pixels: that of the panel must not depend on its width, which scroll bars take from.
const HEIGHT: f32 = 78.0;

/// Four pictures, like the paper's fig. 6; the one chosen is shown large in the left view.
pub fn show(ui: &mut Ui, session: &Session, thumbnails: &mut Thumbnails, actions: &mut Actions) {
    const GAP: f32 = 4.0;
    let stages = [
        (Stage::Activation, t("Activity"), t("Activation graph: every fibre by its contraction")),
        (Stage::Seeds, t("Seeds"), t("The most contracted fibres; the starting component stands out")),
        (Stage::Tree, t("Tree"), t("Winch tree: components, and joining paths in blue")),
        (Stage::Result, t("Result"), t("The winch and its tendons")),
    ];
    let width = ((ui.available_width() - 3.0 * GAP) / 4.0).floor();
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = GAP;
        for (stage, name, tip) in stages {
            if thumbnail(ui, session, thumbnails, stage, name, width).on_hover_text(tip).clicked() {
                actions.push(Action::ShowStage(stage));
            }
        }
    });
}

fn thumbnail(
    ui: &mut Ui,
    session: &Session,
    thumbnails: &mut Thumbnails,
    stage: Stage,
    name: &str,
    width: f32,
) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(width, HEIGHT), Sense::click());
    let chosen = session.discovery.stage == stage;
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, chosen, name));
    if !ui.is_rect_visible(rect) {
        return response;
    }
    let visuals = ui.visuals();
    let stroke = if chosen {
        Stroke::new(2.0, style::accent(session.look.theme))
    } else if response.hovered() || response.has_focus() {
        visuals.widgets.hovered.bg_stroke
    } else {
        visuals.widgets.noninteractive.bg_stroke
    };
    ui.painter().rect_stroke(rect, 6.0, stroke, StrokeKind::Inside);
    let color = if chosen { visuals.strong_text_color() } else { visuals.weak_text_color() };
    let below = rect.center_bottom() - vec2(0.0, 5.0);
    ui.painter().text(below, Align2::CENTER_BOTTOM, name, FontId::proportional(11.0), color);
    if session.gpu {
        let picture = Rect::from_min_max(rect.min + vec2(3.0, 3.0), rect.max - vec2(3.0, 19.0));
        thumbnails.paint(ui, session, stage, picture);
    }
    response
}
