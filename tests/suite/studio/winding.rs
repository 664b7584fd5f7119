//! Winches wound by hand, and their list: off, alone, coloured, moved.

use crate::support::window::{
    Window, bar, click, drag, network, on_screen, pose, press, session, settle, wait, window, with_network,
};
use eframe::egui::{Key, Modifiers, vec2};
use egui_kittest::kittest::Queryable;
use plushwright::design::{Design, MaterialPoint, Network, Tendon};
use plushwright::operations::network::Part;
use plushwright::studio::session::{Mode, Selection};

/// The bar with a winch along its top and one along its bottom.
fn two() -> Design {
    let mut design = bar();
    design.networks.push(network());
    let tendon = Tendon { routing: MaterialPoint::through(0..6), ratio: 1.0, slack_mm: 0.0 };
    design.networks.push(Network::new("low", vec![tendon]));
    design
}

/// Height of the middle of the free end.
fn height(window: &Window) -> f64 {
    session(window).shapes().realizable.as_ref().unwrap().nodes[13][1]
}

fn wound(window: &Window) -> Vec<f64> {
    session(window).shapes().realizable.as_ref().unwrap().activations_mm.clone()
}

/// Waits until the first winch has wound so much.
fn until_wound(window: &mut Window, is: impl Fn(f64) -> bool) {
    wait(window, |s| s.shapes().realizable.as_ref().is_some_and(|shape| is(shape.activations_mm[0])));
}

#[test]
fn a_pull_at_a_cable_winds_it_and_the_body_follows() {
    let mut window = window(two());
    press(&mut window, Modifiers::NONE, Key::E);
    let before = session(&window).design().clone();
    // The upper cable runs to the right from its winch: a pull to the left winds.
    let from = on_screen(&window, "Realizable view", [60.0, 40.0]);
    drag(&mut window, from, from - vec2(24.0, 0.0));
    let pulled = wound(&window)[0];
    assert_eq!(
        (session(&window).mode(), session(&window).selection()),
        (Mode::Winding, Selection::Part(Part::Winch(0)))
    );
    assert!(pulled > 5.0 && height(&window) > 21.0, "{pulled} mm, {}", height(&window));
    assert!(window.query_by_label_contains("Load of winch 1: ").is_some());
    // What is wound by hand is not in the document, until it is keyed.
    assert_eq!(session(&window).design(), &before);
    press(&mut window, Modifiers::NONE, Key::K);
    let keyframe = &session(&window).design().keyframes[0];
    assert_eq!((&keyframe.activations_mm, &keyframe.pose), (&session(&window).winding().wound_mm().to_vec(), &None));
    assert_eq!(session(&window).mode(), Mode::Winding);
    // Back to posing with a target.
    press(&mut window, Modifiers::NONE, Key::V);
    pose(&mut window, "Realizable view");
    assert_eq!(session(&window).mode(), Mode::Pose);
}

#[test]
fn sliders_wind_all_winches_from_what_is_shown() {
    let mut window = with_network();
    let posed = wound(&window)[0];
    assert!(posed > 0.0);
    click(&mut window, "Wind by hand");
    let rect = window.get_by_label("Cable of winch 1").rect();
    let (from, to) = (rect.left_center() + vec2(20.0, 0.0), rect.right_center() - vec2(2.0, 0.0));
    drag(&mut window, from, to);
    assert_eq!(session(&window).mode(), Mode::Winding);
    assert!(wound(&window)[0] > posed, "{} {posed}", wound(&window)[0]);
    click(&mut window, "All slack");
    until_wound(&mut window, |mm| mm == 0.0);
    assert!((height(&window) - 20.0).abs() < 0.1);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(session(&window).mode(), Mode::Pose);
    until_wound(&mut window, |mm| (mm - posed).abs() < 0.05 * posed);
}

#[test]
fn a_load_beyond_the_motor_is_told() {
    let mut design = two();
    design.controller.torque_nmm = 1.0;
    let mut window = window(design);
    press(&mut window, Modifiers::NONE, Key::E);
    let from = on_screen(&window, "Realizable view", [60.0, 40.0]);
    drag(&mut window, from, from - vec2(40.0, 0.0));
    assert!(window.query_all_by_label_contains("beyond the motor's limit").count() > 0);
}

#[test]
fn networks_are_switched_off_and_heard_alone() {
    let mut window = window(two());
    pose(&mut window, "Realizable view");
    until_wound(&mut window, |mm| mm > 1.0);
    click(&mut window, "Network winch 1");
    click(&mut window, "Switch off");
    assert!(session(&window).design().networks[0].muted);
    assert_eq!(session(&window).history().undo_label(), Some("Switch network off"));
    until_wound(&mut window, |mm| mm == 0.0);
    click(&mut window, "Switch on");
    until_wound(&mut window, |mm| mm > 1.0);
    // Alone: of the window only.
    let before = session(&window).design().clone();
    click(&mut window, "Network low");
    click(&mut window, "Solo");
    assert_eq!((session(&window).solo().name(), session(&window).design()), (Some("low"), &before));
    until_wound(&mut window, |mm| mm == 0.0);
    click(&mut window, "Solo");
    assert!(session(&window).solo().name().is_none());
    until_wound(&mut window, |mm| mm > 1.0);
    click(&mut window, "Solo");
    click(&mut window, "Delete network low");
    assert!(session(&window).solo().name().is_none());
}

#[test]
fn networks_are_coloured_and_moved_and_their_selection_is_that_of_the_views() {
    let mut window = window(two());
    let start = session(&window).design().clone();
    // A click at a cable, with the first tool, picks it out in the list; a click beside it lets it go.
    let at = on_screen(&window, "Idealized view", [50.0, 0.0]);
    window.hover_at(at);
    window.drag_at(at);
    window.drop_at(at);
    settle(&mut window);
    assert_eq!(session(&window).selection(), Selection::Part(Part::Tendon(1, 0)));
    assert!(session(&window).design().poses.is_empty());
    click(&mut window, "Up");
    let names: Vec<&str> = session(&window).design().networks.iter().map(|n| n.name.as_str()).collect();
    assert_eq!(names, ["low", "winch 1"]);
    assert_eq!(session(&window).selection(), Selection::Part(Part::Winch(0)));
    click(&mut window, "Down");
    assert_eq!(session(&window).design().networks, start.networks);
    click(&mut window, "Colour of low");
    click(&mut window, "Colour 6");
    assert_eq!(session(&window).design().networks[1].color, Some([190, 60, 130]));
    click(&mut window, "Colour of low");
    click(&mut window, "By its number");
    assert_eq!(session(&window).design().networks[1].color, None);
    for _ in 0..4 {
        click(&mut window, "Undo");
    }
    assert_eq!(**session(&window).design(), *start);
}
