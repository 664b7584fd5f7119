//! A proposal on the list: what it reaches, what it costs, whom it serves.

use crate::design::Design;
use crate::discovery::Parameters;
use crate::engine::Shape;
use crate::picture::preview::Preview;
use crate::rigging::{PoseServed, Proposal};
use crate::studio::action::{Action, Actions};
use crate::studio::language::{t, tf, tn};
use crate::studio::pictures::Pictures;
use crate::studio::session::Session;
use crate::studio::style;
use eframe::egui::{
    Button, Frame, Label, RectAlign, Response, RichText, Role, Sense, Stroke, Tooltip, Ui, Vec2, WidgetInfo, vec2,
};
use std::sync::Arc;

/// Height of the button, and size of the picture and of those in other poses, logical pixels.
const ROW: f32 = 26.0;
const PICTURE: Vec2 = vec2(84.0, 63.0);
const SMALL: Vec2 = vec2(56.0, 42.0);
/// Both margins of a tip, logical pixels.
const TIP_MARGIN: f32 = 16.0;

/// A proposal in a pose.
pub struct Struck {
    pub name: String,
    pub picture: Arc<Preview>,
    pub shape: Arc<Shape>,
}

/// The pictures of a card: the textures, that of the pose at hand, and those of all poses as far as they are known.
pub type Paint<'a> = (&'a mut Pictures, Option<&'a Arc<Preview>>, &'a [Struck]);

/// The button that keeps it in the views, its picture and its figures. Whether the pointer is on it.
pub fn card(
    ui: &mut Ui,
    session: &Session,
    index: usize,
    proposal: &Proposal,
    (pictures, picture, strip): Paint<'_>,
    actions: &mut Actions,
) -> bool {
    let shown = session.discovery.shown == Some(index);
    let stroke = if shown {
        Stroke::new(1.5, style::accent(session.look().theme))
    } else {
        ui.visuals().widgets.noninteractive.bg_stroke
    };
    let frame = Frame::new().inner_margin(6).corner_radius(8).stroke(stroke);
    let inner = frame.show(ui, |ui| {
        let title = title(ui, session, index, proposal, actions);
        ui.horizontal_top(|ui| {
            let (rect, _) = ui.allocate_exact_size(PICTURE, Sense::hover());
            if let Some(picture) = picture {
                pictures.paint(ui, picture, rect);
            }
            ui.vertical(|ui| figures(ui, session.design(), proposal));
        });
        if strip.len() > 1 && (shown || session.discovery.hovered.as_ref().is_some_and(|(of, _)| *of == index)) {
            ui.horizontal_wrapped(|ui| strip.iter().for_each(|struck| small(ui, pictures, struck)));
        }
        title
    });
    let rect = inner.response.rect.intersect(ui.clip_rect());
    // Below the card and as wide, so that it stands over no view: what the card shows there is looked at now.
    let mut tip = Tooltip::for_enabled(&inner.inner).width(rect.width() - TIP_MARGIN);
    tip.popup = tip.popup.anchor(rect).align(RectAlign::BOTTOM_START).align_alternatives(&[RectAlign::TOP_START]);
    tip.show(|ui| ui.label(details(session.design(), proposal)));
    ui.is_enabled()
        && ui.input(|i| i.pointer.hover_pos()).is_some_and(|p| rect.contains(p) && !ui.ctx().any_popup_open())
}

fn title(ui: &mut Ui, session: &Session, index: usize, proposal: &Proposal, actions: &mut Actions) -> Response {
    let tendons = proposal.network.tendons.len();
    let name = format!("{}  {}", index + 1, tn!(tendons, "{tendons} tendon", "{tendons} tendons"));
    let error =
        tf!("{before} to {after}", before = percent(proposal.error_before()), after = percent(proposal.error_after()));
    let better = proposal.error_after() < proposal.error_before();
    let color = if better { ui.visuals().text_color() } else { ui.visuals().warn_fg_color };
    let button = Button::selectable(session.discovery.shown == Some(index), name)
        .right_text(RichText::new(error).small().color(color))
        .min_size(vec2(ui.available_width(), ROW));
    let response = ui.add(button).accessible_name(tf!("Proposal {number}", number = index + 1));
    if response.clicked() {
        actions.push(Action::ShowProposal(Some(index)));
    }
    response
}

