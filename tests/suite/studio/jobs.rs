//! Work that takes a while: how far it is, and stopping it; what came of it, shown where it belongs.

use crate::support::window::{
    Window, bar, click, enter_path, network, open, press, services, session, settle, wait, window, window_with,
};
use eframe::egui::{self, Key, Modifiers};
use egui_kittest::kittest::Queryable;
use plushwright::design::{Design, MaterialPoint, bundled};
use plushwright::operations::Progress;
use plushwright::studio::session::Services;
use std::sync::Arc;
use std::time::Duration;

/// A click that nobody waits for.
fn press_at(window: &mut Window, at: egui::Pos2) {
    window.hover_at(at);
    window.step();
    window.drag_at(at);
    window.step();
    window.drop_at(at);
    window.step();
}

fn strung() -> Design {
    let mut design = bar();
    design.networks.push(network());
    design
}

#[test]
fn an_export_tells_how_far_it_is_and_is_stopped_without_a_trace() {
    let export =
        Arc::new(|_: &_, folder: &std::path::Path, _: &_, context: &mut plushwright::operations::Context<'_>| {
            context.tell(&Progress::Part { done: 2, of: 9 });
            loop {
                context.check().map_err(|error| error.to_string())?;
                assert!(!folder.exists());
                std::thread::sleep(Duration::from_millis(1));
            }
        });
    let mut window = window_with(strung(), Services { export, ..services() });
    let folder = tempfile::tempdir().unwrap();
    press(&mut window, Modifiers::COMMAND, Key::E);
    enter_path(&mut window, &folder.path().join("blueprint"));
    window.run_steps(3);
    let export = window.get_all_by_label("Export").map(|button| button.rect().center());
    let below = export.max_by(|a, b| a.y.total_cmp(&b.y)).expect("the dialog's own");
    press_at(&mut window, below);
    wait(&mut window, |s| s.working_at() == Some([2, 9]));
    assert!(window.query_by_label("Exporting the blueprint, 2 of 9…").is_some());
    click(&mut window, "Stop work");
    wait(&mut window, |s| !s.is_working());
    let told: Vec<_> = session(&window).messages().list().iter().map(|message| message.text.clone()).collect();
    assert!(told.iter().any(|text| text == "No blueprint was written: cancelled"), "{told:?}");
    assert!(!folder.path().join("blueprint").exists() && window.query_by_label("Stop work").is_none());
}

#[test]
fn a_preview_of_a_blueprint_is_cancelled_and_made_again() {
    let mut window = window(bundled::ALL[0].design().unwrap());
    press(&mut window, Modifiers::COMMAND, Key::E);
    let made = |window: &Window| window.query_by_label("Sheet").is_some();
    window.get_by_label("Preview").click();
    window.run_steps(3);
    window.get_by_label("Cancel preview").click();
    window.run_steps(3);
    assert!(session(&window).tasks().running("blueprint.preview").is_none() && !made(&window));
    // What the one before still tells is not wanted.
    window.get_by_label("Preview").click();
    wait(&mut window, |s| s.tasks().running("blueprint.preview").is_some());
    wait(&mut window, |s| s.tasks().running("blueprint.preview").is_none());
    window.run();
    assert!(made(&window));
}

#[test]
fn what_answers_the_export_stays_in_the_window_and_the_dialog_shrinks_again() {
    let mut window = window(bundled::ALL[0].design().unwrap());
    press(&mut window, Modifiers::COMMAND, Key::E);
    settle(&mut window);
    let bottom = |window: &Window| window.get_by_label("Cancel").rect().bottom();
    let before = bottom(&window);
    for name in ["Parts and sheets", "Controllers"] {
        click(&mut window, name);
    }
    window.get_by_label("Preview").scroll_to_me();
    window.run_steps(4);
    window.get_by_label("Preview").click();
    wait(&mut window, |s| s.tasks().running("blueprint.preview").is_some());
    wait(&mut window, |s| s.tasks().running("blueprint.preview").is_none());
    window.run();
    let inside = egui::Rect::from_min_size(egui::Pos2::ZERO, egui::vec2(1280.0, 800.0));
    for name in ["Path", "Cancel"] {
        assert!(
            inside.contains_rect(window.get_by_label(name).rect()),
            "{name}: {:?}",
            window.get_by_label(name).rect()
        );
    }
    assert!(bottom(&window) > before + 100.0);
    for name in ["Parts and sheets", "Controllers"] {
        window.get_by_label(name).scroll_to_me();
        window.run_steps(4);
        click(&mut window, name);
    }
    // Another blueprint is asked for: the preview goes, and its room with it.
    window.get_by_label("Compensate for stuffing").scroll_to_me();
    window.run_steps(4);
    click(&mut window, "Compensate for stuffing");
    settle(&mut window);
    window.run_steps(4);
    let after = bottom(&window);
    assert!((after - before).abs() < 4.0, "{before} {after}");
}

