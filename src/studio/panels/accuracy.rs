//! The choice between speed and accuracy, and what each choice means.

use crate::engine::Quality;
use crate::studio::action::{Action, Actions};
use crate::studio::commands::view::QUALITY;
use crate::studio::language::{t, tf};
use crate::studio::session::Session;
use eframe::egui::{Button, ComboBox, RichText, Ui, vec2};

pub fn name(quality: Quality) -> &'static str {
    match quality {
        Quality::Draft => t("Draft"),
        Quality::Balanced => t("Balanced"),
        Quality::Accurate => t("Accurate"),
    }
}

/// What it costs and what it does.
fn explain(quality: Quality) -> &'static str {
    match quality {
        Quality::Draft => t("a part of the work of Balanced; least delay, trails fast moves"),
        Quality::Balanced => t("a bounded amount of work a frame; follows the hand"),
        Quality::Accurate => t("until nothing moves any more; large bodies may jerk"),
    }
}

/// Width of the list of choices, logical pixels.
const WIDTH: f32 = 400.0;

/// The selector, for the toolbar.
pub fn show(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let mut quality = session.solver.quality;
    let label = ui.label(RichText::new(t("Quality")).weak());
    ui.add_space(3.0);
    let combo = ComboBox::from_id_salt("quality").selected_text(name(quality)).width(84.0).show_ui(ui, |ui| {
        for choice in Quality::ALL {
            let detail = RichText::new(explain(choice)).small().weak();
            let button = Button::selectable(choice == quality, name(choice)).right_text(detail);
            if ui.add(button.min_size(vec2(WIDTH, 24.0))).accessible_name(name(choice)).clicked() {
                quality = choice;
            }
        }
    });
    let choices = Quality::ALL.map(|choice| format!("{}: {}", name(choice), explain(choice)));
    let tip = tf!(
        "Quality: how much work a frame may take while the hand moves ({keys} for the next)\n\n{choices}\n\nWhen the hand rests, the \
         shape is refined to equilibrium with any of them.",
        keys = QUALITY.keys_text(),
        choices = choices.join("\n")
    );
    combo.response.labelled_by(label.id).on_hover_text(tip);
    if quality != session.solver.quality {
        actions.push(Action::SetQuality(quality));
    }
}
