//! Menus under the pointer, the keys that lists are sorted by, motion that is asked to be less, figures without a sign before zero.

use crate::support::window::{
    Window, bar, click, network, on_screen, pose, press, proposal, services, session, settle, wait, window,
    window_with, with_network,
};
use eframe::egui::{self, Key, Modifiers, Pos2, accesskit};
use egui_kittest::kittest::Queryable;
use plushwright::design::{Design, Easing, MaterialPoint, Network, Tendon};
use plushwright::rigging::{PoseServed, Proposal, Sewn};
use plushwright::studio::session::Services;
use std::sync::Arc;

fn open(window: &mut Window, pos: Pos2) {
    window.hover_at(pos);
    window.step();
    for pressed in [true, false] {
        let button = egui::PointerButton::Secondary;
        window.event(egui::Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE });
    }
    settle(window);
}

fn center(window: &Window, name: &str) -> Pos2 {
    window.get_by_label(name).rect().center()
}

#[test]
fn menus_of_poses_and_keyframes_do_what_they_say() {
    let mut window = with_network();
    let menu = |window: &mut Window, on: &str, entry: &str| {
        let at = center(window, on);
        open(window, at);
        // A button of the toolbar or the list may be called so too: entries are as wide as their menu.
        let width = |node: &egui_kittest::Node<'_>| node.rect().width();
        window.get_all_by_label(entry).max_by(|a, b| width(a).total_cmp(&width(b))).expect("an entry").click();
        settle(window);
    };
    menu(&mut window, "Pose 1", "Duplicate pose");
    assert_eq!(session(&window).design().poses.len(), 2);
    menu(&mut window, "Pose 1", "Add keyframe");
    assert_eq!(session(&window).design().keyframes.len(), 1);
    click(&mut window, "Rest");
    click(&mut window, "Add keyframe");
    menu(&mut window, "Keyframe 2", "Later");
    assert!(session(&window).design().keyframes[1].time_s > 1.0);
    menu(&mut window, "Keyframe 1", "Copy keyframes");
    menu(&mut window, "Keyframe 2", "Paste keyframes");
    assert_eq!(session(&window).design().keyframes.len(), 3);
    menu(&mut window, "Keyframe 3", "Delete keyframes");
    menu(&mut window, "Pose 1", "Remove all targets");
    menu(&mut window, "Pose 1", "Delete pose");
    let design = session(&window).design();
    assert_eq!((design.poses.len(), design.keyframes.len()), (1, 2));
    assert!(design.keyframes.iter().all(|key| key.easing == Easing::Smooth));
}

#[test]
fn a_menu_begins_with_what_lies_under_the_pointer_and_goes_on_with_the_body() {
    let mut design = bar();
    let mut network = network();
    network.tendons[0].routing = MaterialPoint::through([14, 10, 12]);
    design.networks.push(network);
    let mut window = window(design);
    let at = on_screen(&window, "Realizable view", [60.0, 20.0]);
    open(&mut window, at);
    let tops = ["Remove hole", "Pin this point", "Fit view"]
        .map(|entry| window.get_all_by_label(entry).map(|node| node.rect().top()).fold(0.0, f32::max));
    assert!(tops.windows(2).all(|pair| pair[0] < pair[1]), "{tops:?}");
    // Beside the body there is nothing to remove or to pin.
    press(&mut window, Modifiers::NONE, Key::Escape);
    let view = window.get_by_label("Realizable view").rect();
    open(&mut window, view.left_bottom() + egui::vec2(40.0, -40.0));
    assert!(window.query_by_label("Remove hole").is_none() && window.query_by_label("Pin this point").is_none());
    press(&mut window, Modifiers::NONE, Key::Escape);
    // A target and a pin have their own.
    pose(&mut window, "Idealized view");
    let target = session(&window).design().poses[0].targets[0].to;
    let at = on_screen(&window, "Idealized view", target);
    open(&mut window, at);
    click(&mut window, "Remove target");
    assert!(session(&window).design().poses[0].targets.is_empty());
    let pins = session(&window).design().pins.len();
    let at = on_screen(&window, "Idealized view", [0.0, 0.0]);
    open(&mut window, at);
    click(&mut window, "Unpin");
    assert_eq!(session(&window).design().pins.len(), pins - 1);
}

