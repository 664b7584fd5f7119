//! Keyframes that follow their poses, are detached, replaced, selected; keys that work after a click into a view.

use crate::support::window::{click, drag, press, session, settle, wait, with_network};
use eframe::egui::{Key, Modifiers, accesskit};
use egui_kittest::kittest::Queryable;
use plushwright::design::Keyframe;
use plushwright::studio::session::Selection;

fn keyframe(window: &crate::support::window::Window, index: usize) -> Keyframe {
    session(window).design().keyframes[index].clone()
}

#[test]
fn a_keyframe_follows_its_pose_as_part_of_the_step_that_changed_it_until_it_is_fixed() {
    let mut window = with_network();
    click(&mut window, "Add keyframe");
    let before = keyframe(&window, 0);
    let steps = session(&window).history().clone();
    // The target is dragged farther up.
    let target = session(&window).design().poses[0].targets[0];
    let at = crate::support::window::on_screen(&window, "Idealized view", target.to);
    drag(&mut window, at, at + eframe::egui::vec2(0.0, -30.0));
    wait(&mut window, |s| !s.is_working() && s.design().keyframes[0] != before);
    let (followed, moved) = (keyframe(&window, 0), session(&window).design().clone());
    assert_eq!((followed.time_s, &followed.pose), (before.time_s, &before.pose));
    assert_ne!(followed.activations_mm, before.activations_mm);
    // One step back is all of it, and forth again.
    click(&mut window, "Undo");
    assert_eq!(**session(&window).design(), **steps.current());
    click(&mut window, "Redo");
    window.run_steps(8);
    assert!(!session(&window).is_working() && **session(&window).design() == *moved);
    // Fixed, it stays.
    window.get_by_label("Keyframe 1").click();
    settle(&mut window);
    click(&mut window, "Detach");
    assert_eq!((keyframe(&window, 0).pose, session(&window).history().undo_label()), (None, Some("Detach keyframe")));
    click(&mut window, "Pose 1");
    let at = crate::support::window::on_screen(&window, "Idealized view", moved.poses[0].targets[0].to);
    drag(&mut window, at, at + eframe::egui::vec2(0.0, 20.0));
    window.run_steps(8);
    settle(&mut window);
    assert_eq!(keyframe(&window, 0).activations_mm, followed.activations_mm);
}

#[test]
fn a_key_on_a_keyframe_replaces_it_and_another_pose_comes_after_the_end() {
    let mut window = with_network();
    press(&mut window, Modifiers::NONE, Key::K);
    press(&mut window, Modifiers::NONE, Key::K);
    assert_eq!(session(&window).design().keyframes.len(), 1);
    click(&mut window, "Rest");
    press(&mut window, Modifiers::NONE, Key::K);
    assert_eq!(session(&window).design().keyframes.len(), 2);
    // A click on a diamond selects it and shows it; the animation there is keyed into its place.
    window.get_by_label("Keyframe 1").click();
    settle(&mut window);
    assert_eq!((session(&window).selection(), session(&window).playback().time_s), (Selection::Keyframe(0), 0.0));
    press(&mut window, Modifiers::NONE, Key::K);
    assert_eq!((session(&window).design().keyframes.len(), keyframe(&window, 0).pose), (2, None));
}

#[test]
fn space_plays_after_a_click_into_a_view() {
    let mut window = with_network();
    click(&mut window, "Add keyframe");
    click(&mut window, "Rest");
    click(&mut window, "Add keyframe");
    let view = window.get_by_label("Realizable view").rect();
    let corner = view.left_bottom() + eframe::egui::vec2(30.0, -30.0);
    drag(&mut window, corner, corner);
    window.key_press(Key::Space);
    window.run_steps(3);
    assert!(session(&window).playback().playing);
    window.key_press(Key::Space);
    window.run_steps(3);
    assert!(!session(&window).playback().playing);
}

/// Three keyframes, at 0, 1 and 2 s.
fn three() -> crate::support::window::Window {
    let mut window = with_network();
    for name in ["Pose 1", "Rest", "Pose 1"] {
        click(&mut window, name);
        click(&mut window, "Add keyframe");
    }
    assert_eq!(times(&window), [0.0, 1.0, 2.0]);
    window
}

fn times(window: &crate::support::window::Window) -> Vec<f64> {
    session(window).design().keyframes.iter().map(|k| (k.time_s * 1e3).round() / 1e3).collect()
}

fn center(window: &crate::support::window::Window, name: &str) -> eframe::egui::Pos2 {
    window.get_by_label(name).rect().center()
}

/// Back to the start and forth again is the same, bit for bit.
fn back_and_forth(window: &mut crate::support::window::Window, steps: usize) {
    let end = session(window).design().clone();
    for _ in 0..steps {
        click(window, "Undo");
    }
    assert_eq!(times(window), [0.0, 1.0, 2.0]);
    for _ in 0..steps {
        click(window, "Redo");
    }
    assert_eq!(*session(window).design(), end);
}

