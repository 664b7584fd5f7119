//! What is seen: names, theme, quality, figures, hidden views.

use crate::support::window::{Window, bar, click, pose, press, session, settle, wait, window, with_network};
use eframe::egui::{self, Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};
use plushwright::engine::{EQUILIBRIUM, Quality};
use plushwright::picture::palette::Theme;
use plushwright::studio::session::Views;
use plushwright::studio::viewport::Plushie;
use std::sync::Arc;
use std::time::Duration;

#[test]
fn everything_has_an_accessible_name() {
    let mut window = window(bar());
    for name in [
        "File",
        "Save",
        "Undo",
        "Redo",
        "Drag tool",
        "Pin tool",
        "Fit view",
        "Show fibres",
        "Show networks",
        "Show idealized view",
        "Show realizable view",
        "Export",
        "Dark theme",
        "Add pose",
        "Rest",
        "Idealized view",
        "Realizable view",
        "Networks",
        "Mesh",
        "Settings",
        "Propose networks",
        "Play",
        "Loop",
        "Add keyframe",
        "Timeline",
    ] {
        window.get_by_label(name);
    }
    window.get_by_role_and_label(egui::accesskit::Role::ComboBox, "Quality");
    // `run` checks that no control is without a name.
    click(&mut window, "Settings");
    for name in ["Mu", "Kappa", "Tendon stiffness", "Seam allowance", "Gear ratio"] {
        assert!(window.query_by_label(name).is_some() || window.query_all_by_label(name).count() > 0, "{name}");
    }
}

#[test]
fn the_theme_can_be_switched() {
    let mut window = window(bar());
    click(&mut window, "Dark theme");
    assert_eq!(session(&window).look().theme, Theme::Dark);
    assert!(window.ctx.global_style().visuals.dark_mode);
    click(&mut window, "Light theme");
    assert_eq!(session(&window).look().theme, Theme::Light);
}

#[test]
fn the_quality_of_the_next_frames_can_be_chosen() {
    let mut window = window(bar());
    let asked = |window: &Window| session(window).request().map(|request| request.quality);
    assert_eq!(asked(&window), Some(Quality::Balanced));
    window.get_by_role_and_label(egui::accesskit::Role::ComboBox, "Quality").click();
    settle(&mut window);
    click(&mut window, "Accurate");
    assert_eq!(asked(&window), Some(Quality::Accurate));
    window.get_by_label("Accurate quality, settled");
    press(&mut window, Modifiers::NONE, Key::Q);
    assert_eq!(asked(&window), Some(Quality::Draft));
    // Escape closes the list and does nothing else.
    window.get_by_role_and_label(egui::accesskit::Role::ComboBox, "Quality").click();
    settle(&mut window);
    assert!(window.query_by_label("Accurate").is_some());
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.query_by_label("Accurate").is_none());
    assert_eq!(asked(&window), Some(Quality::Draft));
    // It belongs to the user, not to the document.
    assert!(!session(&window).history().is_modified());
    click(&mut window, "Examples");
    window.get_by_label("Robot").click();
    wait(&mut window, |s| s.design().name != "Bar");
    settle(&mut window);
    assert_eq!(asked(&window), Some(Quality::Draft));
}

#[test]
fn the_status_tells_what_a_shape_cost_and_is_worth() {
    let mut window = with_network();
    for (view, shape) in
        [("Idealized", &session(&window).shapes().idealized), ("Realizable", &session(&window).shapes().realizable)]
    {
        let shape = shape.as_ref().unwrap();
        assert!(shape.converged && shape.distance_from_equilibrium() < EQUILIBRIUM);
        let error_mm = format!("{:.2} mm", shape.target_error * session(&window).design().body_length_mm());
        let text = text_with(&window, view);
        for figure in [format!("{:.1} ms", shape.milliseconds), error_mm, "%".into(), "in equilibrium".into()] {
            assert!(text.contains(&figure), "{figure}: {text}");
        }
    }
    window.get_by_label_contains("Balanced quality, ");
    click(&mut window, "Rest");
    assert!(text_with(&window, "Realizable").contains("no targets"));
}

/// The line of the status that begins with these words.
fn text_with(window: &Window, start: &str) -> String {
    let start = format!("{start} ");
    let lines = window.get_all_by_label_contains(&start);
    let mut texts = lines.filter_map(|node| node.accesskit_node().value().or(node.accesskit_node().label()));
    texts.find(|text| text.starts_with(&start)).expect("a line of figures")
}

#[test]
fn a_view_can_be_hidden_and_is_not_solved_then() {
    let mut window = window(bar());
    let whole = window.get_by_label("Idealized view").rect().width() * 2.0;
    click(&mut window, "Show realizable view");
    assert_eq!(session(&window).look().views, Views::Only(Plushie::Idealized));
    assert!(window.query_by_label("Realizable view").is_none());
    assert!(window.get_by_label("Idealized view").rect().width() > 0.98 * whole);
    assert_eq!(session(&window).request().unwrap().solves(), [true, false]);
    assert!(text_with(&window, "Realizable").contains("hidden, not solved"));
    let before = session(&window).shapes().realizable.clone().unwrap();
    pose(&mut window, "Idealized view");
    assert!(Arc::ptr_eq(&before, session(&window).shapes().realizable.as_ref().unwrap()), "it was solved");
    // Hiding the last one shows the other one.
    press(&mut window, Modifiers::NONE, Key::Num1);
    assert_eq!(session(&window).look().views, Views::Only(Plushie::Realizable));
    assert_eq!(session(&window).request().unwrap().solves(), [false, true]);
    assert!(!Arc::ptr_eq(&before, session(&window).shapes().realizable.as_ref().unwrap()));
    press(&mut window, Modifiers::NONE, Key::Num1);
    assert_eq!(session(&window).look().views, Views::Both);
    window.get_by_label("Idealized view");
    window.get_by_label("Realizable view");
}

#[test]
fn nothing_is_drawn_while_nothing_changes() {
    let mut window = window(bar());
    pose(&mut window, "Idealized view");
    window.run();
    let viewport = window.output().viewport_output.values().next().unwrap();
    assert_eq!(viewport.repaint_delay, Duration::MAX);
}
