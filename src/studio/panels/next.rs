//! The next step on the way to a plushie, as one button: pin, pose, propose, accept, key, export.

use crate::engine::target_error;
use crate::motion::{Why, winch_labels};
use crate::operations::network::Part;
use crate::sewing::{Breach, most_severe};
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

/// A pose that misses its targets by more, body lengths, and keeps more than this part of its error at rest is not served yet. A network that was
/// accepted leaves a quarter or so; to ask for another one then would never end.
const FAR_OFF: f64 = 0.05;
const UNSERVED: f64 = 0.4;

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
    } else if let (Some(_), Some(tool)) = (to_mend(session), tools::take(TENDON)) {
        (tool, t("Mend a cable"))
    } else {
        (&EXPORT, t("Export the blueprint"))
    })
}

/// Whether all that the winches can do leaves a pose far off, and networks for it were not looked for in vain.
fn is_missed(session: &Session, pose: usize) -> bool {
    let in_vain = session.discovery().has_asked() && session.discovery().proposals.is_empty();
    if in_vain || session.cannot_propose().is_some() {
        return false;
    }
    let design = session.design();
    let Some(targets) = design.poses.get(pose).map(|pose| &pose.targets) else { return false };
    let known = session.judging().error(pose).filter(|known| known.fresh && known.thorough);
    known.is_some_and(|known| known.error > FAR_OFF.max(UNSERVED * target_error(design, targets, &design.mesh.nodes)))
}

/// The gravest place that the tendon tool can mend, and its winch. What is wrong with the body or the turning gap is told by the panels.
fn to_mend(session: &Session) -> Option<(Breach, usize)> {
    let of_cables = |b: &&Breach| !matches!(b, Breach::HousingAtGap { .. }) && b.winches().next().is_some();
    let breaches: Vec<Breach> = session.judging().breaches().iter().filter(of_cables).cloned().collect();
    let worst = most_severe(&breaches, 1).into_iter().next()?;
    let winch = worst.winches().next()?;
    Some((worst, winch))
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
    let worst = (command.id == TENDON).then(|| to_mend(session)).flatten();
    let why = match &worst {
        Some((breach, _)) => breach.words(&winch_labels(session.design())).to_string(),
        None => command.refused(session, session.selected()).unwrap_or(t(command.tip)).to_owned(),
    };
    if response.on_hover_text(tf!("{why}. Right-click to hide this", why)).clicked() {
        // With the tool, what it is for.
        actions.extend(worst.map(|(_, winch)| Action::Select(Selection::Part(Part::Winch(winch)))));
        actions.push(Action::Run(command, session.selected()));
    }
}
