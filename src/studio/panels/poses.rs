//! Poses of the plushie, and the targets of the current one.

use super::widgets::{heading, name_field};
use super::{buttons, targets};
use crate::studio::action::{Action, Actions};
use crate::studio::change::Change;
use crate::studio::commands::animation::ADD_KEYFRAME;
use crate::studio::commands::document::{ADD_POSE, CLEAR_TARGETS, DELETE_POSE, DUPLICATE_POSE, RENAME_POSE};
use crate::studio::commands::posing::MIRROR_POSE;
use crate::studio::language::{t, tf, tn};
use crate::studio::session::{Mode, PoseError, Renamed, Session};
use eframe::egui::{Align, Button, Color32, Layout, RichText, ScrollArea, Ui, vec2};

/// How much of its strength a figure keeps that is not of the design as it is now.
const STALE: f32 = 0.55;

pub fn show(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    title(ui, session, actions);
    ui.add_space(8.0);
    pose_buttons(ui, session, actions);
    ScrollArea::vertical().auto_shrink([false, true]).max_height(ui.available_height() * 0.42).show(ui, |ui| {
        list(ui, session, actions);
    });
    ui.add_space(10.0);
    targets::show(ui, session, actions);
}

/// The plushie's name, which a double click edits.
fn title(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    if matches!(session.renaming(), Some((Renamed::Plushie, _))) {
        if let Some(name) = name_field(ui, session, t("Plushie name"), actions) {
            actions.push(Action::Change(Change::Rename(name)));
        }
        return;
    }
    let name = &session.design().name;
    let label = RichText::new(name).size(19.0).strong();
    let response = ui.add(Button::new(label).frame(false).truncate());
    let response = response.on_hover_text(t("Double-click to rename the plushie"));
    if response.double_clicked() {
        actions.push(Action::Typed(Some((Renamed::Plushie, name.clone()))));
    }
    let figures = &session.document.figures;
    let body = tf!("{fibers} fibres, {length_mm:.0} mm", fibers = figures.fibers, length_mm = figures.body_length_mm);
    ui.label(RichText::new(body).small().weak());
}

fn pose_buttons(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ui.horizontal(|ui| {
        heading(ui, t("Poses"));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.spacing_mut().item_spacing.x = 2.0;
            buttons::small_icon(ui, session, &ADD_POSE, actions);
            if session.picked.pose.is_some() {
                for command in [&DELETE_POSE, &DUPLICATE_POSE, &RENAME_POSE] {
                    buttons::small_icon(ui, session, command, actions);
                }
            }
        });
    });
}

fn list(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ui.spacing_mut().item_spacing.y = 2.0;
    let in_pose = session.picked.mode == Mode::Pose;
    let row = |ui: &mut Ui, name: &str, (detail, color): (&str, Color32), selected: bool| {
        let button = Button::selectable(selected, name)
            .right_text(RichText::new(detail).small().color(color))
            .truncate()
            .min_size(vec2(ui.available_width(), 26.0));
        // Without the detail, which is for the eye.
        ui.add(button).accessible_name(name)
    };
    let rest = row(ui, t("Rest"), ("", Color32::TRANSPARENT), in_pose && session.picked.pose.is_none());
    if rest.on_hover_text(t("The body as it was cut")).clicked() {
        actions.push(Action::SelectPose(None));
    }
    for (index, pose) in session.design().poses.iter().enumerate() {
        if matches!(session.renaming(), Some((Renamed::Pose(i), _)) if *i == index) {
            if let Some(name) = name_field(ui, session, t("Pose name"), actions) {
                actions.push(Action::Change(Change::RenamePose(index, name)));
            }
            continue;
        }
        let targets = match pose.targets.len() {
            0 => t("no targets").to_owned(),
            count => tn!(count, "{count} target", "{count} targets"),
        };
        let error = session.judging().error(index);
        let (color, detail) = match error {
            Some(error) => (
                error_color(ui, error),
                format!("{targets}  {}{:.2} %", if error.thorough { "" } else { "~" }, 100.0 * error.error),
            ),
            None => (ui.visuals().weak_text_color(), targets),
        };
        let response = row(ui, &pose.name, (&detail, color), in_pose && session.picked.pose == Some(index));
        let response = match error {
            Some(error) => response.on_hover_text(error_text(session, error)),
            None => response,
        };
        if response.secondary_clicked() {
            actions.push(Action::SelectPose(Some(index)));
        }
        response.context_menu(|ui| {
            ui.set_min_width(160.0);
            for command in [&RENAME_POSE, &DUPLICATE_POSE, &MIRROR_POSE, &ADD_KEYFRAME, &CLEAR_TARGETS, &DELETE_POSE] {
                buttons::entry(ui, session, command, session.selected(), actions);
            }
        });
        if response.double_clicked() {
            actions.push(Action::Typed(Some((Renamed::Pose(index), pose.name.clone()))));
        } else if response.clicked() {
            actions.push(Action::SelectPose(Some(index)));
        }
    }
}

/// Of the error of a pose: paler than other words while a new one is worked out.
fn error_color(ui: &Ui, error: PoseError) -> Color32 {
    let weak = ui.visuals().weak_text_color();
    if error.fresh { weak } else { weak.gamma_multiply(STALE) }
}

fn error_text(session: &Session, error: PoseError) -> String {
    let mm = error.error * session.design().body_length_mm();
    let percent = 100.0 * error.error;
    let how = match error {
        PoseError { fresh: false, .. } => t("of the design before; the new one is worked out"),
        PoseError { thorough: false, .. } => t("at a first look; the best pose is looked for"),
        _ => t("the best pose that winding from rest reaches"),
    };
    tf!(
        "The realizable plushie misses its targets by {mm:.2} mm, {percent:.2} % of the body length: {how}",
        mm,
        percent,
        how
    )
}
