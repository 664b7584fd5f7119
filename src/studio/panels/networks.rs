//! The winch-tendon networks that are built in.

use super::discovery;
use super::panel::{Entry, Panel};
use super::widgets::{heading, name_field};
use super::{sewable, tendons};
use crate::operations::network::{Edit, Part};
use crate::picture::palette::Palette;
use crate::sewing::Breach;
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::Plushie;
use crate::studio::change::Change;
use crate::studio::commands::document::DELETE;
use crate::studio::icons::{self, Icon};
use crate::studio::session::{Renamed, Selection, Session};
use crate::studio::style;
use crate::studio::viewport::thumbnail::Thumbnails;
use eframe::egui::{Align, Button, Layout, RichText, ScrollArea, Sense, Ui, vec2};

pub static ENTRY: Entry = Entry {
    id: "panel.networks",
    label: "Networks",
    tip: "Winches and tendons: those that are built in, and proposals of more",
    make: || Box::new(Networks::default()),
};

#[derive(Default)]
struct Networks {
    thumbnails: Thumbnails,
}

impl Panel for Networks {
    fn show(&mut self, ui: &mut Ui, session: &Session, actions: &mut Actions) {
        let breaches = session.judging().breaches();
        ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
            show(ui, session, breaches, actions);
            ui.add_space(12.0);
            discovery::show(ui, session, &mut self.thumbnails, actions);
        });
    }
}

fn show(ui: &mut Ui, session: &Session, breaches: &[Breach], actions: &mut Actions) {
    heading(ui, "Winch-tendon networks");
    sewable::body(ui, breaches);
    let design = session.design();
    if design.networks.is_empty() {
        ui.label(RichText::new("None yet. Pose the plushie, then propose a network.").weak());
        return;
    }
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.y = 2.0;
        rows(ui, session, breaches, actions);
    });
}

fn rows(ui: &mut Ui, session: &Session, breaches: &[Breach], actions: &mut Actions) {
    let palette = Palette::of(session.look.theme);
    for (index, network) in session.design().networks.iter().enumerate() {
        if matches!(session.renaming(), Some((Renamed::Network(i), _)) if *i == index) {
            if let Some(name) = name_field(ui, session, "Network name", actions) {
                actions.push(Action::Change(Change::Network(Edit::Rename { winch: index, name })));
            }
            continue;
        }
        ui.horizontal(|ui| {
            let (chip, _) = ui.allocate_exact_size(vec2(12.0, 24.0), Sense::hover());
            ui.painter().circle_filled(chip.center(), 5.0, style::color32(palette.network(index, network)));
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let (name, tip) = (format!("Delete network {}", network.name), DELETE.hint("Delete this network"));
                if icons::small_button(ui, Icon::Trash, &name, &tip).clicked() {
                    actions.push(Action::Change(Change::Network(Edit::Remove(Part::Winch(index)))));
                }
                sewable::mark(ui, session.design(), index, breaches);
                // Both plushies have the same; a hidden one is not kept up to date.
                let views = session.look.views;
                let shapes = &session.solver.shapes;
                let newest = if views.shows(Plushie::Realizable) { &shapes.realizable } else { &shapes.idealized };
                let wound = newest.as_ref().and_then(|s| s.activations_mm.get(index));
                let detail = format!(
                    "{} tendon{}  {:>5.1} mm",
                    network.tendons.len(),
                    if network.tendons.len() == 1 { "" } else { "s" },
                    wound.copied().unwrap_or(0.0)
                );
                let button = Button::selectable(session.selection().network() == Some(index), &network.name)
                    .right_text(RichText::new(detail).small().weak())
                    .truncate()
                    .min_size(vec2(ui.available_width(), 24.0));
                let response = ui.add(button).accessible_name(format!("Network {}", network.name));
                let response = response.on_hover_text("Cable wound now. Double-click to rename");
                if response.double_clicked() {
                    actions.push(Action::Typed(Some((Renamed::Network(index), network.name.clone()))));
                } else if response.clicked() {
                    actions.push(Action::Select(Selection::Part(Part::Winch(index))));
                }
            });
        });
        if session.selection().network() == Some(index) {
            tendons::show(ui, session, index, actions);
        }
    }
}
