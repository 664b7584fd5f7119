//! Networks for all poses at once: what may be built, and how far the search is.

use super::widgets::passing;
use super::{buttons, curve};
use crate::studio::action::{Action, Actions};
use crate::studio::commands::discovery::{CANCEL_RIG, KEEP_RIG, RIG};
use crate::studio::language::t;
use crate::studio::session::Session;
use eframe::egui::{CollapsingHeader, DragValue, Grid, RichText, Spinner, TextEdit, Ui};
use std::time::Duration;

/// Networks for all poses at once.
pub fn show(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    CollapsingHeader::new(t("All poses")).id_salt("rig").show(ui, |ui| {
        let mut choice = session.rigging().choice.clone();
        Grid::new("rig").num_columns(2).spacing([8.0, 4.0]).show(ui, |ui| {
            let tip = t("Winches that the plushie may have in the end");
            let label = ui.label(t("Most winches")).on_hover_text(tip);
            ui.add(DragValue::new(&mut choice.max_winches).range(1..=64).speed(0.1)).labelled_by(label.id);
            ui.end_row();
            let tip = t("One number for all (2), winch by winch (3,2), or what to choose from (1..4)");
            let label = ui.label(t("Tendons of each winch")).on_hover_text(tip);
            let field = TextEdit::singleline(&mut choice.tendons).desired_width(70.0);
            ui.add(field).labelled_by(label.id).on_hover_text(tip);
            ui.end_row();
        });
        ui.checkbox(&mut choice.rules, t("Keep the rules of sewing"))
            .on_hover_text(t("Otherwise a hand may not be able to sew it"));
        ui.checkbox(&mut choice.trims.ratios, t("Spool radii of their own"))
            .on_hover_text(t("Each cable of a winch may run in a groove of another radius"));
        ui.checkbox(&mut choice.trims.slack, t("Cables with slack"))
            .on_hover_text(t("A cable may be slack at assembly, and pull later than others of its winch"));
        let held =
            t("Winch by winch, the networks of Algorithm 2 with the parameters above; otherwise all winches together");
        ui.checkbox(&mut choice.hold, t("Hold the parameters")).on_hover_text(held);
        if choice != session.rigging().choice {
            actions.push(Action::SetRig(choice));
        }
        passing(ui, true, |ui| match &session.rigging().running {
            Some(running) => rigging(ui, session, running.started.elapsed(), actions),
            None => {
                let width = ui.available_width();
                buttons::primary(ui, session, &RIG, true, width, actions);
            }
        });
        curve::show(ui, session, actions);
    });
}

fn rigging(ui: &mut Ui, session: &Session, elapsed: Duration, actions: &mut Actions) {
    ui.horizontal(|ui| {
        ui.add(Spinner::new());
        ui.label(format!("{} s", elapsed.as_secs()));
        buttons::text(ui, session, &CANCEL_RIG, actions);
    });
    buttons::text(ui, session, &KEEP_RIG, actions);
    ui.label(RichText::new(session.rigging().step()).small().weak());
    // The seconds go on counting.
    ui.ctx().request_repaint_after(Duration::from_millis(200));
}
