//! Settings of the document: body, fibres, tendons, fabrication, motors.

use super::panel::{Entry, Panel};
use super::widgets::heading;
use crate::design::{DriveSettings, Term};
use crate::physics::{Kind, MaterialKind, Setting, TermKind};
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::Hit;
use crate::studio::change::Change;
use crate::studio::commands::languages;
use crate::studio::language::{t, tf};
use crate::studio::session::Session;
use eframe::egui::{ComboBox, DragValue, Grid, ScrollArea, Ui};
use std::ops::RangeInclusive;

/// As wide as the longest name, so that all values stand in one column, logical pixels.
const NAME_WIDTH: f32 = 116.0;
/// Every value has this size, whatever it shows, logical pixels.
const VALUE: [f32; 2] = [130.0, 24.0];

pub static ENTRY: Entry = Entry {
    id: "panel.settings",
    label: "Settings",
    tip: "Body, fibres, tendons, fabrication and motors of this plushie",
    make: || Box::new(Settings),
};

struct Settings;

impl Panel for Settings {
    fn show(&mut self, ui: &mut Ui, session: &Session, actions: &mut Actions) {
        show(ui, session, actions);
    }
}

fn show(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
        section(ui, t("Window"), |ui| language(ui, session, actions));
        section(ui, t("Body"), |ui| body(ui, session, actions));
        section(ui, t("Forces"), |ui| terms(ui, session, actions));
        section(ui, t("Muscle fibres"), |ui| fibers(ui, session, actions));
        section(ui, t("Tendons"), |ui| tendons(ui, session, actions));
        section(ui, t("Fabrication"), |ui| fabrication(ui, session, actions));
        section(ui, t("Sewing"), |ui| sewing(ui, session, actions));
        section(ui, t("Motors"), |ui| controller(ui, session, actions));
    });
}

fn section(ui: &mut Ui, name: &str, rows: impl FnOnce(&mut Ui)) {
    heading(ui, name);
    Grid::new(name).num_columns(2).min_col_width(NAME_WIDTH).spacing([8.0, 4.0]).show(ui, rows);
    ui.add_space(10.0);
}

/// What the window speaks.
fn language(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let tip = t("Language of this window; messages of the solvers, and blueprints, are in English");
    let label = ui.label(t("Language")).on_hover_text(tip);
    let choice = session.look().language;
    let system = tf!("System ({name})", name = choice.system.name);
    let name = choice.chosen.map_or(system.as_str(), |language| language.name);
    let combo = ComboBox::from_id_salt("language").selected_text(name).width(VALUE[0]).show_ui(ui, |ui| {
        for command in languages::all() {
            let name = if *command == languages::SYSTEM { system.as_str() } else { command.label };
            if ui.selectable_label(command.is_on(session), name).clicked() {
                actions.push(Action::Run(command, Hit::Nothing));
                ui.close();
            }
        }
    });
    combo.response.labelled_by(label.id).on_hover_text(tip);
    ui.end_row();
}

/// A row with a number. True if it was changed.
fn number(ui: &mut Ui, name: &str, unit: &str, tip: &str, value: &mut f64, range: RangeInclusive<f64>) -> bool {
    let label = ui.label(name).on_hover_text(tip);
    let speed = (value.abs() * 0.01).max(1e-3);
    let suffix = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    let drag = DragValue::new(value).range(range).speed(speed).max_decimals(3).suffix(suffix);
    let changed = ui.add_sized(VALUE, drag).labelled_by(label.id).on_hover_text(tip).changed();
    ui.end_row();
    changed
}

/// A row with a count. True if it was changed.
fn count(ui: &mut Ui, name: &str, unit: &str, tip: &str, value: &mut u32, range: RangeInclusive<u32>) -> bool {
    let label = ui.label(name).on_hover_text(tip);
    let speed = (f64::from(*value) * 0.01).max(0.1);
    let suffix = if unit.is_empty() { String::new() } else { format!(" {unit}") };
    let drag = DragValue::new(value).range(range).speed(speed).suffix(suffix);
    let changed = ui.add_sized(VALUE, drag).labelled_by(label.id).on_hover_text(tip).changed();
    ui.end_row();
    changed
}

fn body(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let mut material = session.design().material;
    let label = ui.label(t("Material")).on_hover_text(t("How the stuffed body answers to strain"));
    let name = t(material.kind().label);
    let combo = ComboBox::from_id_salt("material").selected_text(name).width(VALUE[0]).truncate().show_ui(ui, |ui| {
        for kind in MaterialKind::all() {
            let other =
                if kind.name == material.kind().name { material } else { session.design().material.turned_into(kind) };
            ui.selectable_value(&mut material, other, t(kind.label));
        }
    });
    combo.response.labelled_by(label.id);
    ui.end_row();
    parameters(ui, &mut material);
    if material != session.design().material {
        actions.push(Action::Live(Change::Material(material)));
    }
}

