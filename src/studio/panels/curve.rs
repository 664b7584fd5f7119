//! A chart to choose a rig from: the worst pose's error against the number of winches and of tendons.

use super::buttons;
use super::widgets::passing;
use crate::operations::explore::Point;
use crate::picture::palette::Palette;
use crate::studio::action::{Action, Actions};
use crate::studio::commands::discovery::{CANCEL_CURVE, CURVE};
use crate::studio::language::{t, tf, tn};
use crate::studio::session::{Curve, Session};
use crate::studio::style;
use crate::studio::words;
use eframe::egui::{
    Align2, Color32, FontId, Pos2, Rect, RichText, Role, Sense, Spinner, Stroke, Ui, Vec2, WidgetInfo, pos2, vec2,
};

/// Height of the chart, its margins for the words beside the axes, and the side of what can be clicked, logical pixels.
const HEIGHT: f32 = 150.0;
const MARGIN: Vec2 = vec2(34.0, 18.0);
const TOUCH: f32 = 18.0;
const DOT: f32 = 4.5;

pub fn show(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let curve = &session.rigging.curve;
    passing(ui, true, |ui| match &curve.running {
        Some(running) => {
            ui.horizontal(|ui| {
                ui.add(Spinner::new());
                ui.label(tf!(
                    "{seconds} s, {rigs} rigs",
                    seconds = running.started.elapsed().as_secs(),
                    rigs = curve.points.len()
                ));
                buttons::text(ui, session, &CANCEL_CURVE, actions);
            });
            ui.ctx().request_repaint_after(std::time::Duration::from_millis(200));
        }
        None => {
            let width = ui.available_width();
            buttons::wide(ui, session, &CURVE, width, actions);
        }
    });
    if curve.points.is_empty() {
        return;
    }
    let words = match curve.stale {
        true => {
            RichText::new(t("Found for another body: none of these can be taken")).color(ui.visuals().warn_fg_color)
        }
        false => RichText::new(t("Worst pose, % of its error at rest. Click to take a rig")).weak(),
    };
    ui.label(words.small());
    ui.add_enabled_ui(!curve.stale, |ui| chart(ui, session, curve, actions));
}

fn chart(ui: &mut Ui, session: &Session, curve: &Curve, actions: &mut Actions) {
    let (whole, _) = ui.allocate_exact_size(vec2(ui.available_width(), HEIGHT), Sense::hover());
    let rect = Rect::from_min_max(whole.min + vec2(MARGIN.x, 8.0), whole.max - vec2(10.0, MARGIN.y));
    let most = |of: fn(&Point) -> usize| curve.points.iter().map(|point| of(point)).max().unwrap_or(1);
    let fewest = curve.points.iter().map(|point| point.tendons).min().unwrap_or(1);
    let (tendons, winches) = (most(|p| p.tendons), most(|p| p.winches));
    let worst = curve.points.iter().map(|p| p.worst).filter(|w| w.is_finite()).fold(f64::MIN_POSITIVE, f64::max);
    let place = |point: &Point| -> Pos2 {
        let across = (point.tendons - fewest) as f32 / (tendons - fewest).max(1) as f32;
        let up = (point.worst.min(worst) / worst) as f32;
        pos2(rect.left() + across * rect.width(), rect.bottom() - up * rect.height())
    };
    axes(ui, rect, [fewest, tendons], worst);
    let palette = Palette::of(session.look.theme);
    let color = |winches: usize| -> Color32 {
        let color = style::color32(palette.winch(winches - 1));
        if curve.stale { color.gamma_multiply(0.4) } else { color }
    };
    for count in 1..=winches {
        let line: Vec<Pos2> = curve.points.iter().filter(|p| p.winches == count).map(|p| place(p)).collect();
        ui.painter().line(line, Stroke::new(1.5, color(count)));
    }
    for (index, point) in curve.points.iter().enumerate() {
        let touch = Rect::from_center_size(place(point), Vec2::splat(TOUCH));
        let response = ui.interact(touch, ui.scope_id().with(("rig of the curve", index)), Sense::click());
        let enabled = ui.is_enabled();
        response.widget_info(|| WidgetInfo::labeled(Role::Button, enabled, name(point)));
        let grown = if response.hovered() || response.has_focus() { 1.4 } else { 1.0 };
        ui.painter().circle_filled(place(point), grown * DOT, color(point.winches));
        if response.on_hover_text(details(point)).clicked() {
            actions.push(Action::TakeRig(index));
        }
    }
}

/// Numbers at the ends of both axes, and what they are.
fn axes(ui: &Ui, rect: Rect, tendons: [usize; 2], worst: f64) {
    let weak = ui.visuals().weak_text_color();
    let painter = ui.painter();
    let stroke = Stroke::new(1.0, weak);
    painter.line_segment([rect.left_bottom(), rect.right_bottom()], stroke);
    painter.line_segment([rect.left_bottom(), rect.left_top()], stroke);
    let text = |at: Pos2, anchor: Align2, words: String| {
        painter.text(at, anchor, words, FontId::proportional(10.5), weak);
    };
    text(rect.left_top() - vec2(4.0, 0.0), Align2::RIGHT_CENTER, format!("{:.0}", 100.0 * worst));
    text(rect.left_bottom() - vec2(4.0, 0.0), Align2::RIGHT_CENTER, "0".to_owned());
    text(rect.left_bottom() + vec2(0.0, 3.0), Align2::LEFT_TOP, tendons[0].to_string());
    text(rect.center_bottom() + vec2(0.0, 3.0), Align2::CENTER_TOP, t("tendons of each winch").to_owned());
    if tendons[1] > tendons[0] {
        text(rect.right_bottom() + vec2(0.0, 3.0), Align2::RIGHT_TOP, tendons[1].to_string());
    }
}

/// What a reader of the screen says.
fn name(point: &Point) -> String {
    let Point { winches, tendons, .. } = point;
    tn!(
        winches = *winches,
        "Take up to {winches} winch of {tendons}",
        "Take up to {winches} winches of {tendons}",
        tendons
    )
}

fn details(point: &Point) -> String {
    let Point { takes: [winches, tendons], holes, thread_mm, worst, poses, .. } = point;
    let holes = tn!(holes = *holes, "{holes} hole", "{holes} holes");
    let mut lines = vec![
        name(point),
        tf!("{built}, {holes}, {thread_mm:.0} mm of cable", built = words::built(*winches, *tendons), holes, thread_mm),
        tf!("Worst pose {percent:.1} % of its error at rest", percent = 100.0 * worst),
    ];
    lines.extend(poses.iter().map(|p| {
        tf!("{name}: {before:.1} % to {after:.1} %", name = p.name, before = 100.0 * p.rest, after = 100.0 * p.error)
    }));
    lines.join("\n")
}
