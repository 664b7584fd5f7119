//! Several targets and pins at once; kinds of pins; symmetry, snapping, starch; what is out of reach.

use crate::support::window::{Window, bar, click, drag, on_screen, pose, press, session, settle, window};
use eframe::egui::{Key, Modifiers, Pos2, vec2};
use egui_kittest::kittest::Queryable;
use plushwright::design::{Design, Hold};
use plushwright::operations::arrange::Handle;
use std::sync::Arc;

fn design(window: &Window) -> Arc<Design> {
    session(window).design().clone()
}

fn at(window: &Window, p: [f64; 2]) -> Pos2 {
    on_screen(window, "Idealized view", p)
}

fn tool(window: &mut Window, key: Key) {
    press(window, Modifiers::NONE, key);
}

/// A pose with targets at two points of the bar, moved a little up.
fn two_targets() -> Window {
    let mut window = window(bar());
    press(&mut window, Modifiers::SHIFT, Key::N);
    for x in [60.0, 100.0] {
        let (from, to) = (at(&window, [x, 40.0]), at(&window, [x, 50.0]));
        drag(&mut window, from, to);
    }
    assert_eq!(design(&window).poses[0].targets.len(), 2);
    window
}

/// Draws a box around everything with the arrange tool.
fn box_around(window: &mut Window) {
    tool(window, Key::A);
    let (from, to) = (at(window, [40.0, 62.0]), at(window, [118.0, 45.0]));
    drag(window, from, to);
    assert_eq!(session(window).group().handles(), [Handle::Target(0), Handle::Target(1)]);
}

/// Back to the start and forth to the end is the same, bit for bit.
fn travels(window: &mut Window) {
    let end = design(window);
    while session(window).history().undo_label().is_some() {
        click(window, "Undo");
    }
    assert_eq!(*design(window), bar());
    while session(window).history().redo_label().is_some() {
        click(window, "Redo");
    }
    assert_eq!(design(window), end);
}

#[test]
fn targets_in_a_box_are_moved_turned_scaled_weighed_and_removed_together() {
    let mut window = two_targets();
    box_around(&mut window);
    let goals = |window: &Window| -> Vec<[f64; 2]> { design(window).poses[0].targets.iter().map(|t| t.to).collect() };
    let before = goals(&window);
    // Between the two: inside the box.
    let from = at(&window, [80.0, 50.0]);
    let by = at(&window, [83.0, 44.0]) - from;
    drag(&mut window, from, from + by);
    let moved = goals(&window);
    for (a, b) in before.iter().zip(&moved) {
        assert!((b[0] - a[0] - 3.0).abs() < 0.01 && (b[1] - a[1] + 6.0).abs() < 0.01, "{before:?} {moved:?}");
    }
    assert_eq!(session(&window).history().undo_label(), Some("Arrange"));
    // An arrow moves by a millimetre.
    press(&mut window, Modifiers::NONE, Key::ArrowUp);
    assert!((goals(&window)[1][1] - moved[1][1] - 1.0).abs() < 1e-9);
    // The knob above the middle turns by a quarter.
    let middle = at(&window, [83.0, 45.0]);
    let knob = middle - vec2(0.0, 40.0);
    drag(&mut window, knob, middle + vec2(40.0, 0.0));
    let turned = goals(&window);
    assert!((turned[0][0] - turned[1][0]).abs() < 1.0 && (turned[0][1] - turned[1][1]).abs() > 35.0, "{turned:?}");
    click(&mut window, "Undo");
    // A corner scales: half the way to the middle.
    let corner = at(&window, [goals(&window)[1][0], 45.0]) + vec2(14.0, 14.0);
    drag(&mut window, corner, middle + (corner - middle) * 0.5);
    let scaled = goals(&window);
    let width = |goals: &[[f64; 2]]| goals[1][0] - goals[0][0];
    assert!((width(&scaled) / width(&before) - 0.5).abs() < 0.01, "{scaled:?}");
    travels(&mut window);
    box_around_again(&mut window);
    press(&mut window, Modifiers::NONE, Key::Delete);
    assert!(design(&window).poses[0].targets.is_empty());
    assert_eq!(session(&window).history().undo_label(), Some("Delete selected"));
}

/// All targets, without the pins.
fn box_around_again(window: &mut Window) {
    click(window, "Pose 1");
    press(window, Modifiers::COMMAND, Key::A);
    assert_eq!(session(window).group().handles().len(), 5);
    click(window, "Target 1");
    window.get_by_label("Target 2").click_modifiers(Modifiers::COMMAND);
    settle(window);
    assert_eq!(session(window).group().handles(), [Handle::Target(0), Handle::Target(1)]);
}

