//! Proposing networks: parameters, progress, the proposals and their stages (fig. 6).

use super::{Actions, heading, primary};
use crate::engine::Proposal;
use crate::picture::scene::Stage;
use crate::studio::action::Action;
use crate::studio::session::Session;
use eframe::egui::{Button, CollapsingHeader, DragValue, Grid, ProgressBar, RichText, Ui, vec2};
use std::time::Duration;

pub fn show(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    heading(ui, "Network discovery");
    match &session.discovery.running {
        Some(running) => progress(ui, running.started.elapsed(), actions),
        None => propose(ui, session, actions),
    }
    parameters(ui, session, actions);
    if session.discovery.proposals.is_empty() {
        return;
    }
    ui.add_space(6.0);
    heading(ui, "Proposals");
    for (index, proposal) in session.discovery.proposals.iter().enumerate() {
        row(ui, session, index, proposal, actions);
    }
    if let Some(index) = session.discovery.shown.filter(|&i| i < session.discovery.proposals.len()) {
        ui.add_space(4.0);
        stages(ui, session, actions);
        ui.add_space(4.0);
        verdict(ui, index, actions);
    }
}

fn propose(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let why_not = session.cannot_propose();
    let width = ui.available_width();
    let response = primary(ui, why_not.is_none(), "Propose networks", width);
    let response = response
        .on_hover_text("Look for winch-tendon networks that reach this pose (G)")
        .on_disabled_hover_text(why_not.unwrap_or_default());
    if response.clicked() {
        actions.push(Action::Propose);
    }
}

fn progress(ui: &mut Ui, elapsed: Duration, actions: &mut Actions) {
    ui.horizontal(|ui| {
        let seconds = elapsed.as_secs_f32();
        // How long it takes is not known; the bar comes nearer and nearer to the end.
        let bar = ProgressBar::new(1.0 - (-seconds / 4.0).exp()).desired_width(ui.available_width() - 70.0);
        ui.add(bar.text(format!("{seconds:.0} s"))).on_hover_text("Trying candidates in simulation");
        if ui.button("Cancel").on_hover_text("Stop looking (Esc)").clicked() {
            actions.push(Action::CancelPropose);
        }
    });
    // The seconds go on counting.
    ui.ctx().request_repaint_after(Duration::from_millis(200));
}

fn parameters(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    CollapsingHeader::new("Parameters").id_salt("discovery parameters").show(ui, |ui| {
        let mut p = session.discovery.parameters.clone();
        Grid::new("discovery parameters").num_columns(2).spacing([8.0, 4.0]).show(ui, |ui| {
            let count = |ui: &mut Ui, name: &str, tip: &str, value: &mut usize, range| {
                let label = ui.label(name).on_hover_text(tip);
                ui.add(DragValue::new(value).range(range).speed(0.1)).labelled_by(label.id).on_hover_text(tip);
                ui.end_row();
            };
            count(ui, "Seeds", "How many of the most contracted fibres to start from", &mut p.seed_num, 1..=500);
            count(ui, "Tendons", "Tendons of a network", &mut p.tendon_num, 1..=12);
            count(ui, "Join rounds", "How often components are joined to the tree", &mut p.join_depth, 0..=20);
            count(ui, "Join length", "Longest joining path, in edges", &mut p.join_len, 1..=20);
            let tip = "0: equal tendons, 1: long tendons";
            let label = ui.label("Phi").on_hover_text(tip);
            ui.add(DragValue::new(&mut p.phi).range(0.0..=1.0).speed(0.005).max_decimals(2)).labelled_by(label.id);
            ui.end_row();
        });
        if p != session.discovery.parameters {
            actions.push(Action::SetParameters(p));
        }
    });
}

fn row(ui: &mut Ui, session: &Session, index: usize, proposal: &Proposal, actions: &mut Actions) {
    let tendons = proposal.network.tendons.len();
    let name = format!("{}  {tendons} tendon{}", index + 1, if tendons == 1 { "" } else { "s" });
    let error = format!("{:.1} % → {:.1} %", 100.0 * proposal.error_before, 100.0 * proposal.error_after);
    let better = proposal.error_after < proposal.error_before;
    let color = if better { ui.visuals().text_color() } else { ui.visuals().warn_fg_color };
    let button = Button::selectable(session.discovery.shown == Some(index), name)
        .right_text(RichText::new(error).small().color(color))
        .min_size(vec2(ui.available_width(), 26.0));
    let response = ui.add(button).accessible_name(format!("Proposal {}", index + 1));
    let tip = "Pose error of the realizable plushie without and with this network, in body lengths. Click to see it";
    if response.on_hover_text(tip).clicked() {
        actions.push(Action::ShowProposal(Some(index)));
    }
}

fn stages(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        let width = (ui.available_width() - 9.0) / 4.0;
        for (stage, name, tip) in [
            (Stage::Activation, "Activity", "Activation graph: every fibre by its contraction"),
            (Stage::Seeds, "Seeds", "The most contracted fibres; the starting component stands out"),
            (Stage::Tree, "Tree", "Winch tree: components, and joining paths in blue"),
            (Stage::Result, "Result", "The winch and its tendons"),
        ] {
            let button = Button::selectable(session.discovery.stage == stage, name)
                .frame_when_inactive(true)
                .min_size(vec2(width, 24.0));
            if ui.add(button).on_hover_text(tip).clicked() {
                actions.push(Action::ShowStage(stage));
            }
        }
    });
}

fn verdict(ui: &mut Ui, index: usize, actions: &mut Actions) {
    ui.horizontal(|ui| {
        let width = (ui.available_width() - 6.0) / 2.0;
        if primary(ui, true, "Accept", width).on_hover_text("Build this network in (Enter)").clicked() {
            actions.push(Action::Accept(index));
        }
        let reject = ui.add(Button::new("Reject").min_size(vec2(width, 30.0)));
        if reject.on_hover_text("Drop this proposal (Backspace)").clicked() {
            actions.push(Action::Reject(index));
        }
    });
}
