//! What the pose asks of the body: targets and how near they come, pins, and the brush of starch.

use super::buttons;
use super::widgets::heading;
use crate::design::{Hold, Target};
use crate::engine::Shape;
use crate::operations::arrange::Handle;
use crate::outline::polygon;
use crate::studio::action::{Action, Actions};
use crate::studio::change::Change;
use crate::studio::commands::command::Scope;
use crate::studio::commands::document::{CLEAR_TARGETS, DELETE};
use crate::studio::commands::posing::{self, CLEAR_STARCH, MIRROR, PIN_MIDDLE, SNAP, SYMMETRIC};
use crate::studio::icons::{self, Icon};
use crate::studio::language::{mark, t, tf};
use crate::studio::session::{Brush, Mode, Selection, Session};
use crate::studio::tools::{RADIUS_MM, STARCH, taken};
use eframe::egui::{Align, Button, ComboBox, DragValue, Layout, RichText, Role, ScrollArea, Ui, WidgetInfo, vec2};

/// A target that even the fibres miss by more than this part of the body length cannot be reached: what a maker sees.
const OUT_OF_REACH: f64 = 0.02;
const OUT_OF_REACH_TIP: &str = mark(
    "Out of reach from here: with all its fibres the body does not come nearer, as the other targets and the pins are. Move the goal nearer, give this target more weight, or propose networks: a few cables may find another way. Another pin may help, or spoil other poses",
);
/// Where there is no other target.
const ALONE_OUT_OF_REACH_TIP: &str = mark(
    "Out of reach from here: with all its fibres the body does not come nearer, as the pins are. Move the goal nearer, or propose networks: a few cables may find another way. Another pin may help, or spoil other poses",
);
/// Weights that are offered.
const WEIGHTS: std::ops::RangeInclusive<f64> = 0.01..=100.0;

pub fn show(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ScrollArea::vertical().id_salt("targets").auto_shrink([false, true]).show(ui, |ui| {
        ui.spacing_mut().item_spacing.y = 2.0;
        if taken(session, Scope::Views).id == STARCH {
            brush(ui, session, actions);
        }
        ways(ui, session, actions);
        targets(ui, session, actions);
        pins(ui, session, actions);
    });
}

/// How a hand poses.
fn ways(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        buttons::choice(ui, session, &SYMMETRIC, actions);
        buttons::choice(ui, session, &SNAP, actions);
        if session.group().handles().len() > 1 {
            buttons::text(ui, session, &MIRROR, actions);
        }
    });
}

fn targets(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    if session.picked.mode == Mode::Animation {
        return hint(ui, t("The views show the animation. Choose a pose, or drag the body, to go on posing."));
    }
    if session.picked.mode == Mode::Winding {
        return hint(ui, t("The winches are wound by hand. Choose a pose, or drag the body, to go on posing."));
    }
    let Some(pose) = session.picked.pose else {
        return hint(ui, t("Drag any point of the body, in either view, to begin a pose."));
    };
    ui.horizontal(|ui| {
        heading(ui, t("Targets"));
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if !session.targets().is_empty() {
                buttons::small_icon(ui, session, &CLEAR_TARGETS, actions);
            }
        });
    });
    if session.targets().is_empty() {
        hint(ui, t("Drag any point of the body, in either view: the drag becomes a target."));
    }
    for (index, target) in session.targets().iter().enumerate() {
        row(ui, session, pose, index, target, actions);
    }
    group_weight(ui, session, pose, actions);
}