/// The optional energy terms of the catalogue, each with a switch.
fn terms(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let present = session.design().all_terms();
    for &kind in TermKind::all() {
        let mut term = present.iter().find(|t| t.kind().name == kind.name).copied();
        let before = term;
        let mut on = term.is_some();
        let label = ui.label(t(kind.label)).on_hover_text(t(kind.tip));
        if ui.checkbox(&mut on, "").labelled_by(label.id).on_hover_text(t(kind.tip)).changed() {
            term = on.then(|| Term::default_of(kind));
        }
        ui.end_row();
        if let Some(term) = &mut term {
            parameters(ui, term);
        }
        if term != before {
            actions.push(Action::Live(Change::Term(kind, term)));
        }
    }
}

/// A row for every number of a choice from a catalogue.
fn parameters<K: Kind>(ui: &mut Ui, setting: &mut Setting<K>) {
    for (parameter, values) in setting.each_mut() {
        let (unit, factor) = parameter.shown.unwrap_or((parameter.unit, 1.0));
        let [low, high] = parameter.offered.map(|end| end * factor);
        for (value, axis) in values.iter_mut().zip(["x", "y"]) {
            let name = if parameter.size == 1 {
                t(parameter.label).to_owned()
            } else {
                format!("{} {axis}", t(parameter.label))
            };
            let mut shown = *value * factor;
            if number(ui, &name, unit, t(parameter.tip), &mut shown, low..=high) {
                *value = shown / factor;
            }
        }
    }
}

fn fibers(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let mut f = session.design().fibers.clone();
    number(
        ui,
        t("Fibre stiffness"),
        "N/mm",
        t("K of a muscle fibre; the taut stiffness is twice that"),
        &mut f.stiffness,
        1e-3..=1e3,
    );
    number(
        ui,
        t("Largest contraction"),
        "",
        t("As a fraction of the rest length"),
        &mut f.max_contraction,
        0.05..=0.95,
    );
    if f != session.design().fibers {
        actions.push(Action::Live(Change::Fibers(f)));
    }
}

fn tendons(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let mut own = session.design().tendons.clone();
    number(
        ui,
        t("Tendon stiffness"),
        "N/mm",
        t("K of a tendon; the taut stiffness is twice that"),
        &mut own.stiffness,
        1e-2..=1e4,
    );
    number(
        ui,
        t("Largest winding"),
        "",
        t("As a fraction of the tendon's rest length"),
        &mut own.max_contraction,
        0.05..=0.95,
    );
    let tip = t(
        "Friction coefficient of cable at its holes: check tells what it costs. New designs have a guess; measure yours. 0 is none",
    );
    number(ui, t("Friction"), "", tip, &mut own.friction, 0.0..=1.0);
    if own != session.design().tendons {
        actions.push(Action::Live(Change::Tendons(own)));
    }
}

fn fabrication(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let mut f = session.design().fabrication.clone();
    number(ui, t("Seam allowance"), "mm", t("Felt beyond the seam"), &mut f.seam_allowance_mm, 0.0..=50.0);
    number(ui, t("Tendon hole"), "mm", t("Diameter of the hole a needle must pass"), &mut f.tendon_hole_mm, 0.1..=10.0);
    number(
        ui,
        t("Turning gap"),
        "mm",
        t("Opening left in the seam to turn and stuff the body"),
        &mut f.turning_gap_mm,
        0.0..=500.0,
    );
    number(ui, t("Spool radius"), "mm", t("Radius of the winch's core"), &mut f.spool_radius_mm, 1.0..=100.0);
    if f != session.design().fabrication {
        actions.push(Action::Live(Change::Fabrication(f)));
    }
}

