//! Dialogs over the window: unsaved changes, and paths where the desktop has no dialogs of its own.

use super::blueprint_parts::parts_and_sheets;
use super::widgets::primary;
use crate::files::shown;
use crate::mesh::MAX_FIBERS;
use crate::motion::{TooFast, families};
use crate::operations::{FiberCount, export};
use crate::outline::{Background, Holes, Import, Pieces};
use crate::studio::action::{Action, Actions, FileAction};
use crate::studio::session::ImportChoice;
use crate::studio::session::Session;
use crate::studio::session::{Dialog, PathDialog, Purpose, Why};
use crate::studio::words;
use eframe::egui::{
    Align, CollapsingHeader, Context, DragValue, Grid, Id, Key, Layout, Modal, RichText, TextEdit, Ui, emath,
};
use std::ops::RangeInclusive;
use std::path::Path;

/// What can be typed for the silhouette's height, mm, and for the number of fibres; 0 for what is usual.
const HEIGHTS_MM: RangeInclusive<f64> = 0.0..=5000.0;
const FIBERS: RangeInclusive<f64> = 0.0..=MAX_FIBERS as f64;
/// The largest length of the clean-up, mm.
const LARGEST_MM: f64 = 1000.0;

pub fn show(ctx: &Context, session: &Session, actions: &mut Actions) {
    let Some(dialog) = &session.files.dialog else { return };
    let modal = Modal::new(Id::unique("dialog")).show(ctx, |ui| {
        ui.set_width(430.0);
        match dialog {
            Dialog::Unsaved(_) => unsaved(ui, session, actions),
            Dialog::Path(dialog) => path(ui, session, dialog, actions),
            Dialog::Replace(path, why) => replace(ui, path, *why, actions),
            Dialog::Recover => recover(ui, session, actions),
        }
    });
    if modal.should_close() {
        actions.push(Action::File(FileAction::CloseDialog));
    }
}

fn unsaved(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ui.heading(format!("Save changes to “{}”?", session.design().name));
    ui.label("Without saving they are lost.");
    ui.add_space(10.0);
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        if primary(ui, true, "Save changes", 120.0).clicked() {
            actions.push(Action::File(FileAction::SaveAndGoOn));
        }
        if ui.button("Discard changes").clicked() {
            actions.push(Action::File(FileAction::DiscardAndGoOn));
        }
        if ui.button("Cancel").clicked() {
            actions.push(Action::File(FileAction::CloseDialog));
        }
    });
}

fn replace(ui: &mut Ui, path: &Path, why: Why, actions: &mut Actions) {
    let name = shown(path.file_name().map_or(path, Path::new));
    let (heading, text) = match why {
        Why::Exists => {
            (format!("Replace “{name}”?"), "Another plushie has that name. What is in its file is lost then.")
        }
        Why::Foreign => (format!("Replace “{name}”?"), "That file is no plushie. What is in it is lost then."),
        Why::Changed => (
            format!("“{name}” was changed by another program"),
            "It is not what was opened here any more. Replacing it loses those changes; saving under another name keeps both.",
        ),
    };
    ui.heading(heading);
    ui.label(text);
    ui.add_space(10.0);
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        if primary(ui, true, "Save under another name", 180.0).clicked() {
            actions.push(Action::File(FileAction::SaveAs));
        }
        if ui.button("Replace it").clicked() {
            actions.push(Action::File(FileAction::ReplacePath(path.to_owned())));
        }
        if ui.button("Cancel").clicked() {
            actions.push(Action::File(FileAction::CloseDialog));
        }
    });
}

fn recover(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let Some(work) = session.offered() else { return };
    ui.heading(format!("Recover “{}”?", work.design.name));
    let ago = work
        .at
        .elapsed()
        .map_or_else(|_| String::new(), |ago| format!(" It was changed {} ago.", spoken(ago.as_secs())));
    let from = work.facts.path.as_deref().map_or_else(
        || "It has no file yet.".to_owned(),
        |path| format!("It belongs to {}, which is as it was.", shown(path)),
    );
    ui.label(format!("Plushwright ended before this plushie was saved.{ago} {from}"));
    ui.add_space(10.0);
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        if primary(ui, true, "Recover", 100.0).clicked() {
            actions.push(Action::File(FileAction::Recover));
        }
        if ui.button("Discard it").clicked() {
            actions.push(Action::File(FileAction::DiscardWork));
        }
        if ui.button("Not now").clicked() {
            actions.push(Action::File(FileAction::RecoverLater));
        }
    });
}

/// How long something took, in the largest unit that fits.
fn spoken(seconds: u64) -> String {
    let (count, unit) = match seconds {
        0..=119 => (seconds, "second"),
        120..=7199 => (seconds / 60, "minute"),
        7200..=172_799 => (seconds / 3600, "hour"),
        _ => (seconds / 86_400, "day"),
    };
    format!("{count} {unit}{}", if count == 1 { "" } else { "s" })
}

