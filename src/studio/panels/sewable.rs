//! Which networks no hand can sew, as the list of them tells it.

use super::widgets::passing;
use crate::design::Design;
use crate::motion::winch_labels;
use crate::operations::network::Part;
use crate::sewing::{Breach, most_severe};
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::Hit;
use crate::studio::commands::tools;
use crate::studio::icons::{self, Icon};
use crate::studio::language::tf;
use crate::studio::session::Selection;
use crate::studio::tools::TENDON;
use eframe::egui::{Label, Rect, RichText, Role, Sense, Ui, Vec2, WidgetInfo, vec2};

/// Breaches that a tip tells one by one.
const TOLD: usize = 8;
/// Height of a mark: that of a row of the list, logical pixels.
const ROW: f32 = 24.0;
const MARK: f32 = 15.0;

/// A sign beside a network that breaks rules, with all of them in its tip; a press shows where, with the tool for it. Nothing where it keeps them.
pub fn mark(ui: &mut Ui, design: &Design, index: usize, breaches: &[Breach], actions: &mut Actions) {
    let own: Vec<Breach> = breaches.iter().filter(|b| b.winches().any(|winch| winch == index)).copied().collect();
    passing(ui, !own.is_empty(), |ui| {
        let (rect, response) = ui.allocate_exact_size(vec2(MARK, ROW), Sense::click());
        let label = tf!("Network {name} is hard to sew", name = design.networks[index].name);
        response.widget_info(|| WidgetInfo::labeled(Role::Button, true, &label));
        let square = Rect::from_center_size(rect.center(), Vec2::splat(MARK));
        ui.painter().extend(icons::draw(Icon::Warning, square, ui.visuals().warn_fg_color));
        if response.clicked() {
            actions.push(Action::Select(Selection::Part(Part::Winch(index))));
            actions.extend(tools::take(TENDON).map(|command| Action::Run(command, Hit::Nothing)));
        }
        // Asked for while the pointer is there alone.
        response.on_hover_ui(|ui| {
            let breaches = lines(&own, &winch_labels(design));
            ui.label(tf!("Hard to sew:\n{breaches}\nClick to see where, and to move holes by hand", breaches));
        });
    });
}

/// A line above the list where it is the body that no winch fits into.
pub fn body(ui: &mut Ui, breaches: &[Breach]) {
    let thin = breaches.iter().find(|b| b.winches().next().is_none());
    passing(ui, thin.is_some(), |ui| {
        if let Some(thin) = thin {
            ui.add(
                Label::new(RichText::new(tf!("Hard to sew: {thin}.", thin)).color(ui.visuals().warn_fg_color)).wrap(),
            );
        }
    });
}

/// The most severe breaches, a line each, and how many others there are.
fn lines(breaches: &[Breach], names: &[String]) -> String {
    let mut lines: Vec<String> = most_severe(breaches, TOLD).iter().map(|b| b.words(names).to_string()).collect();
    if breaches.len() > TOLD {
        lines.push(tf!("and {count} more", count = breaches.len() - TOLD));
    }
    lines.join("\n")
}
