//! Winches and tendons by hand: dragged, added, given away, with the error of every pose and broken rules at once.

use crate::support::window::{
    Window, bar, click, drag, network, on_screen, press, session, settle, wait, window, with_network,
};
use eframe::egui::{self, Key, Modifiers, Pos2, vec2};
use egui_kittest::kittest::Queryable;
use plushwright::design::{Design, MaterialPoint, Network, Tendon};
use plushwright::operations::network::Part;
use plushwright::operations::{Context, check};
use plushwright::studio::session::Selection;
use std::sync::atomic::AtomicBool;

/// The bar with a winch in the middle that has two tendons, and one on the right.
fn strung() -> Design {
    let mut design = bar();
    let tendon =
        |nodes: &[usize]| Tendon { routing: MaterialPoint::through(nodes.iter().copied()), ratio: 1.0, slack_mm: 0.0 };
    design.networks.push(Network::new("left", vec![tendon(&[8, 16, 18]), tendon(&[8, 2])]));
    design.networks.push(Network::new("right", vec![tendon(&[12, 4])]));
    design
}

fn at(window: &Window, p: [f64; 2]) -> Pos2 {
    on_screen(window, "Realizable view", p)
}

fn places(window: &Window, winch: usize, tendon: usize) -> Vec<[f64; 2]> {
    let design = session(window).design();
    design.networks[winch].tendons[tendon].routing.iter().map(|p| p.place(&design.mesh.nodes)).collect()
}

fn near(p: [f64; 2], q: [f64; 2]) -> bool {
    (p[0] - q[0]).hypot(p[1] - q[1]) < 1.0
}

/// Waits until all is known of the design as it is.
fn judged(window: &mut Window) {
    wait(window, |s| s.is_settled() && s.judging().is_settled(s.design()));
    window.run();
}

#[test]
fn holes_ends_and_winches_are_dragged_each_in_one_step() {
    let mut window = window(strung());
    click(&mut window, "Tendon tool");
    for (from, to, winch, tendon, hole, label) in [
        ([40.0, 40.0], [45.0, 30.0], 0, 0, 1, "Move hole"),
        ([80.0, 40.0], [90.0, 32.0], 0, 0, 2, "Move hole"),
        ([20.0, 20.0], [25.0, 22.0], 0, 1, 0, "Move winch"),
    ] {
        let (from, to_screen) = (at(&window, from), at(&window, to));
        drag(&mut window, from, to_screen);
        assert!(near(places(&window, winch, tendon)[hole], to), "{:?}", places(&window, winch, tendon));
        assert_eq!(session(&window).history().undo_label(), Some(label));
    }
    assert!(near(places(&window, 0, 0)[0], [25.0, 22.0]), "all tendons go with their winch");
    for _ in 0..3 {
        click(&mut window, "Undo");
    }
    assert_eq!(**session(&window).design(), strung());
    assert_eq!(session(&window).history().undo_label(), None);
    for _ in 0..3 {
        click(&mut window, "Redo");
    }
    assert!(near(places(&window, 0, 0)[1], [45.0, 30.0]));
}

