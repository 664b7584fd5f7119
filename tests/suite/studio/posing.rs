//! Posing by hand: drags, pins, poses, and one step of undo for each.

use crate::support::window::{Window, bar, click, drag, network, on_screen, pose, press, session, settle, window};
use eframe::egui::{self, Key, Modifiers, Pos2, vec2};
use egui_kittest::kittest::Queryable;
use plushwright::engine::Shape;
use plushwright::studio::session::{Selection, Session};
use std::sync::Arc;

#[test]
fn dragging_the_body_makes_a_pose_that_both_plushies_follow() {
    for view in ["Idealized view", "Realizable view"] {
        let mut design = bar();
        design.networks.push(network());
        let mut window = window(design);
        let rest = session(&window).design().mesh.nodes.clone();
        pose(&mut window, view);
        let session = session(&window);
        assert_eq!(session.design().poses.len(), 1);
        let target = session.design().poses[0].targets[0];
        assert!((target.to[0] - 115.0).abs() < 1.0 && (target.to[1] - 45.0).abs() < 1.0, "{:?}", target.to);
        assert_eq!(session.selection(), Selection::Target(0));
        let end =
            |shape: &Option<Arc<Shape>>| session.design().mesh.position(&target.at, &shape.as_ref().unwrap().nodes);
        let start = session.design().mesh.position(&target.at, &rest);
        assert!(end(&session.shapes().idealized)[1] > start[1] + 15.0);
        assert!(end(&session.shapes().realizable)[1] > start[1] + 1.0);
    }
}

#[test]
fn one_drag_is_one_undo_step_and_a_click_is_none() {
    let mut window = window(bar());
    let p = on_screen(&window, "Idealized view", [60.0, 20.0]);
    window.drag_at(p);
    window.step();
    window.drop_at(p);
    settle(&mut window);
    assert_eq!(session(&window).history().undo_label(), None);
    pose(&mut window, "Idealized view");
    assert_eq!(session(&window).history().undo_label(), Some("Add target"));
    // The goal itself can be dragged on.
    let (from, to) =
        (on_screen(&window, "Idealized view", [115.0, 45.0]), on_screen(&window, "Idealized view", [110.0, 50.0]));
    drag(&mut window, from, to);
    assert_eq!(session(&window).design().poses[0].targets.len(), 1);
    assert_eq!(session(&window).history().undo_label(), Some("Move target"));
    press(&mut window, Modifiers::COMMAND, Key::Z);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(session(&window).design().poses.is_empty());
    assert!(!session(&window).history().is_modified());
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    press(&mut window, Modifiers::COMMAND, Key::Y);
    let to = session(&window).design().poses[0].targets[0].to;
    assert!((to[0] - 110.0).abs() < 1.0 && (to[1] - 50.0).abs() < 1.0);
}

#[test]
fn a_drag_beside_the_body_moves_the_picture_and_f_fits_it_again() {
    let mut window = window(bar());
    let from = on_screen(&window, "Idealized view", [60.0, 70.0]);
    drag(&mut window, from, from + vec2(40.0, 10.0));
    assert!(session(&window).look().camera.is_some());
    assert!(session(&window).design().poses.is_empty());
    press(&mut window, Modifiers::NONE, Key::F);
    assert!(session(&window).look().camera.is_none());
}

#[test]
fn pins_by_tool_and_by_menu() {
    let mut window = window(bar());
    click(&mut window, "Pin tool");
    let p = on_screen(&window, "Realizable view", [80.0, 20.0]);
    for count in [4, 3] {
        window.hover_at(p);
        window.drag_at(p);
        window.drop_at(p);
        settle(&mut window);
        assert_eq!(session(&window).design().pins.len(), count);
    }
    press(&mut window, Modifiers::NONE, Key::V);
    window.hover_at(p);
    for pressed in [true, false] {
        let button = egui::PointerButton::Secondary;
        window.event(egui::Event::PointerButton { pos: p, button, pressed, modifiers: Modifiers::NONE });
    }
    settle(&mut window);
    click(&mut window, "Pin this point");
    assert_eq!(session(&window).design().pins.len(), 4);
}

#[test]
fn poses_are_added_renamed_duplicated_deleted_and_everything_undone() {
    let mut window = window(bar());
    let before = session(&window).design().clone();
    click(&mut window, "Add pose");
    pose(&mut window, "Idealized view");
    press(&mut window, Modifiers::NONE, Key::F2);
    window.get_by_label("Pose name").type_text(" wave");
    settle(&mut window);
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(session(&window).design().poses[0].name, "Pose 1 wave");
    click(&mut window, "Duplicate pose");
    assert_eq!(session(&window).design().poses.len(), 2);
    assert_eq!(session(&window).pose(), Some(1));
    assert_eq!(session(&window).design().poses[1].targets.len(), 1);
    click(&mut window, "Delete pose");
    click(&mut window, "Remove target 1");
    click(&mut window, "Rest");
    assert_eq!(session(&window).pose(), None);
    let mut steps = 0;
    while session(&window).history().undo_label().is_some() {
        click(&mut window, "Undo");
        steps += 1;
    }
    assert_eq!(steps, 6);
    assert_eq!(**session(&window).design(), *before);
    while session(&window).history().redo_label().is_some() {
        click(&mut window, "Redo");
    }
    assert_eq!(session(&window).design().poses.len(), 1);
    assert!(session(&window).design().poses[0].targets.is_empty());
}

