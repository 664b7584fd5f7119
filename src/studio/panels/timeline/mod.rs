//! Keyframes in time: play, scrub, select, move, stretch, ease. The curves are the winches' activations.

mod axis;
mod controls;
mod curves;
mod drives;
mod keys;

use crate::design::{Design, animation};
use crate::picture::palette::Palette;
use crate::studio::action::{Action, Actions};
use crate::studio::language::t;
use crate::studio::session::{Mode, Session};
use crate::studio::style;
use axis::{Axis, RULER};
use eframe::egui::{Align2, FontId, Key, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2};
use keys::Held;
use std::sync::Arc;

#[derive(Default)]
pub struct State {
    /// What the width stands for, s; stays while a keyframe is dragged.
    span_s: f64,
    held: Held,
    /// What simulated drives were asked for last.
    drives: Option<Arc<Design>>,
}

/// The timeline shows at least this much, s.
const LEAST_SPAN_S: f64 = 4.0;

pub fn show(ui: &mut Ui, session: &Session, state: &mut State, actions: &mut Actions) {
    controls::show(ui, session, actions);
    ui.add_space(2.0);
    track(ui, session, state, actions);
}

fn track(ui: &mut Ui, session: &Session, state: &mut State, actions: &mut Actions) {
    let size = ui.available_size().max(vec2(80.0, 48.0));
    let (rect, response) = ui.allocate_exact_size(size, Sense::click_and_drag());
    let time_s = session.playback().time_s;
    response.widget_info(|| WidgetInfo {
        current_text_value: Some(format!("{time_s:.2} s")),
        ..WidgetInfo::labeled(Role::Slider, true, t("Timeline"))
    });
    if !ui.input(|i| i.pointer.any_down()) || state.span_s <= 0.0 {
        let end = animation::duration_s(session.design());
        state.span_s = (end + 0.5).max(LEAST_SPAN_S).ceil();
    }
    let axis = Axis { rect, span_s: state.span_s };
    paint_background(ui, session, &axis);
    let drives = drives::follow(session, &mut state.drives, actions);
    curves::show(ui, session, &axis, drives);
    let on_key = keys::show(ui, session, &axis, &mut state.held, actions);
    if let Some(pointer) = response.interact_pointer_pos().filter(|_| !on_key) {
        let sweeps = ui.input(|i| i.modifiers.shift);
        if sweeps && response.drag_started() {
            state.held = Held::Sweep { from_s: axis.time(pointer.x) };
        } else if response.dragged() || response.clicked() {
            actions.push(Action::Scrub(axis.time(pointer.x).clamp(0.0, axis.span_s)));
        }
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
    let base = axis.base();
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
    if session.design().keyframes.is_empty() {
        let text = t("No keyframes yet. “Add keyframe” puts the current pose here.");
        let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(12.0), weak);
        let place = Align2::CENTER_CENTER.anchor_size(axis.rect.center(), galley.size());
        // Over the lines of the seconds.
        let paper = style::color32(Palette::of(session.look().theme).background);
        painter.rect_filled(place.expand(6.0), 0.0, paper);
        painter.galley(place.min, galley, weak);
    }
}

fn paint_playhead(ui: &Ui, session: &Session, axis: &Axis) {
    let x = axis.x(session.playback().time_s);
    let color = style::accent(session.look().theme);
    let width = if session.mode() == Mode::Animation { 2.0 } else { 1.0 };
    let top = axis.rect.top() + RULER + 2.0;
    let painter = ui.painter_at(axis.rect);
    painter.vline(x, top..=axis.rect.bottom(), Stroke::new(width, color));
    painter.add(Shape::convex_polygon(
        vec![pos2(x - 5.0, top - 2.0), pos2(x + 5.0, top - 2.0), pos2(x, top + 6.0)],
        color,
        Stroke::NONE,
    ));
}
