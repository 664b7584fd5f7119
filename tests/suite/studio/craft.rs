//! The craft of the window: where it speaks, what has the focus, how large its questions are.

use crate::support::window::{bar, click, network, press, session, settle, window};
use eframe::egui::{self, Key, Modifiers};
use egui_kittest::kittest::Queryable;
use plushwright::studio::session::Overlay;

#[test]
fn every_stop_of_the_tab_key_is_seen() {
    let mut design = bar();
    design.networks.push(network());
    let mut window = window(design);
    let ringed = |window: &crate::support::window::Window| {
        let ring = |shape: &egui::Shape| matches!(shape, egui::Shape::Rect(r) if r.stroke.width == 2.0 && r.fill.a() == 0);
        window.output().shapes.iter().any(|clipped| ring(&clipped.shape))
    };
    assert!(!ringed(&window));
    for stop in 0..60 {
        window.key_press(Key::Tab);
        // egui moves the focus at the end of the frame.
        window.run_steps(3);
        assert!(ringed(&window), "stop {stop} shows nothing");
    }
    // A click needs no ring.
    click(&mut window, "Rest");
    assert!(!ringed(&window));
}

#[test]
fn messages_stand_beside_the_views_and_all_of_them_in_the_log() {
    let mut window = window(bar());
    press(&mut window, Modifiers::NONE, Key::K);
    let text = session(&window).messages().list()[0].text.clone();
    let view = window.get_by_label("Idealized view").rect();
    assert!(window.get_by_label(&text).rect().right() <= view.left());
    click(&mut window, "Dismiss message");
    assert!(window.query_by_label(&text).is_none());
    press(&mut window, Modifiers::NONE, Key::K);
    click(&mut window, "All messages");
    assert_eq!(session(&window).overlay(), Some(Overlay::Log));
    assert!(session(&window).messages().log().count() == 2);
    window.get_by_label("Close").click();
    settle(&mut window);
    assert_eq!(session(&window).overlay(), None);
}

#[test]
fn a_question_has_its_own_size_whatever_was_open_before() {
    let mut window = window(bar());
    click(&mut window, "Add pose");
    let height = |window: &mut crate::support::window::Window| {
        press(window, Modifiers::COMMAND, Key::O);
        window.run();
        let ends = ["Without saving they are lost.", "Discard changes"].map(|name| window.get_by_label(name).rect());
        press(window, Modifiers::NONE, Key::Escape);
        ends[1].bottom() - ends[0].top()
    };
    let before = height(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::E);
    window.run();
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(height(&mut window), before);
}

#[test]
fn an_empty_sheet_opens_without_a_warning() {
    let mut window = window(bar());
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::O);
    window.run();
    assert!(session(&window).sketching().open);
    assert!(window.query_by_label_contains("Draw something that is not cut out").is_none());
    assert!(window.query_by_label_contains("Draw the silhouette").is_some());
}