#[test]
fn a_remark_on_a_blueprint_is_shown_at_its_place_on_the_body() {
    let mut design = strung();
    // Its end is on the seam.
    design.networks[0].tendons[0].routing = MaterialPoint::through([9, 20]);
    let mut window = window(design);
    press(&mut window, Modifiers::COMMAND, Key::E);
    window.get_by_label("Preview").click();
    wait(&mut window, |s| s.tasks().running("blueprint.preview").is_some());
    wait(&mut window, |s| s.tasks().running("blueprint.preview").is_none());
    window.run();
    let rings = |window: &Window| {
        let ring =
            |shape: &egui::Shape| matches!(shape, egui::Shape::Circle(c) if c.radius == 16.0 && c.stroke.width == 2.0);
        window.output().shapes.iter().filter(|clipped| ring(&clipped.shape)).count()
    };
    assert_eq!(rings(&window), 0);
    let remark = window.get_by_label_contains("mm from the seam").rect();
    let beside = window.get_all_by_label("Show me").find(|button| (button.rect().top() - remark.top()).abs() < 12.0);
    beside.expect("a button beside the remark").click();
    settle(&mut window);
    let at = session(&window).look().marked.clone().expect("marked").1;
    let mesh = &session(&window).design().mesh;
    assert_eq!(mesh.position(&at[0], &mesh.nodes), mesh.nodes[20]);
    // In both views, which look there.
    assert_eq!(rings(&window), 2 * at.len());
    assert!(window.query_by_label("Path").is_none() && session(&window).look().camera.is_some());
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(rings(&window), 0);
}

#[test]
fn what_has_the_focus_keeps_it_when_figures_arrive() {
    // The end of its cable is on the seam, which a thread finds out: a sign appears beside the network.
    let mut design = strung();
    design.networks[0].tendons[0].routing = MaterialPoint::through([9, 20]);
    let mut window = open(design, None, services(), None);
    window.run_steps(2);
    window.get_by_label("Network winch 1").focus();
    window.run_steps(2);
    assert!(window.get_by_label("Network winch 1").is_focused());
    wait(&mut window, |s| !s.judging().breaches().is_empty());
    window.run();
    assert!(window.query_by_label("Network winch 1 is hard to sew").is_some());
    assert!(window.get_by_label("Network winch 1").is_focused());
}

#[test]
fn a_rig_that_takes_too_long_is_stopped_and_the_best_so_far_is_built_in() {
    // Three poses: it does not end by itself in a moment.
    let mut design = bundled::ALL.iter().find(|made| made.name == "Puppy").unwrap().design().unwrap();
    design.networks.clear();
    design.keyframes.clear();
    let mut window = window(design);
    click(&mut window, "All poses");
    window.get_by_label("Rig all poses").scroll_to_me();
    settle(&mut window);
    assert!(window.query_by_label("Take the best so far").is_none());
    window.get_by_label("Rig all poses").click();
    // A round is told once there is something to keep.
    wait(&mut window, |s| s.rigging().step().starts_with("Round"));
    window.get_by_label("Take the best so far").scroll_to_me();
    window.run_steps(3);
    window.get_by_label("Take the best so far").click();
    settle(&mut window);
    let design = session(&window).design().clone();
    assert!(!design.networks.is_empty() && design.keyframes.len() == 5, "{} keys", design.keyframes.len());
    // Shown for a few seconds, and in the log from then on.
    let told: Vec<_> = session(&window).messages().log().map(|(_, message)| message.text.clone()).collect();
    assert!(told.iter().any(|text| text == "The best winches and tendons so far were built in."), "{told:?}");
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(session(&window).design().networks.is_empty() && session(&window).design().keyframes.is_empty());
}
