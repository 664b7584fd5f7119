//! The craft of the window: where it speaks, what has the focus, how large its questions are.

use crate::support::window::{bar, click, network, press, session, settle, wait, window};
use eframe::egui::{self, Key, Modifiers};
use egui_kittest::kittest::Queryable;
use plushwright::studio::session::Overlay;

#[test]
fn every_stop_of_the_tab_key_is_seen() {
    let mut design = bar();
    design.networks.push(network());
    let mut window = window(design);
    let ringed = |window: &crate::support::window::Window| {
        let ring =
            |shape: &egui::Shape| matches!(shape, egui::Shape::Rect(r) if r.stroke.width == 2.0 && r.fill.a() == 0);
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
fn what_is_in_hand_stays_in_hand_when_messages_come_and_go() {
    let mut window = window(bar());
    press(&mut window, Modifiers::SHIFT, Key::N);
    window.get_by_label("Rest").focus();
    window.run();
    assert!(window.get_by_label("Rest").is_focused());
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(!session(&window).messages().list().is_empty() && window.get_by_label("Rest").is_focused());
    // What was done goes away by itself.
    wait(&mut window, |s| s.messages().list().is_empty());
    assert!(window.get_by_label("Rest").is_focused());
    // A press before, the release after.
    let at = window.get_by_label("Add pose").rect().center();
    window.hover_at(at);
    window.drag_at(at);
    window.key_press(Key::K);
    window.step();
    window.drop_at(at);
    settle(&mut window);
    assert!(!session(&window).messages().list().is_empty());
    assert_eq!(session(&window).design().poses.len(), 1);
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

#[test]
fn the_next_step_leads_from_a_bare_body_to_a_network() {
    let mut design = bar();
    design.pins.clear();
    let mut window = window(design);
    click(&mut window, "Next step: Pin and pose");
    let made = session(&window).design().clone();
    assert!(made.pins.len() == 1 && made.poses[0].name == "Wave" && made.poses[0].targets.len() == 1);
    assert!(
        window.query_by_label_contains("free to").is_none() && window.query_by_label_contains("Out of reach").is_none()
    );
    click(&mut window, "Next step: Propose networks");
    click(&mut window, "Next step: Accept a network");
    assert_eq!(session(&window).design().networks.len(), 1);
    click(&mut window, "Next step: Add a keyframe");
    click(&mut window, "Rest");
    click(&mut window, "Next step: Add a keyframe");
    let next = ["Next step: Make it fit", "Next step: Export the blueprint"];
    assert!(next.iter().any(|name| window.query_by_label(name).is_some()));
    while session(&window).history().undo_label().is_some() {
        click(&mut window, "Undo");
    }
    assert!(session(&window).design().pins.is_empty() && session(&window).design().poses.is_empty());
}

#[test]
fn the_start_page_opens_examples_and_recent_files() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.plush");
    let mine = plushwright::design::Design { name: "mine".into(), ..bar() };
    plushwright::design::file::write(&path, &mine).unwrap();
    let store = plushwright::studio::store::Store::at(folder.path().join("state"));
    let services = crate::support::window::services();
    let mut window = crate::support::window::open(mine, Some(path.clone()), services, Some(store));
    settle(&mut window);
    click(&mut window, "File");
    click(&mut window, "Start page");
    assert_eq!(session(&window).overlay(), Some(Overlay::Start));
    crate::support::window::wait(&mut window, |s| s.tasks().running("start.pictures").is_none());
    window.get_by_label("Open example Pig").click();
    settle(&mut window);
    assert_eq!((session(&window).design().name.as_str(), session(&window).overlay()), ("pig", None));
    click(&mut window, "File");
    click(&mut window, "Start page");
    window.get_by_label_contains("mine.plush").click();
    settle(&mut window);
    assert_eq!(session(&window).design().name, "mine");
}

#[test]
fn a_blueprint_is_seen_before_it_is_written() {
    let mut design = bar();
    design.networks.push(network());
    let mut window = window(design);
    press(&mut window, Modifiers::COMMAND, Key::E);
    window.run();
    window.get_by_label("Preview").click();
    crate::support::window::wait(&mut window, |s| s.tasks().running("blueprint.preview").is_none());
    window.run();
    assert!(window.query_by_label("Sheet").is_some() && window.query_by_label_contains("1 of ").is_some());
    window.get_by_label("Next page").click();
    window.run();
    assert!(window.query_by_label_contains("2 of ").is_some());
}

#[test]
fn ways_of_working_are_as_they_were_left() {
    let folder = tempfile::tempdir().unwrap();
    let again = || {
        let store = plushwright::studio::store::Store::at(folder.path());
        let mut window = crate::support::window::open(bar(), None, crate::support::window::services(), Some(store));
        settle(&mut window);
        window
    };
    let mut first = again();
    press(&mut first, Modifiers::NONE, Key::T);
    press(&mut first, Modifiers::SHIFT, Key::N);
    let theme = session(&first).look().theme;
    drop(first);
    let second = again();
    assert_eq!((session(&second).look().theme, session(&second).posing().snaps), (theme, false));
}
