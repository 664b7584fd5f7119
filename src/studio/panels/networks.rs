//! The winch-tendon networks that are built in.

use super::discovery;
use super::gallery::Gallery;
use super::panel::{Entry, Panel};
use super::widgets::{heading, name_field};
use super::{buttons, sewable, tendons, winding};
use crate::numbers;
use crate::operations::network::{Edit, Part};
use crate::picture::Color;
use crate::picture::palette::Palette;
use crate::sewing::Breach;
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::Plushie;
use crate::studio::change::Change;
use crate::studio::commands::document::DELETE;
use crate::studio::commands::networks::{DOWN, MUTE, SOLO, UP};
use crate::studio::icons::{self, Icon};
use crate::studio::language::{t, tf, tn};
use crate::studio::session::{Renamed, Selection, Session};
use crate::studio::style;
use crate::studio::viewport::thumbnail::Thumbnails;
use eframe::egui::{
    Align, Button, Color32, Layout, Popup, RichText, Role, ScrollArea, Sense, Stroke, Ui, WidgetInfo, vec2,
};

pub static ENTRY: Entry = Entry {
    id: "panel.networks",
    label: "Networks",
    tip: "Winches and tendons: those that are built in, and proposals of more",
    make: || Box::new(Networks::default()),
};

#[derive(Default)]
struct Networks {
    thumbnails: Thumbnails,
    gallery: Gallery,
}

impl Panel for Networks {
    fn show(&mut self, ui: &mut Ui, session: &Session, actions: &mut Actions) {
        let breaches = session.judging().breaches();
        ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
            show(ui, session, breaches, actions);
            winding::show(ui, session, actions);
            ui.add_space(12.0);
            discovery::show(ui, session, &mut self.thumbnails, &mut self.gallery, actions);
        });
    }
}

fn show(ui: &mut Ui, session: &Session, breaches: &[Breach], actions: &mut Actions) {
    heading(ui, t("Winch-tendon networks"));
    sewable::body(ui, breaches);
    let design = session.design();
    if design.networks.is_empty() {
        ui.label(RichText::new(t("None yet. Pose the plushie, then propose a network.")).weak());
        return;
    }
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.y = 2.0;
        rows(ui, session, breaches, actions);
    });
}

fn rows(ui: &mut Ui, session: &Session, breaches: &[Breach], actions: &mut Actions) {
    for (index, network) in session.design().networks.iter().enumerate() {
        if matches!(session.renaming(), Some((Renamed::Network(i), _)) if *i == index) {
            if let Some(name) = name_field(ui, session, t("Network name"), actions) {
                actions.push(Action::Change(Change::Network(Edit::Rename { winch: index, name })));
            }
            continue;
        }
        ui.horizontal(|ui| {
            chip(ui, session, index, actions);
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let (name, tip) =
                    (tf!("Delete network {name}", name = network.name), DELETE.hint(t("Delete this network")));
                if icons::small_button(ui, Icon::Trash, &name, &tip).clicked() {
                    actions.push(Action::Change(Change::Network(Edit::Remove(Part::Winch(index)))));
                }
                sewable::mark(ui, session.design(), index, breaches, actions);
                // Both plushies have the same; a hidden one is not kept up to date.
                let views = session.look.views;
                let shapes = &session.solver.shapes;
                let newest = if views.shows(Plushie::Realizable) { &shapes.realizable } else { &shapes.idealized };
                let wound = newest.as_ref().and_then(|s| s.activations_mm.get(index));
                let wound = match network.muted {
                    true => t("off").to_owned(),
                    false => format!("{:>5} mm", numbers::plain(wound.copied().unwrap_or(0.0), 1)),
                };
                let tendons = network.tendons.len();
                let detail = format!("{}  {wound}", tn!(tendons, "{tendons} tendon", "{tendons} tendons"));
                let button = Button::selectable(session.selection().network() == Some(index), &network.name)
                    .right_text(RichText::new(detail).small().weak())
                    .truncate()
                    .min_size(vec2(ui.available_width(), 24.0));
                let response = ui.add(button).accessible_name(tf!("Network {name}", name = network.name));
                let response = response.on_hover_text(t("Cable wound now. Double-click to rename"));
                if response.double_clicked() {
                    actions.push(Action::Typed(Some((Renamed::Network(index), network.name.clone()))));
                } else if response.clicked() {
                    actions.push(Action::Select(Selection::Part(Part::Winch(index))));
                }
            });
        });
        if session.selection().network() == Some(index) {
            strip(ui, session, actions);
            tendons::show(ui, session, index, actions);
        }
    }
}

/// The colour of a network's cables, which a click changes.
fn chip(ui: &mut Ui, session: &Session, index: usize, actions: &mut Actions) {
    let network = &session.design().networks[index];
    let color = style::color32(Palette::of(session.look.theme).network(index, network));
    let (rect, response) = ui.allocate_exact_size(vec2(12.0, 24.0), Sense::click());
    let name = tf!("Colour of {name}", name = network.name);
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
    let radius = if response.hovered() || response.has_focus() { 6.5 } else { 5.0 };
    if network.muted {
        ui.painter().circle_stroke(rect.center(), radius - 0.75, Stroke::new(1.5, color));
    } else {
        ui.painter().circle_filled(rect.center(), radius, color);
    }
    let response = response.on_hover_text(t("Colour of its cables in pictures"));
    Popup::menu(&response).show(|ui| colors(ui, session, index, actions));
}

/// What can be done to the network that is selected.
fn strip(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ui.horizontal(|ui| {
        ui.add_space(18.0);
        ui.spacing_mut().item_spacing.x = 4.0;
        buttons::text(ui, session, &MUTE, actions);
        buttons::choice(ui, session, &SOLO, actions);
        buttons::text(ui, session, &UP, actions);
        buttons::text(ui, session, &DOWN, actions);
    });
}

fn colors(ui: &mut Ui, session: &Session, winch: usize, actions: &mut Actions) {
    let mut choose = |ui: &mut Ui, color| {
        actions.push(Action::Change(Change::Network(Edit::Color { winch, color })));
        ui.close();
    };
    ui.horizontal(|ui| {
        for (number, &Color(red, green, blue, _)) in Palette::of(session.look.theme).winches().iter().enumerate() {
            let (rect, response) = ui.allocate_exact_size(vec2(20.0, 20.0), Sense::click());
            let name = tf!("Colour {number}", number = number + 1);
            response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &name));
            let radius = if response.hovered() || response.has_focus() { 9.0 } else { 7.5 };
            ui.painter().circle_filled(rect.center(), radius, Color32::from_rgb(red, green, blue));
            if response.clicked() {
                choose(ui, Some([red, green, blue]));
            }
        }
    });
    if ui.button(t("By its number")).clicked() {
        choose(ui, None);
    }
}