fn row(ui: &mut Ui, session: &Session, pose: usize, index: usize, target: &Target, actions: &mut Actions) {
    let missed = missed(session, target);
    ui.horizontal(|ui| {
        let handle = Handle::Target(index);
        let selected = session.picked.selection == Selection::Target(index) || session.group().has(handle);
        let name = tf!("Target {number}", number = index + 1);
        // Text on the right, even none, moves the name to the left, in line with the poses above.
        let button = Button::selectable(selected, &name).right_text("").min_size(vec2(62.0, 24.0));
        let response =
            ui.add(button).accessible_name(&name).on_hover_text(t("Click to select, with Ctrl or Shift beside others"));
        if response.clicked() {
            actions.push(pick(ui, session, handle));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            // As narrow as they are read well: how far a target is missed stands beside them.
            let spacing = ui.spacing_mut();
            (spacing.item_spacing.x, spacing.button_padding.x, spacing.interact_size.x) = (4.0, 5.0, 30.0);
            let (name, tip) = (tf!("Remove target {number}", number = index + 1), DELETE.hint(t("Remove this target")));
            if icons::small_button(ui, Icon::Close, &name, &tip).clicked() {
                actions.push(Action::Change(Change::RemoveTarget { pose, index }));
            }
            let mut weight = target.weight;
            let value = DragValue::new(&mut weight).range(WEIGHTS).speed(0.02).max_decimals(2);
            let response = ui.add(value).accessible_name(tf!("Weight of target {number}", number = index + 1));
            if response.on_hover_text(t("Weight: how much this target counts")).changed() {
                actions.push(Action::Live(Change::WeighTarget { pose, index, weight }));
            }
            // In the row, so that nothing moves away from under the pointer while the body settles.
            if let Some(missed) = missed {
                let tip = if session.targets().len() == 1 { ALONE_OUT_OF_REACH_TIP } else { OUT_OF_REACH_TIP };
                let text = RichText::new(format!("{:.0} mm", missed.ceil())).small().color(ui.visuals().warn_fg_color);
                let response = ui.label(text).on_hover_text(t(tip));
                let spoken = tf!("Out of reach by {missed_mm:.0} mm", missed_mm = missed.ceil());
                response.widget_info(|| WidgetInfo::labeled(Role::Label, true, &spoken));
            }
        });
    });
}

/// How far a target's point of the body is from its goal even in the idealized plushie, mm, where that can be seen.
fn missed(session: &Session, target: &Target) -> Option<f64> {
    if session.is_dragging() || !session.is_settled() {
        return None;
    }
    let shape: &Shape = session.shapes().idealized.as_deref()?;
    let mesh = &session.design().mesh;
    if shape.nodes.len() != mesh.nodes.len() || target.at.triangle >= mesh.triangles.len() {
        return None;
    }
    let missed = polygon::length(mesh.position(&target.at, &shape.nodes), target.to);
    (missed > OUT_OF_REACH * session.document.figures.body_length_mm).then_some(missed)
}

/// Selects, or with Ctrl or Shift puts beside what is selected, or takes it from there.
fn pick(ui: &Ui, session: &Session, handle: Handle) -> Action {
    if !ui.input(|i| i.modifiers.command || i.modifiers.shift) {
        return Action::Gather(vec![handle]);
    }
    let mut handles = session.group().handles().to_vec();
    match handles.iter().position(|other| *other == handle) {
        Some(at) => drop(handles.remove(at)),
        None => handles.push(handle),
    }
    Action::Gather(handles)
}

/// A weight for all targets that are picked out together.
fn group_weight(ui: &mut Ui, session: &Session, pose: usize, actions: &mut Actions) {
    let group: Vec<usize> = session.group().targets().collect();
    let Some(first) = group.first().and_then(|&index| session.targets().get(index)).filter(|_| group.len() > 1) else {
        return;
    };
    ui.horizontal(|ui| {
        let label = ui.label(RichText::new(tf!("{count} targets, weight", count = group.len())).weak());
        let mut weight = first.weight;
        let value = DragValue::new(&mut weight).range(WEIGHTS).speed(0.02).max_decimals(2);
        if ui.add(value).labelled_by(label.id).on_hover_text(t("Weight of all that are selected")).changed() {
            let handles = session.group().handles().to_vec();
            actions.push(Action::Live(Change::WeighTargets { pose, handles, weight }));
        }
    });
}

