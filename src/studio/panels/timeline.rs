//! Keyframes in time: play, scrub, drag, ease. The curves are the winches' activations.

use super::buttons;
use crate::design::{Easing, Keyframe, animation};
use crate::picture::palette::Palette;
use crate::studio::action::{Action, Actions};
use crate::studio::change::Change;
use crate::studio::commands::animation::{ADD_KEYFRAME, LOOP, PLAY};
use crate::studio::commands::document::DELETE;
use crate::studio::icons::{self, Icon};
use crate::studio::session::{Mode, Selection, Session};
use crate::studio::style;
use eframe::egui::{
    Align, Align2, ComboBox, CursorIcon, FontId, Key, Layout, Pos2, Rect, RichText, Role, Sense, Shape, Stroke, Ui,
    WidgetInfo, pos2, vec2,
};

#[derive(Default)]
pub struct State {
    /// What the width stands for, s; stays while a keyframe is dragged.
    span_s: f64,
    /// A keyframe is in hand.
    held: bool,
    /// From the pointer to it, s.
    offset_s: f64,
}

/// Height of the row of times, logical pixels.
const RULER: f32 = 16.0;
/// The timeline shows at least this much, s.
const LEAST_SPAN_S: f64 = 4.0;
/// Dragged keyframes fall on multiples of this, s; with Shift they are free.
const SNAP_S: f64 = 0.05;

pub fn show(ui: &mut Ui, session: &Session, state: &mut State, actions: &mut Actions) {
    controls(ui, session, actions);
    ui.add_space(2.0);
    track(ui, session, state, actions);
}

fn controls(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        buttons::icon(ui, session, &PLAY, actions);
        buttons::icon(ui, session, &LOOP, actions);
        let time = format!("{:.2} s / {:.2} s", session.playback.time_s, animation::duration_s(session.design()));
        ui.add_space(4.0);
        ui.label(RichText::new(time).monospace());
        ui.add_space(8.0);
        buttons::text(ui, session, &ADD_KEYFRAME, actions);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| selected_keyframe(ui, session, actions));
    });
}

fn selected_keyframe(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let Selection::Keyframe(index) = session.picked.selection else { return };
    let Some(keyframe) = session.design().keyframes.get(index) else { return };
    if icons::button(ui, Icon::Trash, "Delete keyframe", &DELETE.hint("Delete this keyframe")).clicked() {
        actions.push(Action::Change(Change::RemoveKeyframe(index)));
    }
    let mut easing = keyframe.easing;
    let combo = ComboBox::from_id_salt("easing").selected_text(name(easing)).width(84.0).show_ui(ui, |ui| {
        for choice in [Easing::Smooth, Easing::Linear, Easing::Hold] {
            ui.selectable_value(&mut easing, choice, name(choice));
        }
    });
    combo.response.accessible_name("Easing").on_hover_text("How the motion goes from this keyframe to the next");
    if easing != keyframe.easing {
        actions.push(Action::Change(Change::EaseKeyframe(index, easing)));
    }
    if keyframe.pose.is_some() {
        let tip = "What this keyframe winds stays; otherwise it is worked out again where winches or its pose change";
        if ui.button("Fix").on_hover_text(tip).clicked() {
            actions.push(Action::Change(Change::FixKeyframe(index)));
        }
    }
    let pose = follows(keyframe);
    ui.label(RichText::new(format!("Keyframe {} at {:.2} s, {pose}", index + 1, keyframe.time_s)).weak());
}

/// The pose that a keyframe follows.
fn follows(keyframe: &Keyframe) -> String {
    keyframe.pose.as_ref().map_or_else(|| "fixed".into(), |pose| format!("follows {pose}"))
}

fn name(easing: Easing) -> &'static str {
    match easing {
        Easing::Linear => "Linear",
        Easing::Smooth => "Smooth",
        Easing::Hold => "Hold",
        Easing::Slow { .. } => "Handles",
    }
}

/// From seconds to pixels and back.
struct Axis {
    rect: Rect,
    span_s: f64,
}

impl Axis {
    const MARGIN: f32 = 14.0;

    fn x(&self, time_s: f64) -> f32 {
        let width = f64::from((self.rect.width() - 2.0 * Self::MARGIN).max(1.0));
        self.rect.left() + Self::MARGIN + (time_s / self.span_s * width) as f32
    }