#[test]
fn several_keyframes_move_stretch_and_are_copied_together() {
    let mut window = three();
    window.get_by_label("Keyframe 2").click();
    settle(&mut window);
    window.get_by_label("Keyframe 3").click_modifiers(Modifiers::COMMAND);
    settle(&mut window);
    assert_eq!(session(&window).timing().keys, [1, 2]);
    // One second is as wide as the ways between two of them.
    let second = center(&window, "Keyframe 3") - center(&window, "Keyframe 2");
    let from = center(&window, "Keyframe 2");
    drag(&mut window, from, from + 0.5 * second);
    assert_eq!(times(&window), [0.0, 1.5, 2.5]);
    assert_eq!(session(&window).history().undo_label(), Some("Move keyframes"));
    // The end of what is selected is dragged out to twice its length.
    let from = center(&window, "Stretch selected keyframes");
    drag(&mut window, from, from + second);
    assert_eq!(times(&window), [0.0, 1.5, 3.5]);
    // Copied, and pasted at the playhead.
    window.event(eframe::egui::Event::Copy);
    settle(&mut window);
    let span = center(&window, "Keyframe 1");
    drag(&mut window, span, span);
    press(&mut window, Modifiers::NONE, Key::PageDown);
    press(&mut window, Modifiers::NONE, Key::PageDown);
    assert_eq!(session(&window).playback().time_s, 3.5);
    window.event(eframe::egui::Event::Paste("not ours".into()));
    settle(&mut window);
    assert_eq!(times(&window), [0.0, 1.5, 3.5, 5.5]);
    assert_eq!(session(&window).timing().keys, [2, 3]);
    press(&mut window, Modifiers::NONE, Key::Period);
    assert_eq!(times(&window), [0.0, 1.5, 3.55, 5.55]);
    back_and_forth(&mut window, 4);
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::A);
    press(&mut window, Modifiers::NONE, Key::Delete);
    assert!(session(&window).design().keyframes.is_empty());
}

#[test]
fn easings_have_handles_that_are_dragged_and_typed() {
    let mut window = three();
    window.get_by_label("Keyframe 1").click();
    settle(&mut window);
    let second = center(&window, "Keyframe 2") - center(&window, "Keyframe 1");
    let from = center(&window, "Handle of the beginning");
    drag(&mut window, from, from + 0.3 * second);
    let easing = keyframe(&window, 0).easing;
    assert!(
        matches!(easing, plushwright::design::Easing::Slow { out, into } if (out - 0.63).abs() < 0.02 && into < 0.34),
        "{easing:?}"
    );
    assert_eq!(session(&window).history().undo_label(), Some("Keyframe easing"));
    assert!(window.query_by_label("Slow at the beginning").is_some());
    back_and_forth(&mut window, 1);
}

#[test]
fn a_keyframe_has_a_handle_of_the_way_to_it() {
    let mut window = three();
    window.get_by_label("Keyframe 2").click();
    settle(&mut window);
    let back = center(&window, "Keyframe 1") - center(&window, "Keyframe 2");
    let from = center(&window, "Handle of the end before");
    drag(&mut window, from, from + 0.3 * back);
    let easing = keyframe(&window, 0).easing;
    assert!(
        matches!(easing, plushwright::design::Easing::Slow { out, into } if (into - 0.63).abs() < 0.02 && out < 0.34),
        "{easing:?}"
    );
    assert_eq!(keyframe(&window, 1).easing, plushwright::design::Easing::Smooth);
    back_and_forth(&mut window, 1);
}

#[test]
fn what_the_motors_cannot_follow_is_red_and_is_made_to_fit() {
    let mut window = three();
    assert!(window.query_by_label("Make it fit").is_none());
    window.get_by_label("Keyframe 2").click();
    settle(&mut window);
    let (from, to) = (center(&window, "Keyframe 2"), center(&window, "Keyframe 1"));
    drag(&mut window, from, from + 0.95 * (to - from));
    assert_eq!(times(&window), [0.0, 0.05, 2.0]);
    assert!(window.query_by_label_contains("Too fast: it takes").is_some());
    click(&mut window, "Make it fit");
    assert!(window.query_by_label_contains("Too fast").is_none());
    let fitted = times(&window);
    assert!(fitted[1] > 0.05 && (fitted[2] - fitted[1] - 1.95).abs() < 1e-9, "{fitted:?}");
    // A keyframe that holds jumps at its end, which no motor does, and what is done about it is told.
    window.get_by_label("Keyframe 2").click();
    settle(&mut window);
    assert!(window.query_by_label_contains("no motor jumps").is_none());
    window.get_by_role_and_label(accesskit::Role::ComboBox, "Easing").click();
    window.run();
    click(&mut window, "Hold");
    window.get_by_label_contains("no motor jumps: winch 1 is on its way here instead. To have it elsewhere, copy");
    click(&mut window, "Undo");
    // What drives make of it, and their loads.
    click(&mut window, "Drives");
    wait(&mut window, |s| s.tasks().running("timeline.drives").is_none());
    back_and_forth(&mut window, 2);
}

#[test]
fn a_film_is_made_with_progress_and_cancelled_without_a_trace() {
    let folder = tempfile::tempdir().unwrap();
    let mut window = three();
    let ask = |window: &mut crate::support::window::Window, name: &str, kind: &str| {
        window.get_by_label("Export film").click();
        window.run();
        window.get_by_label(kind).click();
        window.run();
        crate::support::window::enter_path(window, &folder.path().join(name));
        window.run();
        window.get_by_label("Make the film").click();
        window.step();
        window.step();
    };
    ask(&mut window, "wave.html", "Page");
    wait(&mut window, |s| s.filming().running.is_none());
    let page = std::fs::read_to_string(folder.path().join("wave.html")).unwrap();
    assert!(page.starts_with("<!doctype html>") && page.matches("<img").count() > 20);
    // It is ours, and may make way; a photograph may not.
    std::fs::write(folder.path().join("mine.gif"), "holiday").unwrap();
    ask(&mut window, "mine.gif", "GIF");
    assert!(window.query_by_label_contains("no film of ours").is_some());
    press(&mut window, Modifiers::NONE, Key::Escape);
    ask(&mut window, "frames", "Pictures");
    assert!(session(&window).filming().running.is_some());
    window.get_by_label("Cancel film").click();
    settle(&mut window);
    assert!(session(&window).filming().running.is_none());
    std::thread::sleep(std::time::Duration::from_millis(300));
    assert!(!folder.path().join("frames").exists());
}
