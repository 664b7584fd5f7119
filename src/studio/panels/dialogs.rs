//! Dialogs over the window: unsaved changes, and paths where the desktop has no dialogs of its own.

use super::blueprint_parts::parts_and_sheets;
use super::blueprint_preview;
use super::widgets::{dialog_frame, passing, primary, scroll, sentence};
use super::{film, import};
use crate::files::shown;
use crate::motion::{TooFast, families};
use crate::operations::export;
use crate::studio::action::{Action, Actions, FileAction};
use crate::studio::keeper::Abandoned;
use crate::studio::language::{t, tf, tn};
use crate::studio::session::Session;
use crate::studio::session::{Dialog, PathDialog, Purpose, Why};
use crate::studio::words;
use eframe::egui::{Align, Context, Id, Key, Layout, Modal, RichText, TextEdit, Ui};
use std::path::Path;

/// Height of the export's dialog around its settings, and the least of these, logical pixels.
const AROUND: f32 = 270.0;
const LEAST: f32 = 120.0;

/// What dialogs keep from frame to frame.
#[derive(Default)]
pub struct State {
    preview: blueprint_preview::State,
}

pub fn show(ctx: &Context, session: &Session, state: &mut State, actions: &mut Actions) {
    let Some(dialog) = &session.files.dialog else { return };
    let is_import = matches!(dialog, Dialog::Path(dialog) if dialog.purpose == Purpose::Import);
    let is_export = matches!(dialog, Dialog::Path(dialog) if dialog.purpose == Purpose::Export);
    // Each kind remembers a size of its own: a short question does not get the room of a long one.
    let modal = Modal::new(Id::unique(("dialog", kind(dialog)))).frame(dialog_frame(ctx)).show(ctx, |ui| {
        ui.set_width(if is_import || is_export { 560.0 } else { 430.0 });
        match dialog {
            Dialog::Unsaved(_) => unsaved(ui, session, actions),
            Dialog::Path(dialog) => path(ui, session, dialog, state, actions),
            Dialog::Replace(path, why) => replace(ui, path, *why, actions),
            Dialog::Recover => recover(ui, session, actions),
        }
    });
    if modal.should_close() {
        actions.push(Action::File(FileAction::CloseDialog));
    }
}

/// What tells dialogs apart that need different room.
fn kind(dialog: &Dialog) -> u8 {
    match dialog {
        Dialog::Unsaved(_) => 0,
        Dialog::Replace(_, why) => 1 + *why as u8,
        Dialog::Recover => 9,
        Dialog::Path(dialog) => 10 + dialog.purpose as u8,
    }
}

fn unsaved(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ui.heading(tf!("Save changes to “{name}”?", name = session.design().name));
    ui.label(t("Without saving they are lost."));
    ui.add_space(10.0);
    answers(ui, |ui| {
        if primary(ui, true, t("Save changes"), 120.0).clicked() {
            actions.push(Action::File(FileAction::SaveAndGoOn));
        }
        if ui.button(t("Discard changes")).clicked() {
            actions.push(Action::File(FileAction::DiscardAndGoOn));
        }
        if ui.button(t("Cancel")).clicked() {
            actions.push(Action::File(FileAction::CloseDialog));
        }
    });
}

fn replace(ui: &mut Ui, path: &Path, why: Why, actions: &mut Actions) {
    let name = shown(path.file_name().map_or(path, Path::new));
    let (heading, text) = match why {
        Why::Exists => {
            (tf!("Replace “{name}”?", name), t("Another plushie has that name. What is in its file is lost then."))
        }
        Why::Foreign => (tf!("Replace “{name}”?", name), t("That file is no plushie. What is in it is lost then.")),
        Why::Changed => (
            tf!("“{name}” was changed by another program", name),
            t(
                "It is not what was opened here any more. Replacing it loses those changes; saving under another name keeps both.",
            ),
        ),
    };
    ui.heading(heading);
    ui.label(text);
    ui.add_space(10.0);
    answers(ui, |ui| {
        if primary(ui, true, t("Save under another name"), 180.0).clicked() {
            actions.push(Action::File(FileAction::SaveAs));
        }
        if ui.button(t("Replace it")).clicked() {
            actions.push(Action::File(FileAction::ReplacePath(path.to_owned())));
        }
        if ui.button(t("Cancel")).clicked() {
            actions.push(Action::File(FileAction::CloseDialog));
        }
    });
}

fn recover(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let Some(work) = session.offered() else { return };
    ui.heading(tf!("Recover “{name}”?", name = work.design.name));
    ui.label(left_behind(work));
    ui.add_space(10.0);
    answers(ui, |ui| {
        if primary(ui, true, t("Recover"), 100.0).clicked() {
            actions.push(Action::File(FileAction::Recover));
        }
        if ui.button(t("Discard it")).clicked() {
            actions.push(Action::File(FileAction::DiscardWork));
        }
        if ui.button(t("Not now")).clicked() {
            actions.push(Action::File(FileAction::RecoverLater));
        }
    });
}

/// How work was left behind, when, and whose it is.
pub(super) fn left_behind(work: &Abandoned) -> String {
    let ago = work
        .at
        .elapsed()
        .map_or_else(|_| String::new(), |ago| tf!(" It was changed {ago} ago.", ago = spoken(ago.as_secs())));
    let from = work.facts.path.as_deref().map_or_else(
        || t("It has no file yet.").to_owned(),
        |path| tf!("It belongs to {path}, which is as it was.", path = shown(path)),
    );
    tf!("Plushwright ended before this plushie was saved.{ago} {from}", ago, from)
}