#[test]
fn the_delete_key_removes_what_is_selected() {
    let mut window = window(bar());
    pose(&mut window, "Idealized view");
    press(&mut window, Modifiers::NONE, Key::Delete);
    assert!(session(&window).design().poses[0].targets.is_empty());
}

#[test]
fn a_slider_is_one_undo_step() {
    let mut window = window(bar());
    click(&mut window, "Settings");
    let value = window.get_by_role_and_label(egui::accesskit::Role::SpinButton, "Seam allowance").rect().center();
    drag(&mut window, value, value + vec2(60.0, 0.0));
    assert!(session(&window).design().fabrication.seam_allowance_mm > 8.0);
    assert_eq!(session(&window).history().undo_label(), Some("Fabrication settings"));
    click(&mut window, "Undo");
    assert_eq!(session(&window).design().fabrication.seam_allowance_mm, 8.0);
    assert_eq!(session(&window).history().undo_label(), None);
}

/// A body of which every triangle is the right way up.
fn is_whole(session: &Session) -> bool {
    let mesh = &session.design().mesh;
    let whole = |shape: &Arc<Shape>| {
        let x: Vec<f64> = shape.nodes.iter().flatten().copied().collect();
        let area = |t: &[usize; 3]| {
            let [p, q, r] = t.map(|n| [x[2 * n], x[2 * n + 1]]);
            (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1])
        };
        x.iter().all(|v| v.is_finite()) && mesh.triangles.iter().all(|t| area(t) > 0.0)
    };
    [&session.shapes().idealized, &session.shapes().realizable].into_iter().flatten().all(whole)
}

/// Presses on `from`, moves through `path` and lets go at its end; what is seen on the way is a body.
fn wave(window: &mut Window, from: Pos2, path: &[Pos2]) {
    window.hover_at(from);
    window.step();
    window.drag_at(from);
    window.step();
    for p in path {
        window.hover_at(*p);
        window.step();
        assert!(is_whole(session(window)), "at {p:?}");
    }
    window.drop_at(path[path.len() - 1]);
    settle(window);
    assert!(is_whole(session(window)));
}

#[test]
fn wild_motion_without_pins_at_any_stiffness_ends_in_a_sane_pose() {
    let mut window = window(bar());
    let there = |window: &Window, x: f64, y: f64| on_screen(window, "Idealized view", [x, y]);
    // Two targets, the second thrown about, out of the window and far beyond, and brought back.
    pose(&mut window, "Idealized view");
    let from = there(&window, 60.0, 40.0);
    let wild: Vec<Pos2> = (0..40)
        .map(|k| {
            let (angle, far) = (2.4 * k as f32, [50.0, 400.0, 3000.0, 1e6][k % 4]);
            from + far * vec2(angle.cos(), angle.sin())
        })
        .chain([there(&window, 60.0, 50.0)])
        .collect();
    wave(&mut window, from, &wild);
    assert_eq!(session(&window).design().poses[0].targets.len(), 2);
    let sane = |window: &Window| {
        let shape = session(window).shapes().idealized.clone().unwrap();
        shape.converged && shape.target_error < 0.1
    };
    assert!(sane(&window), "{:?}", session(&window).shapes().idealized.as_ref().map(|s| s.target_error));
    // One pin after the other goes.
    press(&mut window, Modifiers::NONE, Key::P);
    for (p, said) in [([0.0, 0.0], None), ([0.0, 20.0], Some("free to turn")), ([0.0, 40.0], Some("free to move"))] {
        let p = there(&window, p[0], p[1]);
        window.hover_at(p);
        window.drag_at(p);
        window.drop_at(p);
        settle(&mut window);
        let warning = session(&window).solver_warning().map(str::to_owned);
        assert_eq!(warning.is_some(), said.is_some(), "{warning:?}");
        assert!(said.is_none_or(|words| window.query_by_label_contains(words).is_some()), "{warning:?}");
    }
    assert!(session(&window).design().pins.is_empty());
    press(&mut window, Modifiers::NONE, Key::V);
    let from = there(&window, 60.0, 50.0);
    wave(&mut window, from, &wild);
    assert!(window.query_by_label_contains("free to move").is_some());
    // To the limits of the stiffness.
    click(&mut window, "Settings");
    for name in ["Mu", "Fibre stiffness"] {
        let value = window.get_by_role_and_label(egui::accesskit::Role::SpinButton, name).rect().center();
        for way in [1.0, -1.0] {
            let path: Vec<Pos2> = (1..=20).map(|k| value + vec2(way * 100.0 * k as f32, 0.0)).collect();
            wave(&mut window, value, &path);
        }
    }
    for _ in 0..20 {
        click(&mut window, "Undo");
        if session(&window).design().pins.len() == 3 {
            break;
        }
    }
    assert!(sane(&window) && session(&window).solver_warning().is_none());
}
