//! Drawing the outline: pencils, parts, the numbers of the part that is picked out, and the body that comes of it.

use super::buttons;
use super::widgets::heading;
use crate::mesh::MAX_FIBERS;
use crate::outline::Point;
use crate::outline::drawing::{Item, Part, Primitive, track};
use crate::studio::action::Sketch;
use crate::studio::action::{Action, Actions};
use crate::studio::canvas;
use crate::studio::change::Change;
use crate::studio::commands;
use crate::studio::commands::command::Scope;
use crate::studio::commands::outline::{CLOSE, CORNER, CUT, DELETE, MAKE_BODY, TRACE};
use crate::studio::icons::{self, Icon};
use crate::studio::language::{t, tf, tn};
use crate::studio::session::Resolution;
use crate::studio::session::Session;
use eframe::egui::{Align, DragValue, Grid, Layout, RichText, ScrollArea, Ui};

/// Least radius, mm.
const LEAST_MM: f64 = 0.5;

pub fn show(ui: &mut Ui, session: &Session, state: &mut canvas::State, actions: &mut Actions) {
    let sketching = session.sketching();
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 1.0;
        ui.spacing_mut().button_padding.x = 6.0;
        for command in commands::tools::ALL.iter().filter(|command| command.scope == Scope::Outline) {
            buttons::choice(ui, session, command, actions);
        }
    });
    buttons::tick(ui, session, &CUT, actions);
    ui.separator();
    heading(ui, t("Parts"));
    let rest = 240.0_f32.min(0.45 * ui.available_height());
    ScrollArea::vertical().auto_shrink([false, true]).max_height(rest).show(ui, |ui| parts(ui, session, actions));
    ui.add_space(6.0);
    if let Some(item) = sketching.item {
        numbers(ui, session, item, actions);
        ui.add_space(6.0);
    }
    heading(ui, t("Body"));
    body(ui, session, state, actions);
}

fn parts(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let drawing = session.drawing();
    if drawing.parts.is_empty() {
        ui.label(RichText::new(t("Nothing drawn yet")).weak());
    }
    for (k, part) in drawing.parts.iter().enumerate() {
        let name = format!("{} {}{}", k + 1, t(part.primitive.name()), if part.cut { t(", cut out") } else { "" });
        row(ui, session, Item::Part(k), &name, &tf!("part {number}", number = k + 1), actions);
    }
    if drawing.tracks.is_empty() {
        return;
    }
    ui.add_space(4.0);
    heading(ui, t("Tendon tracks"));
    for (k, points) in drawing.tracks.iter().enumerate() {
        let name = tf!("Track {number}, {length_mm:.0} mm", number = k + 1, length_mm = track::length(points));
        row(ui, session, Item::Track(k), &name, &tf!("track {number}", number = k + 1), actions);
    }
}

/// A line of the list: picks an item out, or deletes it.
fn row(ui: &mut Ui, session: &Session, item: Item, name: &str, short: &str, actions: &mut Actions) {
    ui.horizontal(|ui| {
        if ui.selectable_label(session.sketching().item == Some(item), name).clicked() {
            actions.push(Action::Sketch(Sketch::Select(Some(item), None)));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let (what, tip) = match item {
                Item::Part(_) => (t("Delete part"), DELETE.hint(t("Delete this part"))),
                Item::Track(_) => (t("Delete track"), DELETE.hint(t("Delete this track"))),
            };
            if icons::small_button(ui, Icon::Trash, &tf!("Delete {short}", short), &tip).clicked() {
                let drawing = session.drawing().without(item);
                actions.push(Action::Change(Change::Draw { what, drawing }));
            }
        });
    });
}

/// Everything about a part or a track as numbers.
fn numbers(ui: &mut Ui, session: &Session, item: Item, actions: &mut Actions) {
    let point = session.sketching().point;
    let mut drawing = session.drawing().clone();
    let what = match item {
        Item::Part(k) => {
            let Some(part) = drawing.parts.get_mut(k) else { return };
            heading(ui, &tf!("Part {number}", number = k + 1));
            numbers_of_part(ui, part, point);
            t("Change part")
        }
        Item::Track(k) => {
            let Some(points) = drawing.tracks.get_mut(k) else { return };
            heading(ui, &tf!("Track {number}", number = k + 1));
            Grid::new("track").num_columns(2).spacing([8.0, 4.0]).show(ui, |ui| {
                match point.and_then(|k| points.get_mut(k)) {
                    Some(point) => place(ui, t("Point"), point),
                    None => count(ui, points.len()),
                }
            });
            t("Change track")
        }
    };
    if drawing != *session.drawing() {
        actions.push(Action::Live(Change::Draw { what, drawing }));
    }
}

