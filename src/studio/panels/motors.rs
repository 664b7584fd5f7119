//! Motors: the line to them, what simulated ones make of the motion, and driving them live.

use super::buttons;
use super::panel::{Entry, Panel};
use super::widgets::heading;
use crate::design::Design;
use crate::live::{Status, ports};
use crate::motion::{Forecast, TooFast, families};
use crate::operations::play::{self, Options, SIMULATED};
use crate::studio::action::{Action, Actions};
use crate::studio::commands::motors::{CONNECT, HOME, PLAY, SET_ZERO, STOP};
use crate::studio::jobs::Told;
use crate::studio::language::{mark, t, tf};
use crate::studio::session::{Session, Task};
use crate::studio::words;
use eframe::egui::{ComboBox, DragValue, Grid, RichText, ScrollArea, Slider, TextEdit, Ui};
use std::sync::Arc;

pub static ENTRY: Entry = Entry {
    id: "panel.motors",
    label: "Motors",
    tip: "The line to the motor controllers, and driving the winches live",
    make: || Box::<Motors>::default(),
};

#[derive(Default)]
struct Motors {
    /// What a forecast was asked for last.
    asked: Option<(Arc<Design>, Options)>,
    /// Serial ports that there were when the list was opened.
    ports: Vec<String>,
}

/// The forecast of a motion, or why there is none.
type Forecasted = Result<Forecast, String>;

impl Panel for Motors {
    fn show(&mut self, ui: &mut Ui, session: &Session, actions: &mut Actions) {
        ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
            heading(ui, t("Line"));
            ui.add_enabled_ui(session.motors().remote.is_none(), |ui| self.line(ui, session, actions));
            ui.horizontal_wrapped(|ui| {
                for command in [&CONNECT, &SET_ZERO, &HOME] {
                    buttons::text(ui, session, command, actions);
                }
            });
            ui.horizontal(|ui| {
                buttons::primary(ui, session, &PLAY, true, 140.0, actions);
                buttons::wide(ui, session, &STOP, 110.0, actions);
            });
            let status = state(session.motors().status());
            ui.label(status).on_hover_text(t("What the motors do"));
            sliders(ui, session, actions);
            ui.separator();
            self.forecast(ui, session, actions);
        });
    }
}

impl Motors {
    fn line(&mut self, ui: &mut Ui, session: &Session, actions: &mut Actions) {
        let mut choice = session.motors().choice.clone();
        Grid::new("line").num_columns(2).spacing([8.0, 4.0]).show(ui, |ui| {
            let label = ui.label(t("Port")).on_hover_text(t("Path of a serial port, or “simulated”"));
            ui.horizontal(|ui| {
                let field = TextEdit::singleline(&mut choice.port).desired_width(110.0);
                ui.add(field).labelled_by(label.id);
                let list = ComboBox::from_id_salt("ports").selected_text("").width(20.0).show_ui(ui, |ui| {
                    if self.ports.is_empty() {
                        self.ports = std::iter::once(SIMULATED.to_owned()).chain(ports()).collect();
                    }
                    for port in &self.ports {
                        ui.selectable_value(&mut choice.port, port.clone(), port);
                    }
                });
                if list.inner.is_none() {
                    self.ports.clear();
                }
                list.response.accessible_name(t("Ports")).on_hover_text(t("Serial ports of this machine"));
            });
            ui.end_row();
            ui.label(t("Controllers"));
            let list = ComboBox::from_id_salt("family").selected_text(&choice.family).width(120.0).show_ui(ui, |ui| {
                for family in families::streams() {
                    ui.selectable_value(&mut choice.family, family.name.to_owned(), family.name)
                        .on_hover_text(t(family.title));
                }
            });
            list.response.accessible_name(t("Controllers")).on_hover_text(t("What tells the motors"));
            ui.end_row();
            let label = ui.label(t("Baud")).on_hover_text(t("Speed of the line; 0: as usual for these controllers"));
            let mut baud = choice.baud.unwrap_or(0);
            ui.add(DragValue::new(&mut baud).range(0..=1_000_000).speed(100.0)).labelled_by(label.id);
            choice.baud = (baud > 0).then_some(baud);
            ui.end_row();
        });
        let mut stretch = choice.too_fast == TooFast::Stretch;
        let tip = t("Give the animation more time where its motors are too slow for it; otherwise it is refused");
        ui.checkbox(&mut stretch, t(words::STRETCH)).on_hover_text(tip);
        choice.too_fast = if stretch { TooFast::Stretch } else { TooFast::Refuse };
        if choice != session.motors().choice {
            actions.push(Action::SetMotors(Box::new(choice)));
        }
    }

