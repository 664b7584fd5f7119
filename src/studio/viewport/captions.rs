//! Words and a scale over a view.

use crate::picture::Stage;
use crate::studio::canvas::{Camera, Canvas, Plushie};
use crate::studio::language::{t, tf, tn};
use crate::studio::session::{Mode, Session};
use eframe::egui::{Align2, FontId, Pos2, Rect, Stroke, Ui, Vec2};

pub fn show(ui: &Ui, canvas: &Canvas<'_>, plushie: Plushie) {
    let Canvas { session, rect, camera, .. } = *canvas;
    let painter = ui.painter_at(rect);
    let (title, detail) = match (plushie, session.displayed_proposal()) {
        (Plushie::Idealized, Some(p)) if p.paper.is_some() => {
            (t("Idealized"), stage_name(session.discovery.stage).to_owned())
        }
        (Plushie::Realizable, Some(p)) => {
            (t("Realizable"), tf!("with the proposal, error {percent:.1} %", percent = 100.0 * p.error_after()))
        }
        (Plushie::Idealized, _) => (t("Idealized"), t("muscle fibres").to_owned()),
        (Plushie::Realizable, None) => (t("Realizable"), networks_text(session)),
    };
    let beside = if session.look.rulers { super::rulers::WIDTH } else { 0.0 };
    let corner = rect.left_top() + Vec2::new(14.0 + beside, 10.0 + beside);
    let text = ui.visuals().strong_text_color();
    let weak = ui.visuals().weak_text_color();
    let title = painter.text(corner, Align2::LEFT_TOP, title, FontId::proportional(15.0), text);
    painter.text(
        title.right_bottom() + Vec2::new(8.0, -1.5),
        Align2::LEFT_BOTTOM,
        detail,
        FontId::proportional(12.0),
        weak,
    );
    scale_bar(ui, rect, camera, beside);
}

fn stage_name(stage: Stage) -> &'static str {
    match stage {
        Stage::Activation => t("activation graph"),
        Stage::Seeds => t("seeds and starting component"),
        Stage::Tree => t("winch tree with joining paths"),
        Stage::Result => t("winch and tendons"),
    }
}

fn networks_text(session: &Session) -> String {
    if let Some(name) = session.solo().name() {
        return tf!("{name} alone", name);
    }
    if session.picked.mode == Mode::Winding {
        return t("wound by hand").to_owned();
    }
    match session.design().acting_numbers().len() {
        0 if !session.design().networks.is_empty() => t("all winches switched off").to_owned(),
        0 => t("no winches yet").to_owned(),
        n => tn!(winches = n, "{winches} winch", "{winches} winches"),
    }
}

/// A length in mm, lower left.
fn scale_bar(ui: &Ui, rect: Rect, camera: Camera, beside: f32) {
    let Some(length_mm) = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 5000.0]
        .into_iter()
        .find(|mm| mm * camera.scale > 48.0)
    else {
        return;
    };
    let painter = ui.painter_at(rect);
    let weak = ui.visuals().weak_text_color();
    let stroke = Stroke::new(1.5, weak);
    let start = rect.left_bottom() + Vec2::new(14.0 + beside, -14.0);
    let end: Pos2 = start + Vec2::new(length_mm * camera.scale, 0.0);
    painter.line_segment([start, end], stroke);
    for p in [start, end] {
        painter.line_segment([p - Vec2::new(0.0, 3.0), p + Vec2::new(0.0, 3.0)], stroke);
    }
    let text = format!("{length_mm:.0} mm");
    painter.text(
        start.lerp(end, 0.5) - Vec2::new(0.0, 4.0),
        Align2::CENTER_BOTTOM,
        text,
        FontId::proportional(11.0),
        weak,
    );
}
