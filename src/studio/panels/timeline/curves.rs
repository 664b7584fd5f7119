//! The curves of the winches in mm, with their limits, what simulated drives make of them, and where the motors would not follow.

use super::axis::{Axis, RULER};
use super::drives::Drives;
use crate::design::animation;
use crate::engine::winch_reach_mm;
use crate::motion::{Doubt, Why};
use crate::picture::palette::Palette;
use crate::studio::language::tf;
use crate::studio::session::Session;
use crate::studio::style;
use eframe::egui::{Align2, Color32, FontId, Mesh, Pos2, Rect, Role, Sense, Shape, Stroke, Ui, WidgetInfo, pos2, vec2};

/// Room above the highest curve, logical pixels.
const ABOVE: f32 = 26.0;
/// Winding is shown up to the reach of a winch where that is less than this part above what is wound.
const NEAR_REACH: f64 = 1.4;
/// Way between samples of a curve, logical pixels: a smooth one leaves its chords by a tenth of a pixel.
const SAMPLE: f32 = 6.0;
/// A dash and the gap after it, logical pixels.
const DASH: [f32; 2] = [5.0, 4.0];

/// mm to pixels.
struct Scale {
    base: f32,
    pixels_per_mm: f64,
    most_mm: f64,
}

impl Scale {
    fn y(&self, wound_mm: f64) -> f32 {
        self.base - (wound_mm * self.pixels_per_mm) as f32
    }
}

pub fn show(ui: &mut Ui, session: &Session, axis: &Axis, drives: Option<&Drives>) {
    let design = session.design();
    let end = animation::duration_s(design);
    let wound = design.keyframes.iter().flat_map(|k| k.activations_mm.iter().copied());
    let largest = wound.fold(0.0, f64::max);
    if largest <= 0.0 || end <= 0.0 {
        return;
    }
    let reach = design.networks.iter().filter(|network| !network.muted).map(|n| winch_reach_mm(design, n));
    let reach: Vec<f64> = reach.filter(|&reach| reach < NEAR_REACH * largest).collect();
    let most_mm = reach.iter().copied().fold(largest, f64::max);
    let height = f64::from(axis.base() - axis.rect.top() - ABOVE).max(1.0);
    let scale = Scale { base: axis.base(), pixels_per_mm: height / most_mm, most_mm };
    for doubt in session.timing().doubts() {
        doubted(ui, axis, doubt);
    }
    limits(ui, axis, &scale, &reach);
    let samples = ((axis.x(end) - axis.x(0.0)) / SAMPLE).clamp(8.0, 600.0) as usize;
    let times = (0..=samples).map(|i| end * i as f64 / samples as f64);
    let rows: Vec<(f32, Vec<f64>)> =
        times.map(|time| (axis.x(time), animation::activations_at(design, time))).collect();
    let palette = Palette::of(session.look().theme);
    for (winch, network) in design.networks.iter().enumerate() {
        let color = style::color32(palette.network(winch, network));
        let color = color.gamma_multiply(if network.muted { 0.3 } else { 0.85 });
        let point = |(x, row): &(f32, Vec<f64>)| pos2(*x, scale.y(row.get(winch).copied().unwrap_or(0.0)));
        ui.painter_at(axis.rect).add(Shape::line(rows.iter().map(point).collect(), Stroke::new(1.8, color)));
        if let Some(drives) = drives.filter(|_| !network.muted) {
            ghost(ui, axis, &scale, drives, winch, color);
        }
    }
    if let Some(drives) = drives {
        loads(ui, session, axis, drives);
    }
}

/// The height of the axis in mm, and how far winches reach.
fn limits(ui: &Ui, axis: &Axis, scale: &Scale, reach: &[f64]) {
    let weak = ui.visuals().weak_text_color();
    let painter = ui.painter_at(axis.rect);
    let font = FontId::proportional(10.0);
    // On the right, where the playhead seldom is.
    let top = pos2(axis.x(axis.span_s), scale.y(scale.most_mm));
    painter.text(top, Align2::RIGHT_BOTTOM, format!("{:.0} mm", scale.most_mm), font, weak);
    for &reach in reach {
        let [left, right] = [axis.x(0.0), axis.x(axis.span_s)];
        painter.add(level(ui, [left, right], scale.y(reach), weak.gamma_multiply(0.6)));
    }
}

/// A level dashed line a pixel high. As a stroke each dash would be ten triangles, a third of all that the window draws.
fn level(ui: &Ui, [left, right]: [f32; 2], y: f32, color: Color32) -> Shape {
    let pixel = 1.0 / ui.ctx().pixels_per_point();
    let top = (y / pixel).round() * pixel;
    let mut mesh = Mesh::default();
    let mut x = (left / pixel).round() * pixel;
    while x < right {
        let end = (x + DASH[0]).min(right);
        mesh.add_colored_rect(Rect::from_min_max(pos2(x, top), pos2(end, top + pixel)), color);
        x += DASH[0] + DASH[1];
    }
    Shape::mesh(mesh)
}