    /// What simulated drives make of the motion, worked out on a thread whenever it has changed.
    fn forecast(&mut self, ui: &mut Ui, session: &Session, actions: &mut Actions) {
        heading(ui, t("Simulated drives"));
        let (design, choice) = (session.design(), &session.motors().choice);
        let same = |(of, with): &(Arc<Design>, Options)| Arc::ptr_eq(of, design) && with == choice;
        if !self.asked.as_ref().is_some_and(same) && !session.is_dragging() {
            self.asked = Some((design.clone(), choice.clone()));
            let (design, choice) = (design.clone(), choice.clone());
            let work = move |_: &_| {
                let forecast: Forecasted = play::forecast(&design, &choice).map_err(|error| words::unplayed(&error));
                Arc::new(forecast) as Told
            };
            actions.push(Action::Start(Task {
                owner: ENTRY.id,
                name: mark("The simulated drives"),
                work: Arc::new(work),
            }));
        }
        match session.tasks().told::<Forecasted>(ENTRY.id) {
            None => ui.label(RichText::new("…").weak()),
            Some(Err(why)) => ui.label(RichText::new(why).color(ui.visuals().warn_fg_color)),
            Some(Ok(forecast)) => ui.label(said(forecast)).on_hover_text(
                t("Drives with trapezoids of speed: how far cables are from the animation, and how unevenly they run (rms)"),
            ),
        };
    }
}

fn said(forecast: &Forecast) -> String {
    let [file, live] = [forecast.file, forecast.live]
        .map(|[lag, ripple]| tf!("lag {lag:.2} mm, ripple {ripple:.1} %", lag, ripple = 100.0 * ripple));
    tf!("From the files: {file}\nLive, a winch every {slot_s:.2} s: {live}", file, slot_s = forecast.slot_s, live)
}

/// What the motors do, in words.
fn state(status: Option<Status>) -> String {
    match status {
        None => t("No line").into(),
        Some(Status::Connecting) => t("Looking for the controllers…").into(),
        Some(Status::Ready(_)) => t("Ready").into(),
        Some(Status::Zeroing) => t("Setting zero…").into(),
        Some(Status::Checking) => t("Checking the motors…").into(),
        Some(Status::Homing) => t("Winding back to zero…").into(),
        Some(Status::Playing { time_s, .. }) => tf!("Playing, {time_s:.1} s", time_s),
        Some(Status::Ended { why, .. }) => why,
    }
}

/// A slider for each winch of the line, within its travel.
fn sliders(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    let motors = session.motors();
    if motors.remote.is_none() || motors.is_stale(session.design()) {
        return;
    }
    ui.add_enabled_ui(motors.is_ready(), |ui| {
        let names = session.design().networks.iter().filter(|network| !network.muted).map(|network| &network.name);
        for (winch, (name, &travel_mm)) in names.zip(motors.travel_mm()).enumerate() {
            ui.label(name);
            let mut asked = motors.asked_mm().get(winch).copied().unwrap_or(0.0);
            let before = asked;
            let slider = Slider::new(&mut asked, 0.0..=travel_mm).suffix(" mm").fixed_decimals(1);
            ui.add(slider)
                .accessible_name(tf!("Motor of {name}", name))
                .on_hover_text(t("Winds this winch on the plushie itself"));
            if asked != before {
                actions.push(Action::WindMotor(winch, asked));
            }
        }
    });
}
