//! Keyframes on the track: selected, moved and stretched, alone or together, and the handles of their easings.

use super::axis::Axis;
use super::controls::{easings, follows};
use crate::design::{Easing, Keyframe};
use crate::studio::action::{Action, Actions};
use crate::studio::change::Change;
use crate::studio::commands::animation::{ALL_KEYFRAMES, COPY, CUT, EARLIER, LATER, PASTE, REMOVE};
use crate::studio::icons;
use crate::studio::language::{t, tf};
use crate::studio::panels::buttons;
use crate::studio::session::{Selection, Session};
use crate::studio::style;
use eframe::egui::{CursorIcon, Pos2, Rect, Role, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};

/// Dragged keyframes fall on multiples of this, s; with Shift they are free.
const SNAP_S: f64 = 0.05;
/// Handles of the easing, as parts of the time, from where to where they can be dragged.
const HANDLE: [f64; 2] = [0.05, 0.9];
/// How far above the keyframes their handles stand, logical pixels.
const ABOVE: f32 = 13.0;
/// Those of `Easing::Smooth`.
const THIRD: f64 = 1.0 / 3.0;

/// The thing of the timeline that is in hand.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Held {
    #[default]
    Nothing,
    /// Keyframes by their numbers when the hand took hold, at this time of the pointer, and the one under it.
    Keys { keys: Vec<usize>, from_s: f64, own_s: f64 },
    /// The end of what is selected: its beginning and its end then.
    End { keys: Vec<usize>, first_s: f64, last_s: f64 },
    /// Keyframes are gathered from here on.
    Sweep { from_s: f64 },
}

/// Draws and drags the keyframes; true if the pointer is busy with one.
pub fn show(ui: &mut Ui, session: &Session, axis: &Axis, held: &mut Held, actions: &mut Actions) -> bool {
    let (pressed, down, pointer) =
        ui.input(|i| (i.pointer.primary_pressed(), i.pointer.primary_down(), i.pointer.interact_pos()));
    let mut busy = *held != Held::Nothing;
    if !down {
        *held = Held::Nothing;
    }
    busy |= handles(ui, session, axis, actions);
    busy |= end(ui, session, axis, held, (pressed, pointer), actions);
    for (index, keyframe) in session.design().keyframes.iter().enumerate() {
        busy |= diamond(ui, session, axis, (index, keyframe), held, (pressed, pointer), actions);
    }
    if let Some(pointer) = pointer.filter(|_| down && !pressed) {
        drag(ui, session, held, axis.time(pointer.x), actions);
    }
    busy || *held != Held::Nothing
}

fn diamond(
    ui: &mut Ui,
    session: &Session,
    axis: &Axis,
    (index, keyframe): (usize, &Keyframe),
    held: &mut Held,
    (pressed, pointer): (bool, Option<Pos2>),
    actions: &mut Actions,
) -> bool {
    let center = pos2(axis.x(keyframe.time_s), axis.base());
    let keys = session.keys();
    let selected = keys.contains(&index);
    let id = ui.scope_id().with("keyframe").with(index);
    let response = ui.interact(Rect::from_center_size(center, vec2(18.0, 18.0)), id, Sense::click_and_drag());
    let response = response.on_hover_cursor(CursorIcon::ResizeHorizontal);
    response.widget_info(|| {
        WidgetInfo::selected(Role::Button, true, selected, tf!("Keyframe {number}", number = index + 1))
    });
    let large = response.hovered() || response.has_focus() || selected && *held != Held::Nothing;
    let ink = ui.visuals().widgets.noninteractive.fg_stroke.color;
    let fill = if selected { style::accent(session.look().theme) } else { ink };
    let stroke = Stroke::new(1.5, ui.visuals().window_fill);
    ui.painter().add(icons::diamond(center, if large { 8.0 } else { 6.5 }, fill, stroke));
    let beside = ui.input(|i| i.modifiers.command || i.modifiers.shift);
    let mut busy = false;
    if let Some(pointer) = pointer.filter(|_| pressed && response.is_pointer_button_down_on()) {
        let keys = match (beside, selected) {
            (false, true) => keys.clone(),
            (false, false) => vec![index],
            (true, _) => toggled(&keys, index),
        };
        if keys != session.keys() {
            actions.push(Action::GatherKeys(keys.clone()));
        }
        *held = Held::Keys { keys, from_s: axis.time(pointer.x), own_s: keyframe.time_s };
        busy = true;
    }
    if response.clicked() {
        busy = true;
        // A quick click is over before the frame in which it began.
        if !beside {
            actions.push(Action::GatherKeys(vec![index]));
            actions.push(Action::Scrub(keyframe.time_s));
        }
    }
    if response.secondary_clicked() && !selected {
        actions.push(Action::GatherKeys(vec![index]));
    }
    response.context_menu(|ui| {
        ui.set_min_width(180.0);
        ui.menu_button(t("Easing"), |ui| {
            if let Some(easing) = easings(ui, keyframe.easing) {
                let keys = if selected { keys.clone() } else { vec![index] };
                actions.push(Action::Change(Change::EaseKeyframes { keys, easing }));
                ui.close();
            }
        });
        for command in [&EARLIER, &LATER, &COPY, &CUT, &PASTE, &ALL_KEYFRAMES, &REMOVE] {
            buttons::entry(ui, session, command, session.selected(), actions);
        }
    });
    response.on_hover_text(tf!("{time_s:.2} s, {follows}", time_s = keyframe.time_s, follows = follows(keyframe)));
    busy
}