/// A stretch that the motors do not play as it is.
fn doubted(ui: &mut Ui, axis: &Axis, doubt: &Doubt) {
    let visuals = ui.visuals();
    let (color, words) = match &doubt.why {
        Why::TooFast { needs_s } => (visuals.error_fg_color, tf!("Too fast: it takes {needs_s:.2} s", needs_s)),
        Why::TooFar { winch, reach_mm } => {
            (visuals.error_fg_color, tf!("Too far: {winch} winds {reach_mm:.0} mm and no more", winch, reach_mm))
        }
        Why::Jump { winch } => {
            let words = tf!(
                "A keyframe that holds ends in a jump, and no motor jumps: {winch} is on its way here instead. To have it elsewhere, copy the keyframe to where its hold should end",
                winch
            );
            (visuals.warn_fg_color, words)
        }
        // Every motor does that: no reason to look like a fault.
        Why::Rounded { winch } => {
            let weak = visuals.weak_text_color();
            let words = tf!(
                "{winch} starts and stops more softly than drawn: its motor’s limits round the curve off. Nothing has to be done",
                winch
            );
            return edge(ui, axis, [doubt.from_s, doubt.to_s], weak, &words);
        }
    };
    band(ui, axis, [doubt.from_s, doubt.to_s], color, &words);
}

/// A coloured stretch of the track that says why.
fn band(ui: &mut Ui, axis: &Axis, [from_s, to_s]: [f64; 2], color: Color32, words: &str) {
    let top = axis.rect.top() + RULER;
    // A stretch that is hardly there is seen all the same.
    let right = axis.x(to_s).max(axis.x(from_s) + 3.0);
    let rect = Rect::from_min_max(pos2(axis.x(from_s), top), pos2(right, axis.base()));
    ui.painter_at(axis.rect).rect_filled(rect, 2.0, color.gamma_multiply(0.16));
    edge(ui, axis, [from_s, to_s], color, words);
}

/// A coloured line over a stretch of the track that says why.
fn edge(ui: &mut Ui, axis: &Axis, [from_s, to_s]: [f64; 2], color: Color32, words: &str) {
    let (left, right) = (axis.x(from_s), axis.x(to_s).max(axis.x(from_s) + 3.0));
    let edge = Rect::from_min_size(pos2(left, axis.rect.top() + RULER), vec2(right - left, 2.5));
    ui.painter_at(axis.rect).rect_filled(edge, 1.0, color);
    let id = ui.scope_id().with(("doubt", from_s.to_bits(), to_s.to_bits(), words));
    // Only the edge: below it the playhead is set and keyframes are taken.
    let response = ui.interact(edge.expand2(vec2(0.0, 3.0)), id, Sense::hover());
    response.widget_info(|| {
        WidgetInfo::labeled(Role::Label, true, tf!("{from_s:.2} to {to_s:.2} s: {words}", from_s, to_s, words))
    });
    response.on_hover_text(words);
}

/// The way of a simulated drive.
fn ghost(ui: &Ui, axis: &Axis, scale: &Scale, drives: &Drives, winch: usize, color: Color32) {
    let Ok(ghost) = &drives.ghost else { return };
    let wound = ghost.times_s.iter().zip(&ghost.wound_mm);
    let points: Vec<Pos2> =
        wound.filter_map(|(time_s, row)| Some(pos2(axis.x(*time_s), scale.y(*row.get(winch)?)))).collect();
    let stroke = Stroke::new(1.2, color.gamma_multiply(0.8));
    ui.painter_at(axis.rect).extend(Shape::dashed_line(&points, stroke, 3.0, 3.0));
}

/// Moments at which a winch pulls more than its motor keeps up.
fn loads(ui: &mut Ui, session: &Session, axis: &Axis, drives: &Drives) {
    let limit = session.design().controller.torque_nmm;
    let color = ui.visuals().error_fg_color;
    for (time_s, loads) in &drives.loads {
        for (winch, load) in loads.iter().enumerate().filter(|(_, load)| load.torque_nmm > limit) {
            let name = session.design().networks.get(winch).map_or("", |network| &network.name);
            let words = tf!(
                "{name} pulls {torque_nmm:.0} N mm, its motor keeps {limit:.0} up",
                name,
                torque_nmm = load.torque_nmm,
                limit
            );
            let half = 0.5 * axis.span_s / 100.0;
            band(ui, axis, [(time_s - half).max(0.0), time_s + half], color, &words);
        }
    }
}
