//! The choice between speed and accuracy, and what each choice means.

use super::Actions;
use crate::engine::Quality;
use crate::studio::action::Action;
use crate::studio::session::Session;
use eframe::egui::{ComboBox, RichText, Ui};

/// From the fastest to the most accurate.
pub const ALL: [Quality; 3] = [Quality::Draft, Quality::Balanced, Quality::Accurate];

pub fn name(quality: Quality) -> &'static str {
    match quality {
        Quality::Draft => "Draft",
        Quality::Balanced => "Balanced",
        Quality::Accurate => "Accurate",
    }
}

/// The next one, round and round.
pub fn after(quality: Quality) -> Quality {
    match quality {
        Quality::Draft => Quality::Balanced,
        Quality::Balanced => Quality::Accurate,
        Quality::Accurate => Quality::Draft,
    }
}

/// What it does and what it costs.
fn explain(quality: Quality) -> String {
    let what = match quality {
        Quality::Draft => "least delay; the shape may trail the hand",
        Quality::Balanced => "follows the hand as closely as can be seen",
        Quality::Accurate => "every frame is worked out to the end; large bodies may follow in jerks",
    };
    format!("{}: up to {} iterations a frame; {what}", name(quality), quality.frame_iterations())
}

/// The selector, for the toolbar.
pub fn show(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let mut quality = session.quality;
    let label = ui.label(RichText::new("Quality").weak());
    ui.add_space(3.0);
    let combo = ComboBox::from_id_salt("quality").selected_text(name(quality)).width(84.0).show_ui(ui, |ui| {
        for choice in ALL {
            ui.selectable_value(&mut quality, choice, name(choice)).on_hover_text(explain(choice));
        }
    });
    let choices = ALL.map(explain).join("\n");
    let tip = format!(
        "Quality: how much work a frame may take while the hand moves (Q for the next)\n\n{choices}\n\nWhen the hand rests, \
         the shape is refined to equilibrium with any of them."
    );
    combo.response.labelled_by(label.id).on_hover_text(tip);
    if quality != session.quality {
        actions.push(Action::SetQuality(quality));
    }
}
