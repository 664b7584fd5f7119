//! The line at the bottom: what is shown, how far it is from its targets, what the solver says.

use crate::studio::session::{Mode, Session, Tool};
use eframe::egui::{Align, Layout, RichText, Ui};

pub fn show(ui: &mut Ui, session: &Session) {
    ui.horizontal_centered(|ui| {
        ui.add_space(6.0);
        let small = |text: String| RichText::new(text).small();
        if let Some(working) = session.files.working {
            ui.label(small(format!("{working}…")).strong());
        } else if let Some(warning) = session.solver_warning() {
            ui.label(small(warning.to_owned()).color(ui.visuals().warn_fg_color));
        } else {
            ui.label(small(hint(session).to_owned()).weak());
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.add_space(6.0);
            let solving = if session.is_settled() { "" } else { "solving…    " };
            ui.label(small(format!("{solving}{}", figures(session))).weak()).on_hover_text(
                "Pose error of both plushies (rms distance of the targets in body lengths), and how long the solver took",
            );
        });
    });
}

fn hint(session: &Session) -> &'static str {
    match (session.mode, session.tool) {
        (Mode::Animation, _) => "Showing the animation. Escape, or choosing a pose, returns to posing",
        (Mode::Pose, Tool::Pin) => "Click the body to pin it, click a pin to remove it",
        (Mode::Pose, Tool::Drag) => "Drag the body to pose it. Right-click for pins and targets",
    }
}

fn figures(session: &Session) -> String {
    let part = |name: &str, shape: &Option<std::sync::Arc<crate::engine::Shape>>| {
        shape.as_ref().map(|s| {
            if session.targets().is_empty() {
                format!("{name} {:.0} ms", s.milliseconds)
            } else {
                format!("{name} {:.1} %, {:.0} ms", 100.0 * s.target_error, s.milliseconds)
            }
        })
    };
    let parts = [part("idealized", &session.shapes.idealized), part("realizable", &session.shapes.realizable)];
    parts.into_iter().flatten().collect::<Vec<_>>().join("    ")
}
