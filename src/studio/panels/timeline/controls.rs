//! The row above the track: playing, the keyframes that are selected, and what the motors make of them.

use crate::design::{Easing, Keyframe, animation};
use crate::motion::Why;
use crate::studio::action::{Action, Actions};
use crate::studio::change::Change;
use crate::studio::commands::animation::{ADD_KEYFRAME, CANCEL_FILM, DRIVES, FILM, FIT, LOOP, PLAY};
use crate::studio::commands::document::DELETE;
use crate::studio::icons::{self, Icon};
use crate::studio::language::{t, tf};
use crate::studio::panels::buttons;
use crate::studio::panels::widgets::passing;
use crate::studio::session::Session;
use eframe::egui::{Align, ComboBox, DragValue, Layout, ProgressBar, RichText, Ui};

/// Handles of the easing that is chosen first: slower than smooth.
const HANDLES: Easing = Easing::Slow { out: 0.6, into: 0.6 };

pub fn show(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        buttons::icon(ui, session, &PLAY, actions);
        buttons::icon(ui, session, &LOOP, actions);
        let time = format!("{:.2} s / {:.2} s", session.playback().time_s, animation::duration_s(session.design()));
        ui.add_space(4.0);
        ui.label(RichText::new(time).monospace());
        ui.add_space(8.0);
        buttons::text(ui, session, &ADD_KEYFRAME, actions);
        if session.design().keyframes.len() > 1 {
            buttons::choice(ui, session, &DRIVES, actions);
            passing(ui, true, |ui| film(ui, session, actions));
        }
        passing(ui, !session.timing().doubts().is_empty(), |ui| doubts(ui, session, actions));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| selected(ui, session, actions));
    });
}

/// Starts a film, or shows how far it is.
fn film(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    if session.filming().running.is_none() {
        return buttons::text(ui, session, &FILM, actions);
    }
    let [done, of] = session.filming().done();
    let part = done as f32 / of.max(1) as f32;
    ui.add(ProgressBar::new(part).desired_width(110.0).text(tf!("{done} of {of}", done, of)));
    buttons::text(ui, session, &CANCEL_FILM, actions);
}

/// What the motors do not play as it is, and the way out.
fn doubts(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let doubts = session.timing().doubts();
    let is = |of: fn(&Why) -> bool| doubts.iter().filter(|doubt| of(&doubt.why)).count();
    let (fast, far) = (is(|why| matches!(why, Why::TooFast { .. })), is(|why| matches!(why, Why::TooFar { .. })));
    if fast + far == 0 {
        return;
    }
    let text = if fast > 0 { t("Too fast for the motors") } else { t("A winch comes to its end") };
    ui.label(RichText::new(text).color(ui.visuals().error_fg_color));
    if fast > 0 {
        buttons::text(ui, session, &FIT, actions);
    }
}

fn selected(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let keys = session.keys();
    let frames = &session.design().keyframes;
    let Some(first) = keys.first().and_then(|&key| frames.get(key)) else { return };
    let tip = DELETE.hint(t("Delete what is selected"));
    let name = if keys.len() == 1 { t("Delete keyframe") } else { t("Delete selected keyframes") };
    if icons::button(ui, Icon::Trash, name, &tip).clicked() {
        actions.push(Action::Run(&DELETE, session.selected()));
    }
    easing(ui, &keys, first, actions);
    if keys.len() > 1 {
        return together(ui, &keys, frames, actions);
    }
    if first.pose.is_some() {
        let tip =
            t("What this keyframe winds stays; otherwise it is worked out again where winches or its pose change");
        if ui.button(t("Detach")).on_hover_text(tip).clicked() {
            actions.push(Action::Change(Change::DetachKeyframe(keys[0])));
        }
    }
    let pose = follows(first);
    ui.label(
        RichText::new(tf!(
            "Keyframe {number} at {time_s:.2} s, {pose}",
            number = keys[0] + 1,
            time_s = first.time_s,
            pose
        ))
        .weak(),
    );
}

/// The pace from keyframes to the next ones.
fn easing(ui: &mut Ui, keys: &[usize], first: &Keyframe, actions: &mut Actions) {
    let before = first.easing;
    let combo = ComboBox::from_id_salt("easing").selected_text(name(before)).width(84.0);
    let combo = combo.show_ui(ui, |ui| easings(ui, before));
    let mut easing = combo.inner.flatten().unwrap_or(before);
    combo.response.accessible_name(t("Easing")).on_hover_text(t("How the motion goes on to the next keyframe"));
    let of = |easing| Change::EaseKeyframes { keys: keys.to_vec(), easing };
    if easing != before {
        return actions.push(Action::Change(of(easing)));
    }
    if let Easing::Slow { out, into } = &mut easing {
        for (value, name) in [(into, t("Slow at the end")), (out, t("Slow at the beginning"))] {
            let mut percent = 100.0 * *value;
            let field = DragValue::new(&mut percent).range(5.0..=90.0).speed(0.5).max_decimals(0).suffix(" %");
            ui.add(field).on_hover_text(name).accessible_name(name);
            *value = percent / 100.0;
        }
        if easing != before {
            actions.push(Action::Live(of(easing)));
        }
    }
}

/// All easings; the one that is chosen instead of this.
pub fn easings(ui: &mut Ui, before: Easing) -> Option<Easing> {
    let handles = if matches!(before, Easing::Slow { .. }) { before } else { HANDLES };
    let mut easing = before;
    for choice in [Easing::Smooth, Easing::Linear, Easing::Hold, handles] {
        ui.selectable_value(&mut easing, choice, name(choice)).on_hover_text(tip(choice));
    }
    (easing != before).then_some(easing)
}

/// Several at once: how many, and how long they take together.
fn together(ui: &mut Ui, keys: &[usize], frames: &[Keyframe], actions: &mut Actions) {
    let time = |key: &usize| frames.get(*key).map_or(0.0, |frame| frame.time_s);
    let from = keys.iter().map(time).fold(f64::INFINITY, f64::min);
    let to = keys.iter().map(time).fold(0.0, f64::max);
    let before = to - from;
    let mut lasts = before;
    let field = DragValue::new(&mut lasts).range(0.01..=36_000.0).speed(0.01).max_decimals(2).suffix(" s");
    let response = ui.add(field).accessible_name(t("Length of the selected keyframes"));
    response.on_hover_text(t("Stretch or squeeze what is selected; its beginning stays"));
    if lasts != before && before > 0.0 {
        actions.push(Action::Live(Change::StretchKeyframes { keys: keys.to_vec(), factor: lasts / before }));
    }
    ui.label(RichText::new(tf!("{count} keyframes, length", count = keys.len())).weak());
}

/// The pose that a keyframe follows.
pub fn follows(keyframe: &Keyframe) -> String {
    keyframe.pose.as_ref().map_or_else(|| t("detached").into(), |pose| tf!("follows {pose}", pose))
}

fn name(easing: Easing) -> &'static str {
    match easing {
        Easing::Linear => t("Linear"),
        Easing::Smooth => t("easing|Smooth"),
        Easing::Hold => t("Hold"),
        Easing::Slow { .. } => t("Handles"),
    }
}

fn tip(easing: Easing) -> &'static str {
    match easing {
        Easing::Linear => t("At one speed to the next keyframe"),
        Easing::Smooth => t("Starts and stops gently"),
        Easing::Hold => t("Stays as it is, and jumps at the next keyframe"),
        Easing::Slow { .. } => t("Lingers at its ends, as long as you like: drag the handles on the track"),
    }
}