fn toggled(keys: &[usize], index: usize) -> Vec<usize> {
    let mut keys = keys.to_vec();
    match keys.iter().position(|&key| key == index) {
        Some(at) => drop(keys.remove(at)),
        None => keys.push(index),
    }
    keys
}

/// What the hand does with what it holds.
fn drag(ui: &Ui, session: &Session, held: &Held, at_s: f64, actions: &mut Actions) {
    let (dragging, free) = ui.input(|i| (i.pointer.is_decidedly_dragging(), i.modifiers.shift));
    if !dragging {
        return;
    }
    let snapped = |time_s: f64| if free { time_s } else { (time_s / SNAP_S).round() * SNAP_S };
    match held {
        Held::Nothing => {}
        Held::Keys { keys, from_s, own_s } => {
            let by_s = snapped((own_s + at_s - from_s).max(0.0)) - own_s;
            actions.push(Action::Again(Change::MoveKeyframes { keys: keys.clone(), by_s }));
        }
        Held::End { keys, first_s, last_s } => {
            let factor = (snapped(at_s) - first_s).max(SNAP_S) / (last_s - first_s);
            actions.push(Action::Again(Change::StretchKeyframes { keys: keys.clone(), factor }));
        }
        Held::Sweep { from_s } => {
            let within = |time_s: f64| time_s >= from_s.min(at_s) && time_s <= from_s.max(at_s);
            let frames = session.design().keyframes.iter().enumerate();
            let keys: Vec<usize> = frames.filter(|(_, k)| within(k.time_s)).map(|(index, _)| index).collect();
            if keys != session.keys() {
                actions.push(Action::GatherKeys(keys));
            }
        }
    }
}