fn place(ui: &mut Ui, name: &str, p: &mut Point) {
    let label = ui.label(name);
    ui.horizontal(|ui| {
        for value in p {
            ui.add(DragValue::new(value).speed(0.5).max_decimals(1).suffix(" mm")).labelled_by(label.id);
        }
    });
    ui.end_row();
}

fn radius(ui: &mut Ui, name: &str, r: &mut f64) {
    let label = ui.label(name);
    let drag = DragValue::new(r).speed(0.5).max_decimals(1).range(LEAST_MM..=1e6).suffix(" mm");
    ui.add(drag).labelled_by(label.id);
    ui.end_row();
}

fn count(ui: &mut Ui, points: usize) {
    ui.label(t("Points"));
    ui.label(points.to_string());
    ui.end_row();
}

fn numbers_of_part(ui: &mut Ui, part: &mut Part, point: Option<usize>) {
    Grid::new("part").num_columns(2).spacing([8.0, 4.0]).show(ui, |ui| match &mut part.primitive {
        Primitive::Circle { center, radius: r } => {
            place(ui, t("Centre"), center);
            radius(ui, t("Radius"), r);
        }
        Primitive::Capsule { ends: [a, b], radii: [r, s] } => {
            place(ui, t("From"), a);
            radius(ui, t("First radius"), r);
            place(ui, t("To"), b);
            radius(ui, t("Second radius"), s);
        }
        Primitive::Path { points } => match point.and_then(|k| points.get_mut(k)) {
            Some(point) => {
                place(ui, t("Point"), &mut point.at);
                ui.label("");
                ui.checkbox(&mut point.corner, t("Corner")).on_hover_text(CORNER.hint(t("Sharp, not round")));
                ui.end_row();
            }
            None => count(ui, points.len()),
        },
    });
    let tip = t("Cut this part out of what was drawn before it");
    ui.checkbox(&mut part.cut, t("Cut out")).on_hover_text(tip);
}

fn body(ui: &mut Ui, session: &Session, state: &mut canvas::State, actions: &mut Actions) {
    let surface = state.surface(session.drawing());
    let [wide_mm, high_mm] = surface.size;
    let trouble = match (surface.pieces, &surface.trouble) {
        (_, Some(why)) => Some(why.clone()),
        (0, None) => Some(t("Draw something that is not cut out again.").to_owned()),
        (1, None) => None,
        (n, None) => Some(tf!("{count} separate pieces: join them, or delete what is too much.", count = n)),
    };
    let size = format!("{wide_mm:.0} × {high_mm:.0} mm");
    let text = match surface.holes {
        0 => size,
        holes => format!("{size}, {}", tn!(holes, "{holes} hole", "{holes} holes")),
    };
    ui.label(text);
    if session.drawing().parts.is_empty() {
        // Nothing is wrong with a sheet that is still empty.
        ui.label(RichText::new(t("Draw the silhouette: freehand, or of polygons, circles and capsules")).weak());
    } else if let Some(trouble) = &trouble {
        ui.label(RichText::new(trouble).color(ui.visuals().warn_fg_color));
    }
    let cut_off: Vec<String> =
        (0..surface.tracks.len()).filter(|&k| surface.is_cut_off(k)).map(|k| (k + 1).to_string()).collect();
    if trouble.is_none() && !cut_off.is_empty() {
        let text = tf!("Tracks are cut off where they leave the body: {tracks}.", tracks = cut_off.join(", "));
        ui.label(RichText::new(text).color(ui.visuals().weak_text_color()));
    }
    let resolution = session.resolution();
    ui.horizontal(|ui| {
        let label = ui.label(t("Muscle fibres"));
        let mut fibers = resolution.fibers;
        let speed = (fibers as f64 * 0.01).max(0.05);
        let drag = DragValue::new(&mut fibers).range(3..=MAX_FIBERS).speed(speed);
        ui.add(drag).labelled_by(label.id).on_hover_text(t("How many edges the mesh of the fibres shall have"));
        if fibers != resolution.fibers {
            actions.push(Action::SetResolution(Resolution { fibers, ..resolution }));
        }
    });
    ui.add_space(4.0);
    match session.meshing().running {
        None => {
            let width = ui.available_width();
            buttons::primary(ui, session, &MAKE_BODY, trouble.is_none(), width, actions);
        }
        Some(_) => buttons::meshing(ui, session, actions),
    }
    let width = ui.available_width();
    buttons::wide(ui, session, &CLOSE, width, actions);
    if session.design().drawing.is_some() {
        buttons::wide(ui, session, &TRACE, width, actions);
    }
}
