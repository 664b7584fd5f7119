//! Proposing networks: parameters, progress, the proposals and their stages (fig. 6).

use super::buttons;
use super::widgets::heading;
use crate::picture::Stage;
use crate::rigging::Proposal;
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::Hit;
use crate::studio::commands::discovery::{ACCEPT, CANCEL, CANCEL_RIG, PROPOSE, REJECT, RIG};
use crate::studio::commands::document::ESCAPE;
use crate::studio::session::Session;
use crate::studio::style;
use crate::studio::viewport::thumbnail::Thumbnails;
use eframe::egui::{
    Align2, Button, CollapsingHeader, DragValue, FontId, Grid, ProgressBar, Rect, Response, RichText, Role, ScrollArea,
    Sense, Spinner, Stroke, StrokeKind, TextEdit, Ui, WidgetInfo, vec2,
};
use std::time::Duration;

pub fn show(ui: &mut Ui, session: &Session, thumbnails: &mut Thumbnails, actions: &mut Actions) {
    heading(ui, "Network discovery");
    match &session.discovery.running {
        Some(running) => progress(ui, running.started.elapsed(), actions),
        None => {
            let width = ui.available_width();
            buttons::primary(ui, session, &PROPOSE, true, width, actions);
        }
    }
    parameters(ui, session, actions);
    rig(ui, session, actions);
    if session.discovery.proposals.is_empty() {
        return;
    }
    ui.add_space(6.0);
    heading(ui, "Proposals");
    // Short, so that the buttons below stay in sight.
    let rows = ScrollArea::vertical().id_salt("proposals").max_height(132.0).auto_shrink([false, true]);
    rows.show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 2.0;
        for (index, proposal) in session.discovery.proposals.iter().enumerate() {
            row(ui, session, index, proposal, actions);
        }
    });
    if session.shown_proposal().is_some() {
        verdict(ui, session, actions);
        ui.add_space(2.0);
        stages(ui, session, thumbnails, actions);
    }
}

fn progress(ui: &mut Ui, elapsed: Duration, actions: &mut Actions) {
    ui.horizontal(|ui| {
        let seconds = elapsed.as_secs_f32();
        // How long it takes is not known; the bar comes nearer and nearer to the end.
        let bar = ProgressBar::new(1.0 - (-seconds / 4.0).exp()).desired_width(ui.available_width() - 70.0);
        ui.add(bar.text(format!("{seconds:.0} s"))).on_hover_text("Trying candidates in simulation");
        if ui.button("Cancel").on_hover_text(ESCAPE.hint(CANCEL.tip)).clicked() {
            actions.push(Action::Run(&CANCEL, Hit::Nothing));
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

/// Networks for all poses at once.
fn rig(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    CollapsingHeader::new("All poses").id_salt("rig").show(ui, |ui| {
        let mut choice = session.rigging().choice.clone();
        Grid::new("rig").num_columns(2).spacing([8.0, 4.0]).show(ui, |ui| {
            let tip = "Winches that the plushie may have in the end";
            let label = ui.label("Most winches").on_hover_text(tip);
            ui.add(DragValue::new(&mut choice.max_winches).range(1..=64).speed(0.1)).labelled_by(label.id);
            ui.end_row();
            let tip = "One number for all (2), winch by winch (3,2), or what to choose from (1..4)";
            let label = ui.label("Tendons of each winch").on_hover_text(tip);
            let field = TextEdit::singleline(&mut choice.tendons).desired_width(70.0);
            ui.add(field).labelled_by(label.id).on_hover_text(tip);
            ui.end_row();
        });
        ui.checkbox(&mut choice.rules, "Keep the rules of sewing")
            .on_hover_text("Otherwise a hand may not be able to sew it");
        let held =
            "Winch by winch, the networks of Algorithm 2 with the parameters above; otherwise all winches together";
        ui.checkbox(&mut choice.hold, "Hold the parameters").on_hover_text(held);
        if choice != session.rigging().choice {
            actions.push(Action::SetRig(choice));
        }
        match &session.rigging().running {
            Some(running) => rigging(ui, session, running.started.elapsed(), actions),
            None => {
                let width = ui.available_width();
                buttons::primary(ui, session, &RIG, true, width, actions);
            }
        }
    });
}

fn rigging(ui: &mut Ui, session: &Session, elapsed: Duration, actions: &mut Actions) {
    ui.horizontal(|ui| {
        ui.add(Spinner::new());
        ui.label(format!("{} s", elapsed.as_secs()));
        if ui.button(CANCEL_RIG.label).on_hover_text(CANCEL_RIG.tip(session)).clicked() {
            actions.push(Action::Run(&CANCEL_RIG, Hit::Nothing));
        }
    });
    ui.label(RichText::new(session.rigging().step()).small().weak());
    // The seconds go on counting.
    ui.ctx().request_repaint_after(Duration::from_millis(200));
}

fn row(ui: &mut Ui, session: &Session, index: usize, proposal: &Proposal, actions: &mut Actions) {
    let tendons = proposal.network.tendons.len();
    let name = format!("{}  {tendons} tendon{}", index + 1, if tendons == 1 { "" } else { "s" });
    let error = format!("{:.1} % to {:.1} %", 100.0 * proposal.error_before, 100.0 * proposal.error_after);
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

/// Four pictures, like the paper's fig. 6; the one chosen is shown large in the left view.
fn stages(ui: &mut Ui, session: &Session, thumbnails: &mut Thumbnails, actions: &mut Actions) {
    const GAP: f32 = 6.0;
    let stages = [
        (Stage::Activation, "Activity", "Activation graph: every fibre by its contraction"),
        (Stage::Seeds, "Seeds", "The most contracted fibres; the starting component stands out"),
        (Stage::Tree, "Tree", "Winch tree: components, and joining paths in blue"),
        (Stage::Result, "Result", "The winch and its tendons"),
    ];
    let width = ((ui.available_width() - GAP) / 2.0).floor();
    for row in stages.chunks(2) {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = GAP;
            for &(stage, name, tip) in row {
                if thumbnail(ui, session, thumbnails, stage, name, width).on_hover_text(tip).clicked() {
                    actions.push(Action::ShowStage(stage));
                }
            }
        });
    }
}

fn thumbnail(
    ui: &mut Ui,
    session: &Session,
    thumbnails: &mut Thumbnails,
    stage: Stage,
    name: &str,
    width: f32,
) -> Response {
    let (rect, response) = ui.allocate_exact_size(vec2(width, 0.72 * width), Sense::click());
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

fn verdict(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ui.horizontal(|ui| {
        let width = (ui.available_width() - 6.0) / 2.0;
        buttons::primary(ui, session, &ACCEPT, true, width, actions);
        buttons::wide(ui, session, &REJECT, width, actions);
    });
}
