//! Motors that are driven live, on simulated controllers in the time of the wall.

use crate::support::window::{Window, bar, click, drag, network, press, session, window};
use eframe::egui::{Key, Modifiers, vec2};
use egui_kittest::kittest::Queryable;
use plushwright::design::{Design, Easing, Keyframe};
use plushwright::live::Status;
use plushwright::studio::session::{Mode, Session};
use std::time::{Duration, Instant};

/// The bar with a winch that pulls and lets go within two seconds.
fn pulling() -> Design {
    let mut design = bar();
    design.networks.push(network());
    let key = |time_s, mm| Keyframe { time_s, activations_mm: vec![mm], pose: None, easing: Easing::Smooth };
    design.keyframes = vec![key(0.0, 0.0), key(1.0, 6.0), key(2.0, 0.0)];
    design
}

/// Frames until something holds; the line keeps the window awake meanwhile.
#[track_caller]
fn until(window: &mut Window, what: &str, is: impl Fn(&Session) -> bool) {
    let began = Instant::now();
    while !is(session(window)) {
        assert!(began.elapsed() < Duration::from_secs(60), "{what}: {:?}", session(window).motors().status());
        std::thread::sleep(Duration::from_millis(5));
        window.step();
    }
}

fn connected(design: Design) -> Window {
    let mut window = window(design);
    click(&mut window, "Motors");
    until(&mut window, "a forecast", |s| s.tasks().running("panel.motors").is_none());
    window.step();
    assert!(window.query_by_label_contains("ripple").is_some());
    click(&mut window, "Connect");
    until(&mut window, "ready", |s| s.motors().is_ready());
    window
}

fn told(window: &Window) -> String {
    session(window).messages().list().iter().map(|message| message.text.clone()).collect()
}

#[test]
fn the_animation_plays_on_motors_and_the_views_show_it() {
    let mut window = connected(pulling());
    window.step();
    // Not until all is settled: it may have played by then.
    window.get_by_label("Play on motors").click();
    window.step();
    until(&mut window, "wound", |s| {
        let playing = matches!(s.motors().status(), Some(Status::Playing { .. }));
        playing && s.mode() == Mode::Winding && s.winding().wound_mm()[0] > 3.0
    });
    until(&mut window, "back", |s| s.motors().is_ready());
    window.step();
    click(&mut window, "Stop motors");
    until(&mut window, "closed", |s| s.motors().status().is_none());
    assert!(told(&window).contains("switched off"), "{}", told(&window));
}

#[test]
fn a_slider_winds_a_motor_and_escape_stops_it() {
    let mut window = connected(pulling());
    window.step();
    window.get_by_label("Motor of winch 1").scroll_to_me();
    window.run_steps(4);
    let rect = window.get_by_label("Motor of winch 1").rect();
    let from = rect.left_center() + vec2(4.0, 0.0);
    drag(&mut window, from, from + vec2(30.0, 0.0));
    until(&mut window, "wound", |s| {
        let asked = s.motors().asked_mm()[0];
        asked > 0.0 && s.motors().status() == Some(Status::Ready(vec![asked]))
    });
    press(&mut window, Modifiers::NONE, Key::Escape);
    until(&mut window, "closed", |s| s.motors().status().is_none());
    assert!(told(&window).contains("Motors: stopped; all motors are switched off"), "{}", told(&window));
}

#[test]
fn after_zero_is_set_only_the_winch_whose_slider_is_moved_winds() {
    let mut design = pulling();
    design.networks.push(plushwright::design::Network { name: "winch 2".into(), ..network() });
    design.keyframes.iter_mut().for_each(|keyframe| keyframe.activations_mm.push(keyframe.activations_mm[0]));
    let mut window = connected(design);
    window.step();
    let slide = |window: &mut Window, name: &str| {
        window.get_by_label(name).scroll_to_me();
        window.run_steps(4);
        let from = window.get_by_label(name).rect().left_center() + vec2(4.0, 0.0);
        drag(window, from, from + vec2(30.0, 0.0));
    };
    let wound = |winch: usize| {
        move |session: &Session| match session.motors().status() {
            Some(Status::Ready(told_mm)) => told_mm[winch] > 0.0 && told_mm == session.motors().asked_mm(),
            _ => false,
        }
    };
    slide(&mut window, "Motor of winch 1");
    until(&mut window, "the first wound", wound(0));
    window.get_by_label("Set zero").click();
    window.step();
    assert_eq!(session(&window).motors().asked_mm()[0], 0.0);
    until(&mut window, "zero", |s| s.motors().status() == Some(Status::Ready(vec![0.0; 2])));
    slide(&mut window, "Motor of winch 2");
    until(&mut window, "the second wound", wound(1));
    assert_eq!(session(&window).motors().asked_mm()[0], 0.0);
}

#[test]
fn a_port_that_is_not_there_is_said() {
    let mut window = window(pulling());
    click(&mut window, "Motors");
    window.get_by_label("Port").focus();
    window.step();
    press(&mut window, Modifiers::COMMAND, Key::A);
    window.get_by_label("Port").type_text("/dev/no-such-port");
    window.step();
    click(&mut window, "Connect");
    until(&mut window, "told", |s| s.messages().list().iter().any(|m| m.text.contains("cannot be opened")));
    assert!(session(&window).motors().status().is_none());
}
