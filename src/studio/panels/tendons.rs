//! The tendons of the network that is selected, and to which winches they can be given.

use crate::design::Design;
use crate::operations::network::{Edit, Part};
use crate::outline::polygon;
use crate::studio::action::{Action, Actions};
use crate::studio::change::Change;
use crate::studio::icons::{self, Icon};
use crate::studio::language::{t, tf, tn};
use crate::studio::session::{Selection, Session};
use eframe::egui::{Align, Button, Layout, RichText, Ui, menu, vec2};

/// A row for each tendon of a network.
pub fn show(ui: &mut Ui, session: &Session, winch: usize, actions: &mut Actions) {
    let design = session.design();
    let Some(network) = design.networks.get(winch) else { return };
    for tendon in 0..network.tendons.len() {
        let part = Part::Tendon(winch, tendon);
        ui.horizontal(|ui| {
            ui.add_space(18.0);
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                ui.spacing_mut().item_spacing.x = 2.0;
                let name = tf!("Delete tendon {tendon} of {name}", tendon = tendon + 1, name = network.name);
                if icons::small_button(ui, Icon::Trash, &name, t("Take this tendon out")).clicked() {
                    actions.push(Action::Change(Change::Network(Edit::Remove(part))));
                }
                if network.tendons.len() > 1 || design.networks.len() > 1 {
                    let button = menu::MenuButton::from_button(Button::new(t("Give…")).small());
                    let (response, _) = button.ui(ui, |ui| {
                        ui.set_min_width(150.0);
                        hand_over(ui, session, part, actions);
                        if network.tendons.len() > 1 && ui.button(t("A winch of its own")).clicked() {
                            let edit = Edit::Split { winch, tendons: vec![tendon], at: None };
                            actions.push(Action::Change(Change::Network(edit)));
                        }
                    });
                    let name = tf!("Give tendon {tendon} of {name}", tendon = tendon + 1, name = network.name);
                    response.accessible_name(name).on_hover_text(t("Give this tendon to another winch"));
                }
                let selected = session.selection() == Selection::Part(part)
                    || matches!(session.selection(), Selection::Part(Part::Hole(w, t, _)) if (w, t) == (winch, tendon));
                let button = Button::selectable(selected, tf!("Tendon {tendon}", tendon = tendon + 1))
                    .right_text(RichText::new(detail(design, winch, tendon)).small().weak())
                    .truncate()
                    .min_size(vec2(ui.available_width(), 22.0));
                let response = ui.add(button).accessible_name(tf!(
                    "Tendon {tendon} of {name}",
                    tendon = tendon + 1,
                    name = network.name
                ));
                if response.on_hover_text(t("Holes between winch and end, and length at rest")).clicked() {
                    actions.push(Action::Select(Selection::Part(part)));
                }
            });
        });
    }
}

fn detail(design: &Design, winch: usize, tendon: usize) -> String {
    let routing = &design.networks[winch].tendons[tendon].routing;
    let places: Vec<_> = routing.iter().map(|point| point.place(&design.mesh.nodes)).collect();
    let length: f64 = places.windows(2).map(|ends| polygon::length(ends[0], ends[1])).sum();
    let holes = tn!(holes = routing.len().saturating_sub(2), "{holes} hole", "{holes} holes");
    format!("{holes}  {length:.0} mm")
}

/// Entries of a menu: the winches that a tendon can be given to.
pub fn hand_over(ui: &mut Ui, session: &Session, part: Part, actions: &mut Actions) {
    let (winch, Some(tendon)) = (part.winch(), part.tendon()) else { return };
    for (to, network) in session.design().networks.iter().enumerate().filter(|(to, _)| *to != winch) {
        if ui.button(tf!("Give to {name}", name = network.name)).clicked() {
            actions.push(Action::Change(Change::Network(Edit::HandOver { winch, tendon, to })));
            ui.close();
        }
    }
}
