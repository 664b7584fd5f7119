//! The row on top: files, undo, tools, what is shown, discovery, export.

use super::{accuracy, buttons, next};
use crate::design::bundled;
use crate::files;
use crate::studio::action::{Action, Actions, FileAction};
use crate::studio::canvas::Hit;
use crate::studio::commands::{self, Group, Place};
use crate::studio::language::t;
use crate::studio::session::Session;
use eframe::egui::{Align, Layout, RichText, Ui, menu};
use std::path::Path;

pub fn show(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        ui.add_space(4.0);
        file_menu(ui, session, actions);
        examples_menu(ui, actions);
        for of in [Group::File, Group::History, Group::Tools, Group::Shown, Group::Views] {
            group(ui, session, of, actions);
            gap(ui);
        }
        ui.add_enabled_ui(!session.sketching().open, |ui| accuracy::show(ui, session, actions));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add_space(4.0);
            ui.spacing_mut().item_spacing.x = 6.0;
            group(ui, session, Group::Right, actions);
            next::show(ui, session, actions);
        });
    });
}

fn group(ui: &mut Ui, session: &Session, of: Group, actions: &mut Actions) {
    for command in commands::at(Place::Toolbar(of)) {
        buttons::icon(ui, session, command, actions);
    }
}

fn gap(ui: &mut Ui) {
    ui.add_space(4.0);
    ui.separator();
    ui.add_space(4.0);
}

fn file_menu(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    menu::MenuButton::new(t("File")).ui(ui, |ui| {
        ui.set_min_width(190.0);
        for command in commands::at(Place::FileMenu) {
            buttons::entry(ui, session, command, Hit::Nothing, actions);
        }
        if session.recent().is_empty() {
            return;
        }
        ui.separator();
        ui.label(RichText::new(t("Recent")).weak());
        for path in session.recent() {
            let name = files::shown(path.file_name().map_or(path, Path::new));
            if ui.button(name).on_hover_text(files::shown(path)).clicked() {
                actions.push(Action::File(FileAction::OpenPath(path.clone())));
            }
        }
    });
}

fn examples_menu(ui: &mut Ui, actions: &mut Actions) {
    if bundled::ALL.is_empty() {
        return;
    }
    menu::MenuButton::new(t("Examples")).ui(ui, |ui| {
        ui.set_min_width(120.0);
        for (index, example) in bundled::ALL.iter().enumerate() {
            if ui.button(example.name).clicked() {
                actions.push(Action::File(FileAction::OpenExample(index)));
            }
        }
    });
}
