//! What is asked about a blueprint: its parts, the machine that cuts, and its sheets.

use crate::fabrication::piece::Corners;
use crate::fabrication::{Cutter, Topic};
use crate::operations::export;
use crate::studio::language::{mark, t};
use eframe::egui::{DragValue, Ui};

/// The parts of a blueprint, their names and what is in them.
const PARTS: [(Topic, &str, &str); 6] = [
    (Topic::Laser, mark("Patterns to cut"), mark("SVG and DXF for machines, and the body as it is when it is stuffed")),
    (Topic::Print, mark("Patterns to print"), mark("PDF at their size, and on A4 and Letter pages")),
    (Topic::Routing, mark("Routing"), mark("The ways of the threads, front and back")),
    (Topic::Winches, mark("Winches"), mark("Spools and housings to print, and which motors fit")),
    (Topic::Motors, mark("Motors"), mark("Tracks and programs for controllers")),
    (Topic::Guide, mark("Assembly guide"), mark("Parts list, steps and pictures")),
];
const CUTTERS: [(Cutter, &str, &str); 3] = [
    (Cutter::Laser, mark("Laser"), mark("Red hairlines are cut, blue ones are stitches, green ones are marks")),
    (Cutter::Lightburn, mark("LightBurn"), mark("The colours of LightBurn's first layers")),
    (Cutter::Plotter, mark("Plotter"), mark("Black hairlines are cut by a blade")),
];
/// Smallest and largest sides of sheets, and kerfs, mm.
const SHEET_MM: [f64; 2] = [150.0, 10_000.0];
const KERF_MM: [f64; 2] = [0.0, 5.0];

/// Asks for the parts and sheets of a blueprint.
pub(super) fn parts_and_sheets(ui: &mut Ui, options: &mut export::Options) {
    ui.checkbox(&mut options.compensate, t("Compensate for stuffing"))
        .on_hover_text(t("Widen the pattern so that the stuffed body is as drawn, where that can be done"));
    ui.collapsing(t("Parts and sheets"), |ui| {
        ui.label(t("Write these parts"));
        for (topic, label, tip) in PARTS {
            let mut wanted = options.only.has(topic);
            ui.checkbox(&mut wanted, t(label)).on_hover_text(t(tip));
            options.only.set(topic, wanted);
        }
        ui.horizontal(|ui| {
            ui.label(t("Cutter"));
            for (cutter, label, tip) in CUTTERS {
                ui.radio_value(&mut options.cutter, cutter, t(label)).on_hover_text(t(tip));
            }
        });
        ui.horizontal(|ui| {
            let [width, height] = &mut options.sheet.size_mm;
            let tip = t("Sheets that the machine cuts; patterns to print are on A4 and Letter pages all the same");
            figure(ui, t("Cutter's sheet, width"), width, SHEET_MM, tip);
            figure(ui, t("Height"), height, SHEET_MM, tip);
            figure(
                ui,
                t("Kerf"),
                &mut options.cutting.kerf_mm,
                KERF_MM,
                t("Width that the machine burns away; lines move by half of it"),
            );
        });
        let mut mitred = options.cutting.corners == Corners::Mitred;
        ui.checkbox(&mut mitred, t("Mitred corners"))
            .on_hover_text(t("Points at the corners of the allowance, as a ruler draws them"));
        options.cutting.corners = if mitred { Corners::Mitred } else { Corners::Round };
    });
}

/// A figure in mm with its name.
fn figure(ui: &mut Ui, name: &str, value: &mut f64, [low, high]: [f64; 2], tip: &str) {
    let label = ui.label(name);
    let speed = if high > 100.0 { 1.0 } else { 0.05 };
    let field = DragValue::new(value).range(low..=high).speed(speed).suffix(" mm");
    ui.add(field).labelled_by(label.id).on_hover_text(tip);
}
