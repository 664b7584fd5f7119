//! What is seen in the two views: looks and their bars, cameras, overlays, onion skins, and what is lit.

use crate::support::window::{
    Window, bar, click, drag, network, on_screen, pose, press, session, settle, wait, window, with_network,
};
use eframe::egui::{Event, Key, Modifiers, PointerButton, Pos2, Shape, vec2};
use egui_kittest::kittest::Queryable;
use plushwright::design::{Design, Easing, Keyframe};
use plushwright::engine::{Setpoint, Warning, solve_once};
use plushwright::picture::LOOKS;
use plushwright::studio::session::Views;
use plushwright::studio::viewport::Plushie;
use std::sync::atomic::AtomicBool;

/// Circles of a width of line that are painted.
fn rings(window: &Window, width: f32) -> usize {
    let shapes = window.output().shapes.iter();
    shapes.filter(|clipped| matches!(&clipped.shape, Shape::Circle(circle) if circle.stroke.width == width)).count()
}

#[test]
fn a_winch_that_is_selected_in_the_list_is_lit_in_both_views() {
    let mut window = with_network();
    let before = rings(&window, 2.5);
    click(&mut window, "Network winch 1");
    assert_eq!(rings(&window, 2.5), before + 2);
    press(&mut window, Modifiers::NONE, Key::Escape);
}

#[test]
fn undo_without_pins_leaves_the_body_as_it_is_at_rest() {
    let mut design = bar();
    design.pins.clear();
    design.networks.push(network());
    let mut window = window(design);
    let (from, to) =
        (on_screen(&window, "Idealized view", [118.0, 20.0]), on_screen(&window, "Idealized view", [60.0, 70.0]));
    drag(&mut window, from, to);
    let rest = session(&window).design().mesh.nodes.clone();
    let far = |window: &Window| {
        let shapes = session(window).shapes();
        let nodes = [&shapes.idealized, &shapes.realizable].map(|shape| shape.as_ref().unwrap().nodes.clone());
        let away = |nodes: &Vec<[f64; 2]>| {
            nodes.iter().zip(&rest).map(|(p, q)| (p[0] - q[0]).hypot(p[1] - q[1])).fold(0.0, f64::max)
        };
        away(&nodes[0]).max(away(&nodes[1]))
    };
    assert!(far(&window) > 10.0);
    while session(&window).history().undo_label().is_some() {
        press(&mut window, Modifiers::COMMAND, Key::Z);
    }
    assert!(far(&window) < 1e-6, "{}", far(&window));
}

#[test]
fn a_double_click_leaves_the_zoom() {
    let mut window = window(bar());
    press(&mut window, Modifiers::NONE, Key::Plus);
    let camera = session(&window).look().camera;
    assert!(camera.is_some());
    let middle = window.get_by_label("Realizable view").rect().center();
    for pos in [middle, middle - vec2(0.0, 200.0)] {
        window.hover_at(pos);
        for pressed in [true, false, true, false] {
            let button = PointerButton::Primary;
            window.event(Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE });
        }
        settle(&mut window);
    }
    assert_eq!(session(&window).look().camera, camera);
}

#[test]
fn the_body_fills_its_view() {
    let window = window(bar());
    let rect = window.get_by_label("Idealized view").rect();
    let at = |p| window.state().as_ref().unwrap().on_screen(Plushie::Idealized, p).unwrap();
    let (low, high) = (at([0.0, 0.0]), at([120.0, 40.0]));
    let part = ((high.x - low.x) / rect.width()).max((low.y - high.y) / rect.height());
    assert!((0.85..0.95).contains(&part), "{part}");
    assert!(rect.contains(low) && rect.contains(high));
}

#[test]
fn a_crumpled_body_is_told_and_not_called_in_equilibrium() {
    let mut design = bar();
    design.networks.push(network());
    let wound = |mm: f64| {
        let setpoint = Setpoint::Activations(vec![mm]);
        solve_once(&design, setpoint, [false, true], &AtomicBool::new(false)).realizable.unwrap()
    };
    assert_eq!(wound(10.0).warning, None);
    let crumpled = wound(85.0);
    assert!(crumpled.warning.as_ref().is_some_and(Warning::is_crumpled), "{:?}", crumpled.warning);
    design.keyframes = vec![key(0.0, 85.0), key(0.2, 85.0)];
    let mut window = window(design);
    window.get_by_label("Play").click();
    wait(&mut window, |s| s.playback().playing);
    window.key_press(Key::Space);
    wait(&mut window, |s| !s.playback().playing);
    settle(&mut window);
    assert!(session(&window).solver_warning().is_some_and(|words| words.contains("felt would fold")));
    let line = window.get_by_label_contains("Realizable  ");
    let text = format!("{line:?}");
    assert!(text.contains("crumpled") && !text.contains("in equilibrium"), "{text}");
}