/// The bar over what is selected together; its end stretches it.
fn end(
    ui: &mut Ui,
    session: &Session,
    axis: &Axis,
    held: &mut Held,
    (pressed, pointer): (bool, Option<Pos2>),
    actions: &mut Actions,
) -> bool {
    let keys = &session.timing().keys;
    let times: Vec<f64> = keys.iter().filter_map(|&key| Some(session.design().keyframes.get(key)?.time_s)).collect();
    let (first_s, last_s) =
        (times.iter().copied().fold(f64::INFINITY, f64::min), times.iter().copied().fold(0.0, f64::max));
    if times.len() < 2 || last_s <= first_s {
        return false;
    }
    let y = axis.base() - ABOVE;
    let accent = style::accent(session.look().theme);
    ui.painter_at(axis.rect).hline(axis.x(first_s)..=axis.x(last_s), y, Stroke::new(2.0, accent));
    let grip = Rect::from_center_size(pos2(axis.x(last_s), y), vec2(12.0, 12.0));
    let response = ui.interact(grip, ui.scope_id().with("stretch keyframes"), Sense::click_and_drag());
    let response = response.on_hover_cursor(CursorIcon::ResizeHorizontal);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, t("Stretch selected keyframes")));
    let bar = Rect::from_center_size(grip.center(), vec2(5.0, 12.0));
    ui.painter_at(axis.rect).rect_filled(bar, 2.0, accent);
    if pointer.is_some() && pressed && response.is_pointer_button_down_on() {
        *held = Held::End { keys: keys.clone(), first_s, last_s };
        return true;
    }
    // By the keyboard, in steps.
    if response.has_focus() {
        let step = |key| ui.input(|i| i.key_pressed(key));
        let by = if step(eframe::egui::Key::ArrowRight) {
            SNAP_S
        } else if step(eframe::egui::Key::ArrowLeft) {
            -SNAP_S
        } else {
            return false;
        };
        let factor = (last_s + by - first_s).max(SNAP_S) / (last_s - first_s);
        actions.push(Action::Change(Change::StretchKeyframes { keys: keys.clone(), factor }));
    }
    response.on_hover_text(t("Drag to stretch what is selected"));
    false
}

/// A handle of an easing: of which keyframe's, whether that of its end, and its name.
type Handle = (usize, bool, &'static str);

/// Handles of the easing around the selected keyframe: how slowly the motion to it ends, how slowly that from it begins and ends.
fn handles(ui: &mut Ui, session: &Session, axis: &Axis, actions: &mut Actions) -> bool {
    let Selection::Keyframe(index) = session.selection() else { return false };
    let to = index.checked_sub(1).map(|before| (before, true, t("Handle of the end before")));
    let from = [(index, false, t("Handle of the beginning")), (index, true, t("Handle of the end"))];
    let mut busy = false;
    for of in to.into_iter().chain(from) {
        busy |= handle(ui, session, axis, of, actions);
    }
    busy
}

fn handle(ui: &mut Ui, session: &Session, axis: &Axis, (index, at_end, name): Handle, actions: &mut Actions) -> bool {
    let frames = &session.design().keyframes;
    let (Some(from), Some(to)) = (frames.get(index), frames.get(index + 1)) else { return false };
    let (out, into) = match from.easing {
        Easing::Slow { out, into } => (out, into),
        Easing::Smooth => (THIRD, THIRD),
        Easing::Linear | Easing::Hold => return false,
    };
    let lasts = to.time_s - from.time_s;
    let (end_s, at_s) =
        if at_end { (to.time_s, to.time_s - into * lasts) } else { (from.time_s, from.time_s + out * lasts) };
    let center = pos2(axis.x(at_s), axis.base() - ABOVE);
    let accent = style::accent(session.look().theme);
    let id = ui.scope_id().with(("easing handle", index, at_end));
    let response = ui.interact(Rect::from_center_size(center, vec2(14.0, 14.0)), id, Sense::click_and_drag());
    let response = response.on_hover_cursor(CursorIcon::ResizeHorizontal);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
    let painter = ui.painter_at(axis.rect);
    painter.line_segment([pos2(axis.x(end_s), axis.base()), center], Stroke::new(1.0, accent));
    let radius = if response.hovered() { 5.5 } else { 4.5 };
    painter.circle(center, radius, ui.visuals().window_fill, Stroke::new(1.8, accent));
    let busy = response.is_pointer_button_down_on();
    if let Some(pointer) = response.interact_pointer_pos().filter(|_| response.dragged()) {
        let part = (axis.time(pointer.x) - from.time_s) / lasts;
        let part = (if at_end { 1.0 - part } else { part }).clamp(HANDLE[0], HANDLE[1]);
        // To the hundredth: what is read off and typed.
        let part = (100.0 * part).round() / 100.0;
        let easing = if at_end { Easing::Slow { out, into: part } } else { Easing::Slow { out: part, into } };
        actions.push(Action::Live(Change::EaseKeyframes { keys: vec![index], easing }));
    }
    if !busy {
        response.on_hover_text(t("How slowly the motion begins and ends: drag away from the keyframe for slower"));
    }
    busy
}
