//! Keyframes that follow their poses, are fixed, replaced, selected; keys that work after a click into a view.

use crate::support::window::{click, drag, press, session, settle, wait, with_network};
use eframe::egui::{Key, Modifiers};
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
    click(&mut window, "Fix");
    assert_eq!((keyframe(&window, 0).pose, session(&window).history().undo_label()), (None, Some("Fix keyframe")));
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