/// How long something took, in the largest unit that fits.
fn spoken(seconds: u64) -> String {
    match seconds {
        0..=119 => tn!(count = seconds, "{count} second", "{count} seconds"),
        120..=7199 => tn!(count = seconds / 60, "{count} minute", "{count} minutes"),
        7200..=172_799 => tn!(count = seconds / 3600, "{count} hour", "{count} hours"),
        _ => tn!(count = seconds / 86_400, "{count} day", "{count} days"),
    }
}

fn path(ui: &mut Ui, session: &Session, dialog: &PathDialog, state: &mut State, actions: &mut Actions) {
    let mut edited = dialog.clone();
    ui.heading(dialog.purpose.title());
    ui.add_space(6.0);
    let mut confirmed = false;
    ui.horizontal(|ui| {
        let width = ui.available_width() - if session.files.native_dialogs { 84.0 } else { 0.0 };
        let hint = match dialog.purpose {
            Purpose::Open | Purpose::SaveAs => t("Path of a .plush file"),
            Purpose::Import => t("Path of a drawing (SVG, PDF, DXF), picture, flat mesh or drawing of parts"),
            Purpose::Export => t("Path of a new folder"),
            Purpose::Film => t("Path of a new *.gif, *.html or folder"),
        };
        let field = ui.add(TextEdit::singleline(&mut edited.path).hint_text(hint).desired_width(width));
        let field = field.accessible_name(t("Path"));
        confirmed = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        if ui.memory(|m| m.focused().is_none()) {
            field.request_focus();
        }
        if session.files.native_dialogs && ui.button(t("Browse…")).clicked() {
            actions.push(Action::File(FileAction::Browse));
        }
    });
    if dialog.purpose == Purpose::Import {
        import::settings(ui, session, &mut edited);
    }
    if dialog.purpose == Purpose::Export {
        // What answers the dialog stays in the window, whatever is open above it.
        let most = (ui.ctx().content_rect().height() - AROUND).max(LEAST);
        scroll(most).id_salt("settings of the export").show(ui, |ui| {
            export_settings(ui, &mut edited.export);
            passing(ui, true, |ui| blueprint_preview::show(ui, session, &dialog.export, &mut state.preview, actions));
        });
    }
    if dialog.purpose == Purpose::Film {
        film::settings(ui, &mut edited);
    }
    let path = Path::new(edited.path.trim());
    let is_known = path.exists() && !path.is_dir();
    let is_wrong = !is_known && !path.is_dir() && !path.as_os_str().is_empty();
    let note = match dialog.purpose {
        Purpose::Export => t(
            "Patterns to cut and to print on A4 or Letter paper, routings, winches, programs for motors and a guide. The folder \
               appears whole or not at all.",
        ),
        Purpose::SaveAs if path.is_file() && session.document.path.as_deref() != Some(path) => t("This file exists."),
        Purpose::Open | Purpose::Import if is_wrong => t("There is no such file."),
        Purpose::Film if path.is_file() => t("This file exists and is replaced."),
        Purpose::Import => t("The filled shapes of the drawing are joined to one silhouette."),
        _ => "",
    };
    ui.label(RichText::new(note).small().weak());
    passing(ui, dialog.trouble.is_some(), |ui| {
        let trouble = dialog.trouble.as_deref().map(sentence).unwrap_or_default();
        ui.label(RichText::new(trouble).color(ui.visuals().error_fg_color));
    });
    ui.add_space(10.0);
    answers(ui, |ui| {
        let verb = dialog.purpose.verb();
        let ready = match dialog.purpose {
            Purpose::Open | Purpose::Import => is_known,
            Purpose::SaveAs | Purpose::Export | Purpose::Film => !edited.path.trim().is_empty(),
        };
        if (primary(ui, ready, verb, 100.0).clicked() || confirmed) && ready {
            actions.push(Action::File(edited.confirm()));
        }
        if ui.button(t("Cancel")).clicked() {
            actions.push(Action::File(FileAction::CloseDialog));
        }
    });
    if edited != *dialog {
        edited.trouble = None;
        // Before anything that closes the dialog.
        actions.insert(0, Action::File(FileAction::EditDialog(edited)));
    }
}

/// The buttons that end a dialog, the one that matters most on the right. As high as they are: a dialog that was higher before shrinks to them.
fn answers(ui: &mut Ui, add: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| ui.with_layout(Layout::right_to_left(Align::Center), add));
}

fn export_settings(ui: &mut Ui, options: &mut export::Options) {
    let mut stretch = options.too_fast == TooFast::Stretch;
    let tip = t("Give the animation more time where its motors are too slow for it; otherwise it is refused");
    ui.checkbox(&mut stretch, t(words::STRETCH)).on_hover_text(tip);
    options.too_fast = if stretch { TooFast::Stretch } else { TooFast::Refuse };
    parts_and_sheets(ui, options);
    ui.collapsing(t("Controllers"), |ui| {
        ui.label(t("Programs for these; none chosen: for all that can play the motion"));
        for family in families::ALL {
            let at = options.controllers.iter().position(|name| name == family.name);
            let mut chosen = at.is_some();
            if ui.checkbox(&mut chosen, family.name).on_hover_text(t(family.title)).changed() {
                match at {
                    Some(at) => drop(options.controllers.remove(at)),
                    None => options.controllers.push(family.name.into()),
                }
            }
        }
    });
}