fn figures(ui: &mut Ui, design: &Design, proposal: &Proposal) {
    ui.spacing_mut().item_spacing.y = 2.0;
    let small = |text: String| Label::new(RichText::new(text).small().weak()).truncate();
    ui.add(Label::new(RichText::new(costs(proposal)).small().weak()).wrap());
    ui.add(small(serves(proposal)));
    if !proposal.breaches.is_empty() {
        let text =
            tn!(count = proposal.breaches.len(), "Hard to sew in {count} place", "Hard to sew in {count} places");
        ui.add(Label::new(RichText::new(text).small().color(ui.visuals().warn_fg_color)).truncate());
    }
    let torque_nmm = torque_nmm(design, proposal);
    if torque_nmm > design.controller.torque_nmm {
        let text = tf!("Motor too weak: {torque_nmm:.0} N mm", torque_nmm);
        ui.add(Label::new(RichText::new(text).small().color(ui.visuals().warn_fg_color)).truncate());
    }
}

/// What its cables ask of the motor at most.
fn torque_nmm(design: &Design, proposal: &Proposal) -> f64 {
    design.fabrication.spool_radius_mm * proposal.spool_n
}

/// One of the other poses.
fn small(ui: &mut Ui, pictures: &mut Pictures, struck: &Struck) {
    ui.vertical(|ui| {
        ui.set_width(SMALL.x);
        let (rect, response) = ui.allocate_exact_size(SMALL, Sense::hover());
        response.widget_info(|| WidgetInfo::labeled(Role::Image, true, tf!("Strikes {name}", name = struck.name)));
        pictures.paint(ui, &struck.picture, rect);
        ui.add(Label::new(RichText::new(&struck.name).small().weak()).truncate());
    });
}

/// What it takes to make.
fn costs(proposal: &Proposal) -> String {
    let Proposal { thread_mm, holes, force_n, .. } = proposal;
    let sewn =
        proposal.sewn.map_or(String::new(), |sewn| tf!(", sewn by hand {percent}", percent = percent(sewn.median)));
    let holes = tn!(holes = *holes, "{holes} hole", "{holes} holes");
    tf!("{thread_mm:.0} mm of cable, {holes}, {force_n:.1} N{sewn}", thread_mm, holes, force_n, sewn)
}

fn serves(proposal: &Proposal) -> String {
    let served: Vec<&str> = proposal.serves().collect();
    if served.is_empty() {
        t("serves no pose well").to_owned()
    } else {
        tf!("serves {poses}", poses = served.join(", "))
    }
}

/// Every figure, for the tip.
fn details(design: &Design, proposal: &Proposal) -> String {
    let Proposal { turn_degrees, turning_degrees, .. } = proposal;
    let mut lines =
        vec![t("Error of the realizable plushie without and with it, in body lengths. Click to see it").to_owned()];
    lines.extend(proposal.poses.iter().map(pose));
    if let Some(sewn) = proposal.sewn {
        let (median, worst) = (percent(sewn.median), percent(sewn.worst));
        lines.push(tf!("Sewn by hand, this pose: {median} as a rule, {worst} at worst", median, worst));
    }
    lines.push(tf!(
        "Largest turn at a hole {turn_degrees:.0} degrees, of a cable in all {turning_degrees:.0}",
        turn_degrees,
        turning_degrees
    ));
    let (torque_nmm, limit) = (torque_nmm(design, proposal), design.controller.torque_nmm);
    lines.push(tf!("At the spool {torque_nmm:.0} N mm, of {limit:.0} that its motor keeps up", torque_nmm, limit));
    if let Some((parameters, _)) = &proposal.paper {
        let Parameters { seed_num, join_depth, join_len, phi, .. } = parameters;
        lines.push(tf!("Found by Algorithm 2: {seed_num} seeds, {join_depth} rounds of {join_len} edges, phi {phi:.2}; moved since", seed_num, join_depth, join_len, phi));
    }
    lines.join("\n")
}

fn pose(pose: &PoseServed) -> String {
    let name = pose.name.as_deref().unwrap_or_else(|| t("This pose"));
    let rubbed = pose.with_friction.map(|[before, after]| {
        tf!(" (with friction {before} to {after})", before = percent(before), after = percent(after))
    });
    tf!(
        "{name}: {before} to {after}{rubbed}",
        name,
        before = percent(pose.before),
        after = percent(pose.after),
        rubbed = rubbed.unwrap_or_default()
    )
}

/// An error, where there is such a figure.
fn percent(error: f64) -> String {
    if error.is_finite() { format!("{:.1} %", 100.0 * error) } else { t("no figure").to_owned() }
}