/// Proposals that differ in every figure that they are sorted by, each the best in one or two.
fn various(design: &Design) -> Vec<Arc<Proposal>> {
    let of = |k: usize, figures: [f64; 6]| {
        let [error, worst, sewn, force_n, thread_mm, holes] = figures;
        let tendon = Tendon { routing: MaterialPoint::through(k..k + 6), ratio: 1.0, slack_mm: 0.0 };
        let poses = [("Pose 1", error), ("Pose 2", worst)].map(|(name, after)| PoseServed {
            name: Some(name.into()),
            before: 0.9,
            after,
            with_friction: None,
        });
        Arc::new(Proposal {
            network: Network::new("winch 1", vec![tendon]),
            poses: poses.into(),
            sewn: Some(Sewn { median: sewn, worst: 2.0 * sewn }),
            force_n,
            thread_mm,
            holes: holes as usize,
            paper: None,
            ..proposal(design, error)
        })
    };
    vec![
        of(0, [0.3, 0.4, 0.5, 1.0, 90.0, 7.0]),
        of(1, [0.1, 0.6, 0.3, 3.0, 50.0, 9.0]),
        of(2, [0.2, 0.25, 0.4, 2.0, 70.0, 5.0]),
    ]
}

#[test]
fn candidates_are_sorted_by_every_figure() {
    let propose = Arc::new(|design: &Design, _: &_, _: &_, _: &mut dyn FnMut(&[Arc<Proposal>]), _: &_| various(design));
    let mut window = window_with(bar(), Services { propose, ..services() });
    pose(&mut window, "Idealized view");
    click(&mut window, "Propose networks");
    for (order, sorted) in [
        ("This pose", [1, 2, 0]),
        ("Worst pose", [2, 0, 1]),
        ("Sewn by hand", [1, 2, 0]),
        ("Least force", [0, 2, 1]),
        ("Least cable", [1, 2, 0]),
        ("Fewest holes", [2, 0, 1]),
        ("Best to make", [0, 1, 2]),
    ] {
        window.get_by_role_and_label(accesskit::Role::ComboBox, "Sorted by").click();
        window.run();
        window.get_by_label(order).click();
        settle(&mut window);
        assert_eq!(session(&window).discovery().sorted(), sorted, "{order}");
        let tops = sorted.map(|k| window.get_by_label(&format!("Proposal {}", k + 1)).rect().top());
        assert!(tops.windows(2).all(|pair| pair[0] < pair[1]), "{order}: {tops:?}");
    }
}

#[test]
fn with_reduced_motion_nothing_moves_by_itself() {
    let mut design = bar();
    design.networks.push(network());
    let mut window = window(design);
    assert!(window.ctx.global_style().animation_time > 0.0);
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::P);
    window.get_by_label("Look for a command").type_text("Reduced motion");
    window.run();
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert!(session(&window).look().still && window.ctx.global_style().animation_time == 0.0);
    // A candidate under the pointer is shown, and does not strike its poses in turn.
    pose(&mut window, "Idealized view");
    click(&mut window, "Add pose");
    pose(&mut window, "Idealized view");
    click(&mut window, "Propose networks");
    wait(&mut window, |s| s.tasks().running("gallery.poses").is_none() && s.tasks().running("gallery.cards").is_none());
    window.get_by_label("Proposal 2").scroll_to_me();
    window.run();
    let card = center(&window, "Proposal 2");
    window.hover_at(card);
    window.run_steps(4);
    wait(&mut window, |s| s.tasks().running("gallery.poses").is_none());
    window.run_steps(4);
    let hovered = session(&window).discovery().hovered.clone();
    assert!(matches!(hovered, Some((1, None))), "no pose of its own is struck");
}

#[test]
fn fields_have_no_sign_before_zero() {
    let mut window = with_network();
    click(&mut window, "Rest");
    click(&mut window, "Wind by hand");
    let field = |window: &Window| window.get_by_label("Cable of winch 1 in mm").value().unwrap_or_default();
    for typed in ["-0", "-0.04", "-0.0"] {
        window.get_by_label("Cable of winch 1 in mm").click();
        window.run();
        press(&mut window, Modifiers::COMMAND, Key::A);
        window.get_by_label("Cable of winch 1 in mm").type_text(typed);
        press(&mut window, Modifiers::NONE, Key::Enter);
        assert_eq!(field(&window), "0.0 mm", "{typed}");
    }
    let minus = window.query_all_by_label_contains("-0").filter(|node| {
        let text = node.value().unwrap_or_default();
        text.split_whitespace()
            .any(|word| word.parse::<f64>().is_ok_and(|figure| figure == 0.0 && word.starts_with('-')))
    });
    assert_eq!(minus.count(), 0);
}