    fn time(&self, x: f32) -> f64 {
        let width = f64::from((self.rect.width() - 2.0 * Self::MARGIN).max(1.0));
        f64::from(x - self.rect.left() - Self::MARGIN) / width * self.span_s
    }
}

fn track(ui: &mut Ui, session: &Session, state: &mut State, actions: &mut Actions) {
    let size = ui.available_size().max(vec2(80.0, 48.0));
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let time_s = session.playback.time_s;
    response.widget_info(|| WidgetInfo {
        current_text_value: Some(format!("{time_s:.2} s")),
        ..WidgetInfo::labeled(Role::Slider, true, "Timeline")
    });
    if !ui.input(|i| i.pointer.any_down()) || state.span_s <= 0.0 {
        let end = animation::duration_s(session.design());
        state.span_s = (end + 0.5).max(LEAST_SPAN_S).ceil();
    }
    let axis = Axis { rect, span_s: state.span_s };
    paint_background(ui, session, &axis);
    let on_key = keyframes(ui, session, &axis, state, actions);
    if let Some(pointer) = response.interact_pointer_pos().filter(|_| !on_key)
        && (response.dragged() || response.clicked())
    {
        actions.push(Action::Scrub(axis.time(pointer.x).clamp(0.0, axis.span_s)));
    }
    if response.has_focus() {
        let step = |key| ui.input(|i| i.key_pressed(key));
        if step(Key::ArrowRight) {
            actions.push(Action::Scrub(time_s + 0.1));
        } else if step(Key::ArrowLeft) {
            actions.push(Action::Scrub(time_s - 0.1));
        }
    }
    paint_playhead(ui, session, &axis);
}

fn paint_background(ui: &Ui, session: &Session, axis: &Axis) {
    let painter = ui.painter_at(axis.rect);
    let visuals = ui.visuals();
    let line = visuals.widgets.noninteractive.bg_stroke;
    let weak = visuals.weak_text_color();
    let base = axis.rect.bottom() - 8.0;
    // Labels keep their distance, however long the animation is.
    let step = [1.0, 2.0, 5.0, 10.0, 30.0, 60.0, 300.0]
        .into_iter()
        .find(|step| axis.x(*step) - axis.x(0.0) > 44.0)
        .unwrap_or(600.0);
    let mut tick = 0.0;
    while tick <= axis.span_s {
        let x = axis.x(tick);
        painter.vline(x, axis.rect.top() + RULER..=base, line);
        let text = format!("{tick:.0} s");
        painter.text(pos2(x, axis.rect.top()), Align2::CENTER_TOP, text, FontId::proportional(10.5), weak);
        tick += step;
    }
    painter.hline(axis.x(0.0)..=axis.x(axis.span_s), base, line);
    curves(ui, session, axis, base);
    if session.design().keyframes.is_empty() {
        let text = "No keyframes yet. “Add keyframe” puts the current pose here.";
        let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(12.0), weak);
        let place = Align2::CENTER_CENTER.anchor_size(axis.rect.center(), galley.size());
        // Over the lines of the seconds.
        let paper = style::color32(Palette::of(session.look.theme).background);
        painter.rect_filled(place.expand(6.0), 0.0, paper);
        painter.galley(place.min, galley, weak);
    }
}

fn curves(ui: &Ui, session: &Session, axis: &Axis, base: f32) {
    let design = session.design();
    let end = animation::duration_s(design);
    let keyframes = &design.keyframes;
    let largest = keyframes.iter().flat_map(|k| k.activations_mm.iter().copied()).fold(0.0, f64::max);
    if largest <= 0.0 || end <= 0.0 {
        return;
    }
    let palette = Palette::of(session.look.theme);
    let height = f64::from(base - axis.rect.top() - 26.0);
    let samples = ((axis.x(end) - axis.x(0.0)) / 3.0).clamp(8.0, 600.0) as usize;
    let rows: Vec<(f32, Vec<f64>)> = (0..=samples)
        .map(|i| {
            let time = end * i as f64 / samples as f64;
            (axis.x(time), animation::activations_at(design, time))
        })
        .collect();
    for winch in 0..design.networks.len() {
        let color = style::color32(palette.network(winch, &design.networks[winch]));
        let color = color.gamma_multiply(if design.networks[winch].muted { 0.3 } else { 0.85 });
        let point = |(x, row): &(f32, Vec<f64>)| -> Pos2 {
            pos2(*x, base - (row.get(winch).copied().unwrap_or(0.0) / largest * height) as f32)
        };
        ui.painter_at(axis.rect).add(Shape::line(rows.iter().map(point).collect(), Stroke::new(1.8, color)));
    }
}