fn path(ui: &mut Ui, session: &Session, dialog: &PathDialog, actions: &mut Actions) {
    let mut edited = dialog.clone();
    ui.heading(dialog.purpose.title());
    ui.add_space(6.0);
    let mut confirmed = false;
    ui.horizontal(|ui| {
        let width = ui.available_width() - if session.files.native_dialogs { 84.0 } else { 0.0 };
        let hint = match dialog.purpose {
            Purpose::Open | Purpose::SaveAs => "Path of a .plush file",
            Purpose::Import => "Path of an SVG, PNG, JPEG, DXF, OBJ or drawing (RON) file",
            Purpose::Export => "Path of a new folder",
        };
        let field = ui.add(TextEdit::singleline(&mut edited.path).hint_text(hint).desired_width(width));
        let field = field.accessible_name("Path");
        confirmed = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        if ui.memory(|m| m.focused().is_none()) {
            field.request_focus();
        }
        if session.files.native_dialogs && ui.button("Browse…").clicked() {
            actions.push(Action::File(FileAction::Browse));
        }
    });
    if dialog.purpose == Purpose::Import {
        import_settings(ui, &mut edited);
    }
    if dialog.purpose == Purpose::Export {
        export_settings(ui, &mut edited.export);
    }
    let path = Path::new(edited.path.trim());
    let is_known = path.exists() && !path.is_dir();
    let is_wrong = !is_known && !path.is_dir() && !path.as_os_str().is_empty();
    let note = match dialog.purpose {
        Purpose::Export => {
            "Patterns, routings, winches, programs for motors and a guide. The folder appears whole or not at all."
        }
        Purpose::SaveAs if path.is_file() && session.document.path.as_deref() != Some(path) => "This file exists.",
        Purpose::Open | Purpose::Import if is_wrong => "There is no such file.",
        Purpose::Import => "The filled shapes of the drawing are joined to one silhouette.",
        _ => "",
    };
    ui.label(RichText::new(note).small().weak());
    if let Some(trouble) = &dialog.trouble {
        ui.label(RichText::new(sentence(trouble)).color(ui.visuals().error_fg_color));
    }
    ui.add_space(10.0);
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        let verb = dialog.purpose.verb();
        let ready = match dialog.purpose {
            Purpose::Open | Purpose::Import => is_known,
            Purpose::SaveAs | Purpose::Export => !edited.path.trim().is_empty(),
        };
        if (primary(ui, ready, verb, 100.0).clicked() || confirmed) && ready {
            actions.push(Action::File(edited.confirm()));
        }
        if ui.button("Cancel").clicked() {
            actions.push(Action::File(FileAction::CloseDialog));
        }
    });
    if edited != *dialog {
        edited.trouble = None;
        // Before anything that closes the dialog.
        actions.insert(0, Action::File(FileAction::EditDialog(edited)));
    }
}

fn export_settings(ui: &mut Ui, options: &mut export::Options) {
    let mut stretch = options.too_fast == TooFast::Stretch;
    let tip = "Give the animation more time where its motors are too slow for it; otherwise it is refused";
    ui.checkbox(&mut stretch, words::STRETCH).on_hover_text(tip);
    options.too_fast = if stretch { TooFast::Stretch } else { TooFast::Refuse };
    parts_and_sheets(ui, options);
    ui.collapsing("Controllers", |ui| {
        ui.label("Programs for these; none chosen: for all that can play the motion");
        for family in families::ALL {
            let at = options.controllers.iter().position(|name| name == family.name);
            let mut chosen = at.is_some();
            if ui.checkbox(&mut chosen, family.name).on_hover_text(family.title).changed() {
                match at {
                    Some(at) => drop(options.controllers.remove(at)),
                    None => options.controllers.push(family.name.into()),
                }
            }
        }
    });
}

fn import_settings(ui: &mut Ui, edited: &mut PathDialog) {
    let ImportChoice { options, layers } = &mut *edited.import;
    ui.horizontal(|ui| {
        let tip = "Of the silhouette; 0: the size that the file has";
        let mut height = options.import.height_mm.unwrap_or(0.0);
        or_usual(ui, ("Height", tip), &mut height, ("as in the file", " mm"), HEIGHTS_MM);
        options.import.height_mm = (height > 0.0).then_some(height);
        ui.add_space(12.0);
        let tip = "0: those of a file that brings its own mesh; otherwise 414, or more where the outline needs them";
        let mut fibers = match options.fibers {
            FiberCount::Usual => 0.0,
            FiberCount::AtLeast(fibers) | FiberCount::Exactly(fibers) => fibers as f64,
        };
        or_usual(ui, ("Muscle fibres", tip), &mut fibers, ("as usual", ""), FIBERS);
        let fibers = fibers.round() as usize;
        options.fibers = FiberCount::asked((fibers > 0).then_some(fibers));
    });
    ui.horizontal(|ui| {
        let mut largest = options.import.pieces == Pieces::Largest;
        ui.checkbox(&mut largest, "Largest piece only")
            .on_hover_text("Of a drawing in several pieces, which is refused otherwise");
        options.import.pieces = if largest { Pieces::Largest } else { Pieces::Refuse };
        ui.add_space(12.0);
        let tip = "Holes of a drawing in thin lines alone are filled; or keep them, or fill all";
        let holes = [(Holes::Found, "as found"), (Holes::Keep, "keep"), (Holes::Fill, "fill")];
        choice(ui, ("Holes", tip), &mut options.import.holes, &holes);
    });
    let tip =
        "Show on the plushie what the SVG, PNG or JPEG shows; saving puts it beside the plushie, NAME.texture.png";
    ui.checkbox(&mut options.texture, "Keep the picture as texture").on_hover_text(tip);
    ui.horizontal(|ui| {
        let label = ui.label("Layers");
        let field = TextEdit::singleline(layers).hint_text("all").desired_width(f32::INFINITY);
        let tip = "Of an SVG or DXF drawing: the names of those that count, between commas";
        ui.add(field).labelled_by(label.id).on_hover_text(tip);
    });
    CollapsingHeader::new("Reading and clean-up")
        .id_salt("import details")
        .show(ui, |ui| details(ui, &mut options.import));
}

