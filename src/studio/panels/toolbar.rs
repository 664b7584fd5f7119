//! The row on top: files, undo, tools, what is shown, discovery, export.

use super::{Actions, quality};
use crate::design::bundled;
use crate::files;
use crate::picture::LAYERS;
use crate::picture::layers::Switch;
use crate::picture::palette::Theme;
use crate::studio::action::{Action, FileAction};
use crate::studio::icons::{self, Icon};
use crate::studio::session::{Session, Tool};
use crate::studio::sketching::Sketch;
use crate::studio::viewport::Plushie;
use eframe::egui::{Align, Button, Layout, RichText, Ui, menu};
use std::path::Path;

pub fn show(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ui.horizontal_centered(|ui| {
        ui.spacing_mut().item_spacing.x = 3.0;
        ui.add_space(4.0);
        file_menu(ui, session, actions);
        examples_menu(ui, actions);
        let save = ui.button("Save").on_hover_text("Save the plushie (Ctrl+S)");
        if save.clicked() {
            actions.push(Action::File(FileAction::Save));
        }
        gap(ui);
        undo_redo(ui, session, actions);
        gap(ui);
        tools(ui, session, actions);
        gap(ui);
        shown(ui, session, actions);
        gap(ui);
        ui.add_enabled_ui(!session.sketching().open, |ui| {
            views(ui, session, actions);
            gap(ui);
            quality::show(ui, session, actions);
        });
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add_space(4.0);
            theme(ui, session, actions);
            ui.add_space(6.0);
            let export = ui.button("Export").on_hover_text("Write patterns, routings and winch tracks (Ctrl+E)");
            if export.clicked() {
                actions.push(Action::File(FileAction::Export));
            }
        });
    });
}

fn gap(ui: &mut Ui) {
    ui.add_space(4.0);
    ui.separator();
    ui.add_space(4.0);
}

fn file_menu(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let entries = [
        ("New from outline…", "Ctrl+N", FileAction::Import),
        ("New drawing", "Ctrl+Shift+O", FileAction::NewDrawing),
        ("Open…", "Ctrl+O", FileAction::Open),
        ("Save", "Ctrl+S", FileAction::Save),
        ("Save as…", "Ctrl+Shift+S", FileAction::SaveAs),
        ("Export…", "Ctrl+E", FileAction::Export),
        ("Quit", "Ctrl+Q", FileAction::Quit),
    ];
    menu::MenuButton::new("File").ui(ui, |ui| {
        ui.set_min_width(190.0);
        for (name, shortcut, action) in entries {
            if ui.add(Button::new(name).shortcut_text(RichText::new(shortcut).weak())).clicked() {
                actions.push(Action::File(action));
            }
        }
        if session.recent().is_empty() {
            return;
        }
        ui.separator();
        ui.label(RichText::new("Recent").weak());
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
    menu::MenuButton::new("Examples").ui(ui, |ui| {
        ui.set_min_width(120.0);
        for (index, example) in bundled::ALL.iter().enumerate() {
            if ui.button(example.name).clicked() {
                actions.push(Action::File(FileAction::OpenExample(index)));
            }
        }
    });
}

fn undo_redo(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let tip = |verb: &str, label: Option<&str>, shortcut: &str| match label {
        Some(label) => format!("{verb} “{label}” ({shortcut})"),
        None => format!("Nothing to {} ({shortcut})", verb.to_lowercase()),
    };
    let (undo, redo) = (session.history.undo_label(), session.history.redo_label());
    ui.add_enabled_ui(undo.is_some(), |ui| {
        if icons::button(ui, Icon::Undo, "Undo", &tip("Undo", undo, "Ctrl+Z")).clicked() {
            actions.push(Action::Undo);
        }
    });
    ui.add_enabled_ui(redo.is_some(), |ui| {
        if icons::button(ui, Icon::Redo, "Redo", &tip("Redo", redo, "Ctrl+Shift+Z or Ctrl+Y")).clicked() {
            actions.push(Action::Redo);
        }
    });
}

fn tools(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let tools = [
        (Tool::Drag, Icon::Hand, "Drag tool", "Drag points of the body; every drag makes or moves a target (V)"),
        (Tool::Pin, Icon::Pin, "Pin tool", "Click the body to pin it there, click a pin to remove it (P)"),
    ];
    let open = session.sketching().open;
    ui.add_enabled_ui(!open, |ui| {
        for (tool, icon, name, tip) in tools {
            if icons::toggle(ui, icon, name, tip, session.tool == tool && !open).clicked() {
                actions.push(Action::SetTool(tool));
            }
        }
    });
    let tip = "Draw the outline, change its points, build it from parts (O)";
    if icons::toggle(ui, Icon::Pen, "Edit outline", tip, open).clicked() {
        actions.push(Action::Sketch(Sketch::Open(!open)));
    }
}

fn shown(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    if icons::button(
        ui,
        Icon::Fit,
        "Fit view",
        "Fit the body into the views (F). Scroll to zoom, drag beside the body to pan",
    )
    .clicked()
    {
        actions.push(Action::Fit);
    }
    ui.add_enabled_ui(!session.sketching().open, |ui| {
        for layer in LAYERS {
            if let Some(switch) = layer.switch {
                toggle_layer(ui, session, layer.name, &switch, actions);
            }
        }
    });
}

/// The button of a layer of the pictures; where it cannot be shown, its tip says why.
fn toggle_layer(ui: &mut Ui, session: &Session, name: &'static str, switch: &Switch, actions: &mut Actions) {
    let cannot = session.cannot_show(name);
    let key = switch.key.map_or(String::new(), |key| format!(" ({key})"));
    let tip = cannot.map_or_else(|| format!("{}{key}", switch.tip), str::to_owned);
    ui.add_enabled_ui(cannot.is_none(), |ui| {
        let shown = session.look.shown.shows(name);
        if icons::toggle(ui, Icon::Layer(switch.icon), switch.label, &tip, shown && cannot.is_none()).clicked() {
            actions.push(Action::ShowLayer(name, !shown));
        }
    });
}

fn views(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let idealized = "Show the idealized plushie (1). Hidden, it is not solved and costs nothing";
    let realizable = "Show the realizable plushie (2). Hidden, it is not solved; only where the fibres build on winches these \
                      are still wound";
    for (plushie, icon, name, tip) in [
        (Plushie::Idealized, Icon::LeftView, "Show idealized view", idealized),
        (Plushie::Realizable, Icon::RightView, "Show realizable view", realizable),
    ] {
        let shown = session.look.views.shows(plushie);
        if icons::toggle(ui, icon, name, tip, shown).clicked() {
            actions.push(Action::ShowView(plushie, !shown));
        }
    }
}

fn theme(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let (icon, name, other) = match session.look.theme {
        Theme::Light => (Icon::Moon, "Dark theme", Theme::Dark),
        Theme::Dark => (Icon::Sun, "Light theme", Theme::Light),
    };
    if icons::button(ui, icon, name, &format!("Switch to the {} (T)", name.to_lowercase())).clicked() {
        actions.push(Action::SetTheme(other));
    }
}