/// Draws and drags the keyframes; true if the pointer is busy with one.
fn keyframes(ui: &mut Ui, session: &Session, axis: &Axis, state: &mut State, actions: &mut Actions) -> bool {
    let y = axis.rect.bottom() - 8.0;
    let (pressed, down, pointer) =
        ui.input(|i| (i.pointer.primary_pressed(), i.pointer.primary_down(), i.pointer.interact_pos()));
    let mut busy = state.held;
    state.held &= down;
    for (index, keyframe) in session.design().keyframes.iter().enumerate() {
        let center = pos2(axis.x(keyframe.time_s), y);
        let selected = session.picked.selection == Selection::Keyframe(index);
        let hit = Rect::from_center_size(center, vec2(18.0, 18.0));
        let id = ui.scope_id().with("keyframe").with(index);
        let response = ui.interact(hit, id, Sense::click_and_drag()).on_hover_cursor(CursorIcon::ResizeHorizontal);
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, selected, format!("Keyframe {}", index + 1)));
        let large = response.hovered() || selected && state.held;
        let fill = if selected {
            style::accent(session.look.theme)
        } else {
            ui.visuals().widgets.noninteractive.fg_stroke.color
        };
        let stroke = Stroke::new(1.5, ui.visuals().window_fill);
        ui.painter().add(icons::diamond(center, if large { 8.0 } else { 6.5 }, fill, stroke));
        if let Some(pointer) = pointer.filter(|_| pressed && response.is_pointer_button_down_on()) {
            state.held = true;
            state.offset_s = keyframe.time_s - axis.time(pointer.x);
            actions.push(Action::Select(Selection::Keyframe(index)));
        }
        if response.clicked() {
            busy = true;
            // A quick click is over before the frame in which it began.
            actions.push(Action::Select(Selection::Keyframe(index)));
            actions.push(Action::Scrub(keyframe.time_s));
        }
        let tip = format!("{:.2} s, {}", keyframe.time_s, follows(keyframe));
        response.on_hover_text(tip);
    }
    if let Some(pointer) = pointer.filter(|_| state.held && !pressed) {
        drag_keyframe(ui, session, axis.time(pointer.x) + state.offset_s, actions);
    }
    busy || state.held
}

/// Moves the keyframe in hand, which is the selected one: on its way past others it may change its number.
fn drag_keyframe(ui: &Ui, session: &Session, wanted_s: f64, actions: &mut Actions) {
    let Selection::Keyframe(index) = session.picked.selection else { return };
    let Some(keyframe) = session.design().keyframes.get(index) else { return };
    let (dragging, free) = ui.input(|i| (i.pointer.is_decidedly_dragging(), i.modifiers.shift));
    let wanted_s = wanted_s.max(0.0);
    let time_s = if free { wanted_s } else { (wanted_s / SNAP_S).round() * SNAP_S };
    if dragging && (time_s - keyframe.time_s).abs() > animation::SAME_TIME_S {
        actions.push(Action::Live(Change::MoveKeyframe { index, time_s }));
    }
}

fn paint_playhead(ui: &Ui, session: &Session, axis: &Axis) {
    let x = axis.x(session.playback.time_s);
    let color = style::accent(session.look.theme);
    let width = if session.picked.mode == Mode::Animation { 2.0 } else { 1.0 };
    let top = axis.rect.top() + RULER + 2.0;
    let painter = ui.painter_at(axis.rect);
    painter.vline(x, top..=axis.rect.bottom(), Stroke::new(width, color));
    painter.add(Shape::convex_polygon(
        vec![pos2(x - 5.0, top - 2.0), pos2(x + 5.0, top - 2.0), pos2(x, top + 6.0)],
        color,
        Stroke::NONE,
    ));
}