fn key(time_s: f64, wound_mm: f64) -> Keyframe {
    Keyframe { time_s, activations_mm: vec![wound_mm], pose: None, easing: Easing::Smooth }
}

/// Chooses from a menu over the views.
fn choose(window: &mut Window, menu: &str, entry: &str) {
    click(window, menu);
    click(window, entry);
}

#[test]
fn every_look_can_be_chosen_and_colours_say_what_they_are() {
    let mut window = with_network();
    assert_eq!(session(&window).look().body, "plush");
    for look in LOOKS {
        choose(&mut window, "Look", look.label);
        assert_eq!(session(&window).look().body, look.name);
        let told = |window: &Window, words: &str| window.query_all_by_label_contains(words).count();
        let bars = match look.name {
            "force" => told(&window, "Cable force from 0 to"),
            "strain" => told(&window, "(det F) from"),
            "crumpling" => told(&window, "Pressure of crumpling from 0 to"),
            "contraction" => told(&window, "Contraction of fibres from 0 to"),
            "gap" => told(&window, "Distance between the plushies from 0 to"),
            _ => 2,
        };
        assert_eq!(bars, 2, "{}", look.name);
    }
    // It belongs to the user, not to the document.
    assert!(session(&window).history().undo_label() == Some("Add target"));
}

#[test]
fn the_selection_fills_the_views_and_with_none_the_posed_plushies_do() {
    let mut window = with_network();
    // The target that was made is selected: its goal is in the middle.
    press(&mut window, Modifiers::SHIFT, Key::F);
    let target = session(&window).look().camera.expect("framed");
    assert!((target.center[0] - 115.0).abs() < 10.0 && target.center[1] > 30.0, "{target:?}");
    click(&mut window, "Pose 1");
    press(&mut window, Modifiers::SHIFT, Key::F);
    let posed = session(&window).look().camera.expect("framed");
    let shapes = |window: &Window| session(window).shapes().idealized.clone().unwrap().nodes.clone();
    let inside = |window: &Window, p: [f64; 2]| {
        let at: Pos2 = window.state().as_ref().unwrap().on_screen(Plushie::Idealized, p).unwrap();
        window.get_by_label("Idealized view").rect().contains(at)
    };
    settle(&mut window);
    assert!(shapes(&window).iter().all(|&p| inside(&window, p)));
    click(&mut window, "Remove target 1");
    click(&mut window, "Network winch 1");
    choose(&mut window, "View", "Fit selection");
    let framed = session(&window).look().camera.expect("framed");
    assert!(framed != posed && framed.scale > 0.0);
    // The tendon runs along the upper side: its middle is that of the view.
    assert!(framed.center[1] > 30.0, "{framed:?}");
    press(&mut window, Modifiers::NONE, Key::F);
    assert_eq!(session(&window).look().camera, None);
}

#[test]
fn a_goal_far_beside_the_body_is_fitted_too() {
    let mut design = bar();
    let at = design.mesh.node_point(design.mesh.nearest_node([120.0, 40.0], &design.mesh.nodes)).unwrap();
    let far = [120.0, 400.0];
    let targets = vec![plushwright::design::Target { at, to: far, weight: 1.0 }];
    design.poses.push(plushwright::design::Pose { name: "far".into(), targets });
    let mut window = window(design);
    click(&mut window, "far");
    press(&mut window, Modifiers::NONE, Key::F);
    window.run_steps(3);
    for (view, plushie) in [("Idealized view", Plushie::Idealized), ("Realizable view", Plushie::Realizable)] {
        let rect = window.get_by_label(view).rect();
        let places = [far, [0.0, 0.0], [120.0, 40.0]];
        let places = places.map(|p| window.state().as_ref().unwrap().on_screen(plushie, p).unwrap());
        assert!(places.iter().all(|&p: &Pos2| rect.contains(p)), "{view} {rect:?}: {places:?}");
    }
    click(&mut window, "Rest");
    press(&mut window, Modifiers::NONE, Key::F);
    assert_eq!(session(&window).look().camera, None);
}

