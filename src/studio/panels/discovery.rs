//! Proposing networks: options, progress, and the list as it grows.

use super::gallery::{self, Gallery};
use super::widgets::{heading, passing};
use super::{buttons, rig, stages};
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::Hit;
use crate::studio::commands::discovery::{ACCEPT, CANCEL, PROPOSE, PROPOSE_AGAIN, REJECT};
use crate::studio::commands::document::ESCAPE;
use crate::studio::language::{t, tf};
use crate::studio::session::Session;
use crate::studio::viewport::thumbnail::Thumbnails;
use eframe::egui::{CollapsingHeader, DragValue, Grid, ProgressBar, RichText, Ui};
use std::time::Duration;

/// Time after which the bar of a search is two thirds full, s: about half of what a body of 430 fibres takes.
const HALFWAY_S: f32 = 3.0;

pub fn show(ui: &mut Ui, session: &Session, thumbnails: &mut Thumbnails, gallery: &mut Gallery, actions: &mut Actions) {
    heading(ui, t("Network discovery"));
    let width = ui.available_width();
    let running = session.discovery.running.as_ref();
    passing(ui, running.is_some() || !session.discovery.is_stale(), |ui| match running {
        Some(running) => progress(ui, session, running.started.elapsed(), actions),
        None => buttons::primary(ui, session, &PROPOSE, true, width, actions),
    });
    options(ui, session, actions);
    rig::show(ui, session, actions);
    let discovery = &session.discovery;
    if discovery.proposals.is_empty() && (running.is_some() || !discovery.is_stale()) {
        return;
    }
    ui.add_space(6.0);
    heading(ui, t("Proposals"));
    passing(ui, discovery.is_stale(), |ui| {
        ui.label(
            RichText::new(t("Found for another body or pose: these figures do not hold."))
                .color(ui.visuals().warn_fg_color),
        );
        buttons::primary(ui, session, &PROPOSE_AGAIN, true, width, actions);
    });
    gallery::show(ui, session, gallery, actions);
    if let Some(shown) = session.shown_proposal() {
        verdict(ui, session, actions);
        if shown.paper.is_some() {
            ui.add_space(2.0);
            stages::show(ui, session, thumbnails, actions);
        }
    }
}

fn progress(ui: &mut Ui, session: &Session, elapsed: Duration, actions: &mut Actions) {
    ui.horizontal(|ui| {
        let seconds = elapsed.as_secs_f32();
        let found = session.discovery.proposals.len();
        // How long it takes is not known; the bar comes nearer and nearer to the end.
        let bar = ProgressBar::new(1.0 - (-seconds / HALFWAY_S).exp()).desired_width(ui.available_width() - 70.0);
        let text =
            if found == 0 { format!("{seconds:.0} s") } else { tf!("{seconds:.0} s, {found} so far", seconds, found) };
        ui.add(bar.text(text))
            .on_hover_text(t("Trying networks in simulation. Better ones take the place of those that are there"));
        if ui.button(t("Cancel")).on_hover_text(ESCAPE.hint(t(CANCEL.tip))).clicked() {
            actions.push(Action::Run(&CANCEL, Hit::Nothing));
        }
    });
    // The seconds go on counting.
    ui.ctx().request_repaint_after(Duration::from_millis(200));
}

fn options(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    CollapsingHeader::new(t("Advanced")).id_salt("discovery parameters").show(ui, |ui| {
        let mut options = session.discovery.options.clone();
        let p = &mut options.parameters;
        Grid::new("discovery parameters").num_columns(2).spacing([8.0, 4.0]).show(ui, |ui| {
            let count = |ui: &mut Ui, name: &str, tip: &str, value: &mut usize, range| {
                let label = ui.label(name).on_hover_text(tip);
                ui.add(DragValue::new(value).range(range).speed(0.1)).labelled_by(label.id).on_hover_text(tip);
                ui.end_row();
            };
            count(ui, t("Tendons"), t("Tendons of a network"), &mut p.tendon_num, 1..=12);
            let of = t("Of Algorithm 2, which finds some of the networks: ");
            let tip = tf!("{of}how many of the most contracted fibres to start from", of);
            count(ui, t("Seeds"), &tip, &mut p.seed_num, 1..=500);
            let tip = tf!("{of}how often components are joined to the tree", of);
            count(ui, t("Join rounds"), &tip, &mut p.join_depth, 0..=20);
            count(ui, t("Join length"), &tf!("{of}longest joining path, in edges", of), &mut p.join_len, 1..=20);
            let tip = tf!("{of}0: equal tendons, 1: long tendons", of);
            let label = ui.label(t("Phi")).on_hover_text(&tip);
            ui.add(DragValue::new(&mut p.phi).range(0.0..=1.0).speed(0.005).max_decimals(2))
                .labelled_by(label.id)
                .on_hover_text(tip);
            ui.end_row();
        });
        ui.checkbox(&mut options.fewer, t("Fewer tendons too"))
            .on_hover_text(t("Networks of fewer tendons are proposed beside those of the number above"));
        ui.checkbox(&mut options.rules, t("Only what can be sewn")).on_hover_text(t(
            "Networks that keep the rules of sewing (Settings); otherwise a hand may not be able to sew them",
        ));
        if options != session.discovery.options {
            actions.push(Action::SetProposeOptions(options));
        }
    });
}

fn verdict(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ui.horizontal(|ui| {
        let width = (ui.available_width() - 6.0) / 2.0;
        buttons::primary(ui, session, &ACCEPT, true, width, actions);
        buttons::wide(ui, session, &REJECT, width, actions);
    });
}