fn pins(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ui.add_space(8.0);
    heading(ui, t("Pins"));
    let pins = &session.design().pins;
    if pins.is_empty() {
        hint(ui, t("Nothing holds the body: it rests where it lies, and drifts."));
        buttons::text(ui, session, &PIN_MIDDLE, actions);
    }
    for (index, pin) in pins.iter().enumerate() {
        let handle = Handle::Pin(index);
        let selected = session.picked.selection == Selection::Pin(index) || session.group().has(handle);
        ui.horizontal(|ui| {
            let name = tf!("Pin {number}", number = index + 1);
            let button = Button::selectable(selected, &name).right_text("").min_size(vec2(60.0, 24.0));
            if ui.add(button).accessible_name(&name).clicked() {
                actions.push(pick(ui, session, handle));
            }
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                let (name, tip) = (tf!("Remove pin {number}", number = index + 1), DELETE.hint(t("Remove this pin")));
                if icons::small_button(ui, Icon::Close, &name, &tip).clicked() {
                    actions.push(Action::Change(Change::RemovePin(index)));
                }
                kind(ui, session, index, pin.hold, actions);
            });
        });
        if selected && pin.hold != Hold::Point {
            figures(ui, index, pin.hold, actions);
        }
    }
}

/// The choice between the kinds of pins.
fn kind(ui: &mut Ui, session: &Session, index: usize, hold: Hold, actions: &mut Actions) {
    let name = |hold: Hold| match hold {
        Hold::Point => t("Point"),
        Hold::Line { .. } => t("pin|Line"),
        Hold::Region { .. } => t("Region"),
    };
    let region = posing::region(session);
    let mut chosen = hold;
    let combo = ComboBox::from_id_salt(("kind of pin", index)).selected_text(name(hold)).width(54.0);
    let combo = combo.show_ui(ui, |ui| {
        for choice in [Hold::Point, Hold::Line { degrees: 0.0 }, region] {
            let choice = if name(choice) == name(hold) { hold } else { choice };
            ui.selectable_value(&mut chosen, choice, name(choice));
        }
    });
    let tip = t("Point: the body may turn about it. Line: it slides along. Region: it cannot turn there");
    combo.response.accessible_name(tf!("Kind of pin {number}", number = index + 1)).on_hover_text(tip);
    if chosen != hold {
        actions.push(Action::Change(Change::HoldPin { index, hold: chosen }));
    }
}

/// The numbers of a pin's kind.
fn figures(ui: &mut Ui, index: usize, hold: Hold, actions: &mut Actions) {
    let mut changed = hold;
    ui.horizontal(|ui| {
        let angle = |ui: &mut Ui, degrees: &mut f64| {
            let value = DragValue::new(degrees).range(-360.0..=360.0).speed(0.5).max_decimals(1).suffix("°");
            ui.add(value).accessible_name(tf!("Angle of pin {number}", number = index + 1));
        };
        match &mut changed {
            Hold::Point => {}
            Hold::Line { degrees } => angle(ui, degrees),
            Hold::Region { radius_mm, degrees } => {
                let value = DragValue::new(radius_mm).range(0.0..=1e4).speed(0.2).max_decimals(1).suffix(" mm");
                ui.add(value).accessible_name(tf!("Radius of pin {number}", number = index + 1));
                angle(ui, degrees);
            }
        }
    });
    if changed != hold {
        actions.push(Action::Live(Change::HoldPin { index, hold: changed }));
    }
}

/// The size and the stiffness of the brush.
fn brush(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    heading(ui, t("Starch"));
    let before = session.posing().brush;
    let mut brush = before;
    ui.horizontal(|ui| {
        let Brush { radius_mm, factor } = &mut brush;
        let size =
            DragValue::new(radius_mm).range(RADIUS_MM[0]..=RADIUS_MM[1]).speed(0.2).max_decimals(1).suffix(" mm");
        ui.add(size).accessible_name(t("Radius of the brush")).on_hover_text(t("Radius of the brush ([ and ])"));
        let strength = DragValue::new(factor).range(1e-2..=1e3).speed(0.05).max_decimals(2).prefix("× ");
        ui.add(strength)
            .accessible_name(t("Stiffness of the brush"))
            .on_hover_text(t("Stiffness that it leaves, as a multiple of the material's: 1 clears, less softens"));
    });
    if brush != before {
        actions.push(Action::SetBrush(brush));
    }
    buttons::text(ui, session, &CLEAR_STARCH, actions);
    ui.add_space(8.0);
}

fn hint(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).weak());
}