/// What a hand can sew; the list of networks marks those that break it.
fn sewing(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let mut r = session.design().sewing;
    number(
        ui,
        t("Hole to seam"),
        "mm",
        t("Least distance: nearer, the felt tears"),
        &mut r.hole_to_seam_mm,
        0.0..=100.0,
    );
    number(ui, t("Hole to hole"), "mm", t("Least distance between two holes"), &mut r.hole_to_hole_mm, 0.0..=100.0);
    let mut holes = u32::try_from(r.most_holes).unwrap_or(u32::MAX);
    if count(ui, t("Most holes"), "", t("Of a tendon, between its winch and its end"), &mut holes, 0..=1000) {
        r.most_holes = holes as usize;
    }
    number(
        ui,
        t("Sharpest turn"),
        "°",
        t("Of a tendon at one hole: beyond, it saws"),
        &mut r.turn_degrees,
        0.0..=180.0,
    );
    number(
        ui,
        t("Most turning"),
        "°",
        t("Sum of all turns of a tendon: friction"),
        &mut r.turning_degrees,
        0.0..=10000.0,
    );
    number(ui, t("Beside"), "mm", t("Tendons nearer than this run along each other"), &mut r.beside_mm, 0.0..=50.0);
    number(
        ui,
        t("Longest along"),
        "mm",
        t("How far a tendon may run along another one"),
        &mut r.along_mm,
        0.0..=1000.0,
    );
    number(ui, t("Lead"), "mm", t("Length from the winch on which tendons may"), &mut r.lead_mm, 0.0..=1000.0);
    number(ui, t("Housing"), "mm", t("Diameter of a winch with its spool"), &mut r.housing_mm, 0.0..=200.0);
    number(ui, t("Between housings"), "mm", t("Least space between two"), &mut r.between_housings_mm, 0.0..=100.0);
    if r != session.design().sewing {
        actions.push(Action::Live(Change::Sewing(r)));
    }
}

fn controller(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let mut c = session.design().controller.clone();
    count(
        ui,
        t("Encoder lines"),
        "",
        t("Per motor revolution; counts are four times as many"),
        &mut c.encoder_lines,
        1..=16383,
    );
    number(ui, t("Gear ratio"), ": 1", t("Motor revolutions per turn of the spool"), &mut c.gear_ratio, 0.1..=5000.0);
    number(ui, t("Track rate"), "Hz", t("Samples a second in the winch tracks"), &mut c.track_rate_hz, 1.0..=1000.0);
    count(
        ui,
        t("Speed limit"),
        t("rpm"),
        t("Largest motor speed that the plan of the animation asks for"),
        &mut c.speed_rpm,
        1..=30000,
    );
    count(
        ui,
        t("Acceleration"),
        t("rev/s²"),
        t("Largest motor acceleration that the plan of the animation asks for"),
        &mut c.acceleration,
        1..=30000,
    );
    let tip = t("Torque at the spool that the motor can keep up: winches that ask for more turn red");
    number(ui, t("Torque limit"), "N mm", tip, &mut c.torque_nmm, 0.1..=10000.0);
    drives(ui, &mut c.drives);
    if c != session.design().controller {
        actions.push(Action::Live(Change::Controller(c)));
    }
}

/// What single families of controllers are told.
fn drives(ui: &mut Ui, d: &mut DriveSettings) {
    let tip = t("Speed of the line to Faulhaber controllers of the classic family");
    count(ui, t("Line"), "baud", tip, &mut d.baud, 600..=115_200);
    let tip = t("Largest current that their setup allows a motor; 0 leaves it as it is");
    count(ui, t("Current limit"), "mA", tip, &mut d.current_ma, 0..=50_000);
    let tip = t("Unit of DELAY in programs stored in them; believed to be 0.01 s");
    number(ui, t("DELAY unit"), "s", tip, &mut d.delay_unit_s, 0.0001..=1.0);
    let tip = t("Unit of DELAY in scripts of the V3 family; believed to be 0.001 s");
    number(ui, t("Script DELAY unit"), "s", tip, &mut d.script_delay_unit_s, 0.0001..=1.0);
    let tip = t("Largest acceleration that Faulhaber controllers take: set while they follow a motion");
    count(ui, t("Following"), t("rev/s²"), tip, &mut d.following_acceleration, 1..=30_000);
    number(ui, t("Servo range"), "°", t("How far a hobby servo turns"), &mut d.servo_degrees, 10.0..=3600.0);
    let tip = t("Pulse of a hobby servo at the beginning of its range, the cable just slack");
    count(ui, t("Servo at rest"), "µs", tip, &mut d.servo_low_us, 100..=10_000);
    let tip = t("Pulse of a hobby servo at the end of its range; less than at rest where it winds the other way round");
    count(ui, t("Servo at end"), "µs", tip, &mut d.servo_high_us, 100..=10_000);
    let tip = t("Steps of a stepper's driver for a turn of the spool, microsteps counted");
    number(ui, t("Stepper"), t("steps/turn"), tip, &mut d.steps_per_turn, 1.0..=10_000_000.0);
}
