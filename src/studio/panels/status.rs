//! The lines at the bottom: what can be done, what the solver is at, and for each view what its shape cost and is worth.

use super::accuracy;
use crate::engine::{EQUILIBRIUM, NEAR_EQUILIBRIUM, Shape, Warning};
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::{Hit, Plushie};
use crate::studio::commands::command::Scope;
use crate::studio::commands::files::STOP;
use crate::studio::language::{t, tf};
use crate::studio::session::{Mode, Session};
use crate::studio::tools::{PULL, taken};
use eframe::egui::{Align, Color32, FontId, Label, Layout, RichText, Ui, vec2};

/// Height of both lines, logical pixels.
pub const HEIGHT: f32 = 40.0;

pub fn show(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ui.spacing_mut().item_spacing = vec2(0.0, 0.0);
    ui.add_space(2.0);
    let weak = ui.visuals().weak_text_color();
    let warn = ui.visuals().warn_fg_color;
    let (text, color) = if let Some(working) = session.working() {
        let at = session.working_at().map_or_else(String::new, |[done, of]| tf!(", {done} of {of}", done, of));
        (format!("{working}{at}…"), ui.visuals().strong_text_color())
    } else if let Some(warning) = session.solver_warning() {
        (warning.to_owned(), warn)
    } else {
        (hint(session).to_owned(), weak)
    };
    let stops = session.can_stop().then_some(&mut *actions);
    line(ui, session, Plushie::Idealized, (text, color), stops);
    line(ui, session, Plushie::Realizable, (state(session), weak), None);
}

/// A line: words on the left as far as they fit, and what stops the work; the figures of a view on the right, each in a place of its own.
fn line(
    ui: &mut Ui,
    session: &Session,
    plushie: Plushie,
    (words, color): (String, Color32),
    stops: Option<&mut Actions>,
) {
    let size = vec2(ui.available_width(), (HEIGHT - 4.0) / 2.0);
    let font = FontId::monospace(11.0);
    // A place as wide as the longest figures: nothing jumps when they change.
    let characters = (NAME + 1 + WIDTH) as f32;
    let place = vec2((characters * ui.ctx().fonts_mut(|f| f.glyph_width(&font, '0'))).ceil(), size.y);
    ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
        ui.add_space(12.0);
        let (text, balanced) = figures(session, plushie);
        let figures_color = if balanced { ui.visuals().weak_text_color() } else { ui.visuals().warn_fg_color };
        ui.allocate_ui_with_layout(place, Layout::left_to_right(Align::Center), |ui| {
            ui.set_min_width(place.x);
            let text = RichText::new(text).font(font).color(figures_color);
            ui.add(Label::new(text).extend()).on_hover_text(
                t("What a frame takes; rms distance of the targets in mm and in body lengths; how well forces balance: the \
                 largest unbalanced force as a part of the forces at work. Under 1e-8 the body is in equilibrium"),
            );
        });
        ui.add_space(12.0);
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            ui.add_space(12.0);
            if let Some(actions) = stops
                && ui.link(RichText::new(STOP.label).small()).on_hover_text(STOP.tip).clicked()
            {
                actions.push(Action::Run(&STOP, Hit::Nothing));
            }
            if session.can_stop() && plushie == Plushie::Idealized {
                ui.add_space(8.0);
            }
            ui.add(Label::new(RichText::new(words).small().color(color)).truncate());
        });
    });
}

fn hint(session: &Session) -> &'static str {
    if session.sketching().open {
        return t("Scroll to zoom, drag beside the drawing or with the middle button to move the sheet");
    }
    match session.picked.mode {
        Mode::Animation => t("Showing the animation. Escape, or choosing a pose, returns to posing"),
        Mode::Winding if taken(session, Scope::Views).id != PULL => {
            t("The winches are wound by hand. K keys that; choosing a pose, or dragging the body, returns to posing")
        }
        Mode::Pose | Mode::Winding => t(session.foretold.unwrap_or(taken(session, Scope::Views).hint)),
    }
}

/// What the solver is at.
fn state(session: &Session) -> String {
    let what = if session.is_refining() {
        t("refining to equilibrium…")
    } else if session.is_dragging() {
        t("following the hand")
    } else if session.playback.playing {
        t("playing")
    } else if !session.is_settled() {
        t("solving…")
    } else {
        t("settled")
    };
    tf!("{quality} quality, {what}", quality = accuracy::name(session.solver.quality), what)
}

/// Time, target error and balance of a view, in columns of fixed width; whether forces balance as far as can be seen.
fn figures(session: &Session, plushie: Plushie) -> (String, bool) {
    let (name, shape) = match plushie {
        Plushie::Idealized => (t("Idealized"), &session.solver.shapes.idealized),
        Plushie::Realizable => (t("Realizable"), &session.solver.shapes.realizable),
    };
    let solved = session.request().is_none_or(|request| request.solves()[plushie as usize]);
    let text = match shape {
        _ if !session.look.views.shows(plushie) && solved => t("hidden, solved for its winches").to_owned(),
        _ if !session.look.views.shows(plushie) => t("hidden, not solved").to_owned(),
        _ if plushie == Plushie::Realizable && session.displayed_proposal().is_some() => {
            t("a proposal is shown: its figures are on its card").to_owned()
        }
        None => t("not solved yet").to_owned(),
        Some(shape) => {
            let (text, balanced) = shape_figures(session, shape);
            return (format!("{name:<NAME$} {text}"), balanced);
        }
    };
    (format!("{name:<NAME$} {text}"), true)
}

/// Characters of the longer name in any language.
const NAME: usize = 11;
/// Characters of [`shape_figures`].
const WIDTH: usize = 55;

fn shape_figures(session: &Session, shape: &Shape) -> (String, bool) {
    let error = if session.targets().is_empty() {
        format!("{:>19}", t("no targets"))
    } else {
        let (mm, percent) = (shape.target_error * session.design().body_length_mm(), 100.0 * shape.target_error);
        format!("{mm:>7.2} mm {percent:>6.2} %")
    };
    let distance = shape.distance_from_equilibrium();
    let crumpled = shape.warning.as_ref().is_some_and(Warning::is_crumpled);
    let words = if crumpled {
        t("crumpled")
    } else if distance < EQUILIBRIUM && shape.converged {
        t("in equilibrium")
    } else if distance < NEAR_EQUILIBRIUM {
        t("near equilibrium")
    } else {
        t("off equilibrium")
    };
    let distance_text = if distance == 0.0 { "0".to_owned() } else { format!("{distance:.0e}") };
    let text = format!("{:>7.1} ms  {error}  {words:<16} {distance_text:>5}", shape.milliseconds);
    (text, distance < NEAR_EQUILIBRIUM && !crumpled)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::studio::session::Services;
    use std::sync::Arc;

    #[test]
    fn figures_keep_their_width() {
        let services =
            Services { propose: Arc::new(|_, _, _, _, _| Vec::new()), export: Arc::new(|_, _, _, _| Ok(Vec::new())) };
        let session = Session::new(crate::studio::blank::design(), None, Arc::new(|| ()), services);
        for (milliseconds, residual, converged) in [(0.04, 0.0, true), (12.3, 3e-12, true), (4321.0, 0.5, false)] {
            let shape = Shape { milliseconds, residual, converged, force_scale: 1.0, ..Shape::default() };
            let (text, balanced) = shape_figures(&session, &shape);
            assert_eq!((text.chars().count(), balanced), (WIDTH, converged), "{text}");
        }
    }
}
