//! The next step on the way to a plushie, as one button: pin, pose, propose, accept, key, export.

use crate::motion::{Why, winch_labels};
use crate::operations::network::Part;
use crate::sewing::most_severe;
use crate::studio::action::{Action, Actions};
use crate::studio::canvas::Hit;
use crate::studio::commands::Command;
use crate::studio::commands::animation::{BEGIN as MOVE, FIT};
use crate::studio::commands::discovery::{ACCEPT, PROPOSE, PROPOSE_AGAIN};
use crate::studio::commands::files::EXPORT;
use crate::studio::commands::posing::{BEGIN, PIN_MIDDLE};
use crate::studio::commands::tools;
use crate::studio::commands::view::GUIDE;
use crate::studio::language::{t, tf};
use crate::studio::session::{Selection, Session};
use crate::studio::style;
use crate::studio::tools::TENDON;
use eframe::egui::{Button, RichText, Stroke, Ui};

/// Least width that is left for it, logical pixels: where there is less, it is not shown.
const LEAST: f32 = 190.0;

/// A pose that misses its targets by more is not done, body lengths.
const FAR_OFF: f64 = 0.05;

/// What comes next, and the words for it.
pub fn next(session: &Session) -> Option<(&'static Command, &'static str)> {
    let design = session.design();
    let posed = design.poses.iter().any(|pose| !pose.targets.is_empty());
    let found = session.discovery();
    let busy = session.sketching().open || session.is_working() || found.running.is_some();
    if busy {
        return None;
    }
    Some(if !posed && design.pins.is_empty() {
        (&BEGIN, t("Pin and pose"))
    } else if design.pins.is_empty() {
        (&PIN_MIDDLE, t("Pin the body"))
    } else if !posed {
        (&BEGIN, t("Make a pose"))
    } else if found.is_stale() {
        (&PROPOSE_AGAIN, t("Propose again"))
    } else if session.shown_proposal().is_some() {
        (&ACCEPT, t("Accept a network"))
    } else if design.networks.is_empty() {
        (&PROPOSE, t("Propose networks"))
    } else if design.keyframes.len() < 2 {
        (&MOVE, t("Make it move"))
    } else if session.timing().doubts().iter().any(|doubt| matches!(doubt.why, Why::TooFast { .. })) {
        (&FIT, t("Make it fit"))
    } else if session.pose().is_some_and(|pose| is_missed(session, pose)) {
        (&PROPOSE, t("Propose for this pose"))
    } else if let (false, Some(tool)) = (session.judging().breaches().is_empty(), tools::take(TENDON)) {
        (tool, t("Mend a cable"))
    } else {
        (&EXPORT, t("Export the blueprint"))
    })
}

/// Whether all that the winches can do leaves a pose far off.
fn is_missed(session: &Session, pose: usize) -> bool {
    session.judging().error(pose).is_some_and(|known| known.fresh && known.thorough && known.error > FAR_OFF)
}

pub fn show(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let Some((command, words)) = next(session).filter(|_| session.guided && ui.available_width() > LEAST) else {
        return;
    };
    let accent = style::accent(session.look().theme);
    let text = RichText::new(tf!("Next: {words}", words)).color(accent);
    let button = Button::new(text).stroke(Stroke::new(1.0, accent)).corner_radius(12);
    let response = ui.add(button).accessible_name(tf!("Next step: {words}", words));
    response.context_menu(|ui| super::buttons::entry(ui, session, &GUIDE, Hit::Nothing, actions));
    let severe = |breaches| most_severe(breaches, 1).into_iter().next();
    let worst = (command.id == TENDON).then(|| severe(session.judging().breaches())).flatten();
    let why = match &worst {
        Some(breach) => breach.words(&winch_labels(session.design())).to_string(),
        None => command.refused(session, session.selected()).unwrap_or(t(command.tip)).to_owned(),
    };
    if response.on_hover_text(tf!("{why}. Right-click to hide this", why)).clicked() {
        // With the tool, what it is for.
        let broken = worst.and_then(|breach| breach.winches().next());
        actions.extend(broken.map(|winch| Action::Select(Selection::Part(Part::Winch(winch)))));
        actions.push(Action::Run(command, session.selected()));
    }
}