#[test]
fn a_hole_is_put_in_by_a_drag_and_taken_out_by_a_key() {
    let mut window = window(strung());
    press(&mut window, Modifiers::NONE, Key::W);
    let (from, to) = (at(&window, [60.0, 40.0]), at(&window, [60.0, 28.0]));
    drag(&mut window, from, to);
    assert!(near(places(&window, 0, 0)[2], [60.0, 28.0]) && places(&window, 0, 0).len() == 4);
    assert_eq!(session(&window).history().undo_label(), Some("Add hole"));
    assert_eq!(session(&window).selection(), Selection::Part(Part::Hole(0, 0, 2)));
    press(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(places(&window, 0, 0).len(), 3);
    // The tendon is selected then, and goes with the next one.
    press(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(session(&window).design().networks[0].tendons.len(), 1);
    click(&mut window, "Undo");
    click(&mut window, "Undo");
    click(&mut window, "Undo");
    assert_eq!(**session(&window).design(), strung());
}

#[test]
fn a_drag_over_the_body_draws_a_tendon_or_a_new_winch() {
    let mut window = window(strung());
    press(&mut window, Modifiers::NONE, Key::W);
    let (from, to) = (at(&window, [64.0, 10.0]), at(&window, [90.0, 10.0]));
    drag(&mut window, from, to);
    assert_eq!(session(&window).design().networks.len(), 3);
    assert!(near(places(&window, 2, 0)[0], [64.0, 10.0]) && near(places(&window, 2, 0)[1], [90.0, 10.0]));
    assert_eq!(session(&window).history().undo_label(), Some("New winch"));
    // The new one is selected: what is drawn now is its second tendon.
    let (from, to) = (at(&window, [60.0, 24.0]), at(&window, [50.0, 30.0]));
    drag(&mut window, from, to);
    assert_eq!(session(&window).design().networks[2].tendons.len(), 2);
    assert!(near(places(&window, 2, 1)[1], [50.0, 30.0]));
    assert_eq!(session(&window).history().undo_label(), Some("Add tendon"));
    // Beside the body the picture moves.
    let beside = at(&window, [60.0, 70.0]);
    drag(&mut window, beside, beside + vec2(20.0, 0.0));
    assert!(session(&window).look().camera.is_some());
    assert_eq!(session(&window).history().undo_label(), Some("Add tendon"));
}

#[test]
fn tendons_are_given_away_split_off_and_deleted_in_the_list() {
    let mut window = window(strung());
    click(&mut window, "Network left");
    assert_eq!(session(&window).selection(), Selection::Part(Part::Winch(0)));
    click(&mut window, "Tendon 2 of left");
    assert_eq!(session(&window).selection(), Selection::Part(Part::Tendon(0, 1)));
    click(&mut window, "Give tendon 2 of left");
    click(&mut window, "Give to right");
    let counts = |window: &Window| -> Vec<usize> {
        session(window).design().networks.iter().map(|network| network.tendons.len()).collect()
    };
    assert_eq!(counts(&window), [1, 2]);
    assert!(near(places(&window, 1, 1)[0], [100.0, 20.0]));
    click(&mut window, "Give tendon 2 of right");
    click(&mut window, "A winch of its own");
    assert_eq!(counts(&window), [1, 1, 1]);
    click(&mut window, "Network right");
    click(&mut window, "Delete tendon 1 of right");
    assert_eq!(counts(&window), [1, 1]);
    for _ in 0..3 {
        click(&mut window, "Undo");
    }
    assert_eq!(**session(&window).design(), strung());
}

#[test]
fn the_menu_offers_what_can_be_done_to_a_cable() {
    let mut window = window(strung());
    let menu = |window: &mut Window, p: [f64; 2], entry: &str| {
        let pos = at(window, p);
        window.hover_at(pos);
        for pressed in [true, false] {
            let button = egui::PointerButton::Secondary;
            window.event(egui::Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE });
        }
        settle(window);
        click(window, entry);
    };
    menu(&mut window, [60.0, 40.0], "Add hole");
    assert_eq!(places(&window, 0, 0).len(), 4);
    menu(&mut window, [60.0, 40.0], "Remove hole");
    assert_eq!(places(&window, 0, 0).len(), 3);
    menu(&mut window, [30.0, 30.0], "Give to right");
    assert_eq!(session(&window).design().networks[1].tendons.len(), 2);
    menu(&mut window, [100.0, 20.0], "Remove winch");
    assert_eq!(session(&window).design().networks.len(), 1);
    click(&mut window, "Network left");
    menu(&mut window, [60.0, 10.0], "Add tendon to here");
    assert_eq!(session(&window).design().networks[0].tendons.len(), 2);
}

#[test]
fn the_error_of_every_pose_follows_and_is_that_of_check() {
    let mut window = with_network();
    click(&mut window, "Duplicate pose");
    judged(&mut window);
    let checked = |window: &Window| -> Vec<f64> {
        let go = AtomicBool::new(false);
        let figures = check::run(session(window).design(), &check::Options::default(), &Context::new(&go)).unwrap();
        figures.poses.iter().map(|pose| pose.error_realizable).collect()
    };
    let shown = |window: &Window| -> Vec<f64> {
        let judging = session(window).judging();
        (0..2).map(|pose| judging.error(pose).filter(|e| e.fresh && e.thorough).unwrap().error).collect()
    };
    let before = checked(&window);
    assert_eq!(shown(&window), before);
    click(&mut window, "Tendon tool");
    click(&mut window, "Rest");
    let (from, to) = (at(&window, [100.0, 40.0]), at(&window, [70.0, 30.0]));
    // In the middle of the drag there is a first look already.
    window.hover_at(from);
    window.step();
    window.drag_at(from);
    window.step();
    window.hover_at(to);
    window.step();
    let moved = |s: &plushwright::studio::session::Session, old: f64| {
        s.judging().error(0).is_some_and(|error| !error.thorough && error.error != old)
    };
    wait(&mut window, |s| moved(s, before[0]));
    assert!(session(&window).is_dragging());
    window.drop_at(to);
    judged(&mut window);
    let after = checked(&window);
    assert!(after != before, "{after:?}");
    assert_eq!(shown(&window), after);
}

#[test]
fn broken_rules_are_told_at_their_places() {
    let mut design = bar();
    design.networks.push(network());
    let mut window = window(design);
    judged(&mut window);
    let told = |window: &Window, text: &str| window.query_by_label_contains(text).is_some();
    // The tendon lies on the seam.
    let seam = "Hard to sew: winch 1, tendon 1: hole 2 from the winch is 0.0 mm from the seam";
    assert!(!told(&window, seam), "only where tendons are worked on");
    click(&mut window, "Show idealized view");
    press(&mut window, Modifiers::NONE, Key::W);
    assert!(told(&window, seam));
    let (from, to) = (at(&window, [40.0, 40.0]), at(&window, [40.0, 25.0]));
    drag(&mut window, from, to);
    judged(&mut window);
    assert!(!told(&window, seam));
}