#[test]
fn cameras_are_linked_until_they_are_freed() {
    let mut window = window(bar());
    let beside = on_screen(&window, "Realizable view", [60.0, 65.0]);
    choose(&mut window, "View", "Linked cameras");
    drag(&mut window, beside, beside + vec2(30.0, 10.0));
    let look = session(&window).look();
    assert!(look.camera.is_none() && look.apart.is_some());
    assert_eq!(look.camera_of(Plushie::Realizable), look.apart);
    choose(&mut window, "View", "Linked cameras");
    assert_eq!(session(&window).look().camera_of(Plushie::Realizable), None);
    let beside = on_screen(&window, "Realizable view", [60.0, 65.0]);
    drag(&mut window, beside, beside + vec2(30.0, 10.0));
    assert!(session(&window).look().camera.is_some());
}

#[test]
fn views_of_a_wide_body_stand_one_above_the_other_where_that_is_wanted() {
    let mut window = window(bar());
    let views = |window: &Window| ["Idealized view", "Realizable view"].map(|name| window.get_by_label(name).rect());
    let scale = |window: &Window| {
        let at = |x: f64| window.state().as_ref().unwrap().on_screen(Plushie::Realizable, [x, 0.0]).unwrap().x;
        at(100.0) - at(0.0)
    };
    let ([left, right], before) = (views(&window), scale(&window));
    assert!(left.right() <= right.left() && left.top() == right.top());
    choose(&mut window, "View", "Stack views of wide bodies");
    settle(&mut window);
    let [above, below] = views(&window);
    assert!(above.bottom() <= below.top() && above.left() == below.left() && scale(&window) > 1.5 * before);
    choose(&mut window, "View", "Stack views of wide bodies");
    settle(&mut window);
    assert_eq!(views(&window), [left, right]);
}

#[test]
fn one_view_holds_both_in_an_overlay() {
    let mut window = window(bar());
    press(&mut window, Modifiers::NONE, Key::Num3);
    assert_eq!(session(&window).look().views, Views::Overlay);
    assert!(window.query_by_label("Idealized view").is_none());
    pose(&mut window, "Realizable view");
    assert_eq!(session(&window).request().unwrap().solves(), [true, true]);
    press(&mut window, Modifiers::NONE, Key::Num3);
    assert_eq!(session(&window).look().views, Views::Both);
}

#[test]
fn rulers_are_shown_and_hidden() {
    let mut window = window(bar());
    choose(&mut window, "View", "Rulers and grid");
    assert!(session(&window).look().rulers);
    press(&mut window, Modifiers::SHIFT, Key::R);
    assert!(!session(&window).look().rulers);
}

/// With a network and keyframes that wind it to and fro.
fn animated() -> Design {
    let mut design = bar();
    design.networks.push(network());
    design.keyframes = vec![key(0.0, 0.0), key(1.0, 15.0), key(2.0, 5.0)];
    design
}

#[test]
fn onion_skins_are_the_plushie_at_the_neighbouring_keyframes() {
    let design = animated();
    let at = |mm: f64| solve_once(&design, Setpoint::Activations(vec![mm]), [false, true], &AtomicBool::new(false));
    let expected = at(15.0).realizable.unwrap().nodes;
    let mut window = window(design.clone());
    press(&mut window, Modifiers::SHIFT, Key::K);
    wait(&mut window, |s| s.look().onion.shapes[1].is_some());
    let onion = &session(&window).look().onion;
    assert!(onion.on && onion.shapes[0].is_none());
    assert_eq!(onion.shapes[1].as_ref().unwrap().nodes, expected);
    press(&mut window, Modifiers::SHIFT, Key::K);
    wait(&mut window, |s| s.look().onion.shapes[1].is_none());
}

#[test]
fn any_size_is_survived_and_the_plushies_are_there_again() {
    let mut window = with_network();
    for (width, height) in [(300.0, 200.0), (1.0, 1.0), (0.0, 0.0), (2000.0, 30.0), (90.0, 1200.0), (1280.0, 800.0)] {
        window.set_size(vec2(width, height));
        for _ in 0..3 {
            window.step();
        }
    }
    settle(&mut window);
    assert!(window.get_by_label("Idealized view").rect().width() > 300.0);
    pose(&mut window, "Realizable view");
}
