//! The panels on the right, one at a time, below their tabs.

use super::ALL;
use super::panel::{Entry, Panel};
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::Hit;
use crate::studio::commands;
use crate::studio::language::t;
use crate::studio::session::Session;
use eframe::egui::Ui;

/// The panels that were made.
pub struct State {
    panels: Vec<(&'static Entry, Box<dyn Panel>)>,
}

impl Default for State {
    fn default() -> Self {
        Self { panels: ALL.into_iter().map(|entry| (entry, (entry.make)())).collect() }
    }
}

pub fn show(ui: &mut Ui, session: &Session, state: &mut State, actions: &mut Actions) {
    let mut open = session.panel(&ALL.map(|entry| entry.id));
    ui.horizontal(|ui| {
        for command in commands::panels::ALL.iter() {
            let Some(entry) = ALL.into_iter().find(|entry| entry.id == command.id) else { continue };
            if ui.selectable_label(entry.id == open, t(entry.label)).on_hover_text(t(entry.tip)).clicked() {
                open = entry.id;
                actions.push(Action::Run(command, Hit::Nothing));
            }
        }
    });
    ui.separator();
    if let Some((_, panel)) = state.panels.iter_mut().find(|(entry, _)| entry.id == open) {
        panel.show(ui, session, actions);
    }
}
