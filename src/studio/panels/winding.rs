//! Sliders for all winches: winding by hand.

use super::buttons;
use crate::engine::winch_reach_mm;
use crate::motion::{spool_degrees, winch_loads};
use crate::numbers;
use crate::studio::action::{Action, Actions};
use crate::studio::commands::animation::ADD_KEYFRAME;
use crate::studio::commands::networks::SLACKEN;
use crate::studio::language::{t, tf};
use crate::studio::session::{Mode, Session};
use crate::studio::viewport::{is_beyond, limit, load_words};
use eframe::egui::{CollapsingHeader, DragValue, RichText, Slider, Ui};

/// How far a slider pays cable out, of what it can wind: more is slack.
const OUT: f64 = 0.25;

pub fn show(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    if session.design().networks.is_empty() {
        return;
    }
    ui.add_space(8.0);
    CollapsingHeader::new(t("Wind by hand")).id_salt("winding").show(ui, |ui| {
        for winch in 0..session.design().networks.len() {
            slider(ui, session, winch, actions);
        }
        ui.horizontal(|ui| {
            buttons::text(ui, session, &SLACKEN, actions);
            if session.mode() == Mode::Winding {
                let tip = ADD_KEYFRAME.hint(t("Put what the winches have wound on the timeline"));
                if ui.button(t("Key this")).on_hover_text(tip).clicked() {
                    actions.push(Action::Run(&ADD_KEYFRAME, session.selected()));
                }
            }
        });
    });
}

fn slider(ui: &mut Ui, session: &Session, winch: usize, actions: &mut Actions) {
    let design = session.design();
    let network = &design.networks[winch];
    let shape = session.shapes().realizable.as_ref();
    let shown = match session.mode() {
        Mode::Winding => session.winding().wound_mm().get(winch),
        _ => shape.and_then(|shape| shape.activations_mm.get(winch)),
    };
    let mut wound = shown.copied().unwrap_or(0.0);
    let reach = winch_reach_mm(design, network);
    ui.add_enabled_ui(!network.muted, |ui| {
        ui.horizontal(|ui| {
            ui.label(&network.name);
            let loads = shape.map(|shape| winch_loads(design, &shape.tendon_tensions)).unwrap_or_default();
            if let Some(&load) = loads.get(winch).filter(|_| !network.muted) {
                let text = RichText::new(load_words(load)).small();
                let text = if is_beyond(session, load) { text.color(ui.visuals().error_fg_color) } else { text.weak() };
                ui.label(text).on_hover_text(limit(session));
            }
        });
        ui.horizontal(|ui| {
            let before = wound;
            let range = (-OUT * reach).min(wound)..=reach.max(wound);
            let slider = Slider::new(&mut wound, range).show_value(false);
            ui.add(slider).accessible_name(tf!("Cable of {name}", name = network.name));
            let value = DragValue::new(&mut wound).range(-reach..=reach).speed(0.2).fixed_decimals(1).suffix(" mm");
            ui.add(value).accessible_name(tf!("Cable of {name} in mm", name = network.name));
            let degrees = numbers::plain(spool_degrees(design, wound), 0);
            ui.label(RichText::new(format!("{degrees}°")).small().weak()).on_hover_text(t("Turn of the spool"));
            if wound != before {
                actions.push(Action::Wind(winch, wound));
            }
        });
    });
}