/// What is seldom asked for.
fn details(ui: &mut Ui, import: &mut Import) {
    ui.horizontal(|ui| {
        let tip = "Paper, cards and frames that everything else lies on: what is surely one is left out; or leave out any, or keep it";
        let grounds =
            [(Background::Found, "as found"), (Background::Drop, "leave out"), (Background::Keep, "keep")];
        choice(ui, ("Background", tip), &mut import.background, &grounds);
    });
    Grid::new("import details").num_columns(2).spacing([8.0, 4.0]).show(ui, |ui| {
        let tip = "How far smoothing may move the boundary; corners stay. -1: where it is finer than scissors follow; 0: not at all";
        optional(ui, ("Smooth", tip), &mut import.smooth_mm);
        ui.end_row();
        let tip = "Parts less than this apart are joined; -1: what scissors cannot part; 0: none";
        optional(ui, ("Gaps up to", tip), &mut import.gap_mm);
        ui.end_row();
        let tip = "Ends of lines less than this apart are joined; -1: a small part of the size; 0: none";
        optional(ui, ("Join ends up to", tip), &mut import.join_mm);
        ui.end_row();
        // A least width of nothing widens nothing, which is not the usual.
        let tip = "Parts thinner than this are widened; -1: hairlines alone, as long as that changes little; 0: none";
        optional(ui, ("Least width", tip), &mut import.min_width_mm);
        ui.end_row();
        let tip = "What a plain number of a DXF or OBJ file or a pixel measures; 0: what the file says";
        let mut unit = import.unit_mm.unwrap_or(0.0);
        or_usual(ui, ("Unit", tip), &mut unit, ("as in the file", " mm"), 0.0..=LARGEST_MM);
        import.unit_mm = (unit > 0.0).then_some(unit);
        ui.end_row();
        let tip = "Pictures: difference from the background, 0 to 255, from which a pixel is ink; -1: it is found";
        let mut level = import.threshold.map_or(-1.0, f64::from);
        or_usual(ui, ("Ink from", tip), &mut level, ("as found", ""), -1.0..=255.0);
        import.threshold = (level >= 0.0).then_some(level as u8);
        ui.end_row();
    });
}

/// One of a few, as buttons beside each other.
fn choice<T: PartialEq + Copy>(ui: &mut Ui, (name, tip): (&str, &str), value: &mut T, all: &[(T, &str)]) {
    ui.label(name).on_hover_text(tip);
    for (one, label) in all {
        let button = ui.selectable_value(value, *one, *label).on_hover_text(tip);
        button.accessible_name(format!("{name}: {label}"));
    }
}

/// A length that has a usual value, which -1 stands for.
fn optional(ui: &mut Ui, label: (&str, &str), value: &mut Option<f64>) {
    let mut shown = value.unwrap_or(-1.0);
    or_usual(ui, label, &mut shown, ("as usual", " mm"), -1.0..=LARGEST_MM);
    *value = (shown >= 0.0).then_some(shown);
}

/// A number whose least value stands for what is usual, and is shown as that in words.
fn or_usual(
    ui: &mut Ui,
    (name, tip): (&str, &str),
    value: &mut f64,
    (usual, unit): (&'static str, &'static str),
    range: RangeInclusive<f64>,
) {
    let least = *range.start();
    let label = ui.label(name).on_hover_text(tip);
    let shown = move |value: f64, decimals: RangeInclusive<usize>| match value {
        value if value <= least => usual.to_owned(),
        value => format!("{}{unit}", emath::format_with_decimals_in_range(value, decimals)),
    };
    let typed = move |text: &str| match text.trim() {
        text if text.is_empty() || text == usual => Some(least),
        text => text.trim_end_matches(unit.trim_start()).trim().parse().ok(),
    };
    let drag = DragValue::new(value).range(range).speed(1.0).custom_formatter(shown).custom_parser(typed);
    ui.add(drag).labelled_by(label.id).on_hover_text(tip);
}

/// An error as a sentence of its own.
fn sentence(error: &str) -> String {
    let mut letters = error.chars();
    letters.next().map_or_else(String::new, |first| format!("{}{}.", first.to_uppercase(), letters.as_str()))
}
