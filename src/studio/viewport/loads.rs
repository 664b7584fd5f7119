//! What the cables of the realizable plushie pull with, beside their winches.

use crate::motion::{Load, winch_loads};
use crate::operations::network::Part;
use crate::studio::canvas::{Canvas, Ground, Plushie};
use crate::studio::language::{t, tf};
use crate::studio::session::{Mode, Session};
use crate::studio::tools::PULL;
use eframe::egui::{Align2, FontId, Rect, Role, Sense, Ui, WidgetInfo, vec2};

/// From the middle of a winch to its load, logical pixels.
const ASIDE: f32 = 15.0;

pub fn show(ui: &mut Ui, canvas: &Canvas<'_>) {
    let session = canvas.session;
    let Ground::Plushie(Plushie::Realizable, Some(shape)) = canvas.ground else { return };
    let feeling = session.mode() == Mode::Winding || session.has_taken(PULL);
    if !feeling || session.displayed_proposal().is_some() {
        return;
    }
    let design = session.acting();
    for (winch, load) in winch_loads(design, &shape.tendon_tensions).into_iter().enumerate() {
        let Some(place) = canvas.shown_part(Part::Winch(winch)) else { continue };
        let at = canvas.to_screen(place) + vec2(ASIDE, -ASIDE);
        if design.networks[winch].muted || !canvas.rect.contains(at) {
            continue;
        }
        let beyond = is_beyond(session, load);
        let color = if beyond { ui.visuals().error_fg_color } else { ui.visuals().strong_text_color() };
        let text = words(load);
        let painter = ui.painter_at(canvas.rect);
        let galley = painter.layout_no_wrap(text.clone(), FontId::proportional(12.0), color);
        let place = Align2::LEFT_BOTTOM.anchor_size(at, galley.size());
        painter.rect_filled(place.expand2(vec2(5.0, 2.0)), 5.0, ui.visuals().window_fill.gamma_multiply(0.88));
        painter.galley(place.min, galley, color);
        told(ui, session, place, winch, (&text, beyond));
    }
}

/// The load for screen readers and tests, and what its limit is for the pointer.
fn told(ui: &mut Ui, session: &Session, place: Rect, winch: usize, (text, beyond): (&str, bool)) {
    let response = ui.interact(place, ui.scope_id().with(("load", winch)), Sense::hover());
    let name = &session.design().networks[winch].name;
    let over = if beyond { t(", beyond the motor's limit") } else { "" };
    response
        .widget_info(|| WidgetInfo::labeled(Role::Label, true, tf!("Load of {name}: {text}{over}", name, text, over)));
    if !session.is_dragging() {
        response.on_hover_text_at_pointer(limit(session));
    }
}

pub fn words(load: Load) -> String {
    format!("{:.1} N, {:.0} N mm", load.force_n, load.torque_nmm)
}

/// Whether the motor cannot keep a load up.
pub fn is_beyond(session: &Session, load: Load) -> bool {
    load.torque_nmm > session.design().controller.torque_nmm
}

/// The limit in words.
pub fn limit(session: &Session) -> String {
    let torque = session.design().controller.torque_nmm;
    let assumed = torque == crate::defaults::MOTOR_TORQUE_NMM;
    let whose = if assumed { t("Assumed of the motor") } else { t("The motor") };
    tf!(
        "Pull of all its cables, and torque at the spool. {whose}: {torque:.0} N mm; the settings of the motor have it",
        whose,
        torque
    )
}