#[test]
fn a_pin_that_is_dragged_moves_what_it_holds_and_makes_no_target() {
    let mut window = window(bar());
    let (from, to) = (at(&window, [0.0, 20.0]), at(&window, [6.0, 30.0]));
    drag(&mut window, from, to);
    let moved = design(&window);
    assert!(moved.poses.is_empty() && moved.pins.len() == 3);
    let position = moved.pins[1].position.unwrap();
    assert!((position[0] - 6.0).abs() < 0.1 && (position[1] - 30.0).abs() < 0.1, "{position:?}");
    assert_eq!(session(&window).history().undo_label(), Some("Move pin"));
    travels(&mut window);
    // With the pin tool it is put elsewhere on the body.
    click(&mut window, "Undo");
    tool(&mut window, Key::P);
    let (from, to) = (at(&window, [0.0, 20.0]), at(&window, [40.0, 20.0]));
    drag(&mut window, from, to);
    let pin = design(&window).pins[1];
    let place = design(&window).mesh.position(&pin.at, &design(&window).mesh.nodes);
    assert!((place[0] - 40.0).abs() < 0.1 && pin.position.is_none(), "{place:?}");
    assert_eq!(session(&window).history().undo_label(), Some("Move pin on the body"));
}

#[test]
fn pins_are_of_three_kinds_and_a_body_without_any_says_so() {
    let mut window = window(bar());
    for _ in 0..3 {
        click(&mut window, "Remove pin 1");
    }
    assert!(window.query_by_label_contains("free to move").is_some());
    click(&mut window, "Pin the middle");
    assert!(matches!(design(&window).pins[0].hold, Hold::Region { radius_mm, .. } if radius_mm > 5.0));
    assert!(window.query_by_label_contains("free to move").is_none());
    for (choice, is) in [("Line", 1), ("Point", 0), ("Region", 2)] {
        window.get_by_label("Kind of pin 1").click();
        window.run();
        window.get_by_label(choice).click();
        settle(&mut window);
        let kind = match design(&window).pins[0].hold {
            Hold::Point => 0,
            Hold::Line { .. } => 1,
            Hold::Region { .. } => 2,
        };
        assert_eq!(kind, is);
        // One that slides, or a point alone, does not hold the body.
        assert_eq!(window.query_by_label_contains("free to").is_some(), is != 2);
    }
    travels(&mut window);
}

#[test]
fn symmetry_drags_the_other_side_along_and_mirrors_a_pose() {
    let mut window = window(bar());
    click(&mut window, "Symmetric");
    let (from, to) = (at(&window, [100.0, 40.0]), at(&window, [102.0, 52.0]));
    drag(&mut window, from, to);
    let targets = design(&window).poses[0].targets.clone();
    assert_eq!(targets.len(), 2);
    assert!((targets[0].to[0] + targets[1].to[0] - 120.0).abs() < 0.01 && targets[0].to[1] == targets[1].to[1]);
    click(&mut window, "Symmetric");
    window.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::P);
    window.run();
    window.get_by_label("Look for a command").type_text("Mirrored pose");
    window.run();
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(design(&window).poses[1].name, "Pose 1 mirrored");
    travels(&mut window);
}

#[test]
fn a_goal_falls_into_line_with_its_rest() {
    let mut window = window(bar());
    let (from, to) = (at(&window, [100.0, 40.0]), at(&window, [100.0, 52.0]) + vec2(3.0, 0.0));
    drag(&mut window, from, to);
    assert_eq!(design(&window).poses[0].targets[0].to[0], 100.0);
    click(&mut window, "Snap");
    let (from, to) = (to - vec2(3.0, 0.0), to);
    drag(&mut window, from, to);
    assert!((design(&window).poses[0].targets[0].to[0] - 100.0).abs() > 0.5);
}

#[test]
fn starch_is_brushed_on_in_one_step_and_cleared() {
    let mut window = window(bar());
    tool(&mut window, Key::B);
    let (from, to) = (at(&window, [20.0, 20.0]), at(&window, [50.0, 20.0]));
    drag(&mut window, from, to);
    let map = design(&window).stiffness_map.clone().unwrap();
    assert!(map.contains(&4.0) && map.contains(&1.0), "{map:?}");
    assert_eq!(session(&window).history().undo_label(), Some("Starch"));
    let radius = session(&window).posing().brush.radius_mm;
    press(&mut window, Modifiers::NONE, Key::CloseBracket);
    assert!(session(&window).posing().brush.radius_mm > radius);
    click(&mut window, "Clear starch");
    assert_eq!(design(&window).stiffness_map, None);
    travels(&mut window);
}

#[test]
fn a_target_that_cannot_be_reached_says_so() {
    let mut window = window(bar());
    pose(&mut window, "Idealized view");
    assert!(window.query_by_label_contains("Out of reach").is_none());
    let (from, to) = (at(&window, [115.0, 45.0]), at(&window, [260.0, 45.0]));
    drag(&mut window, from, to);
    assert!(window.query_by_label_contains("Out of reach by").is_some());
}
