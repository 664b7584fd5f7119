//! Networks and the animation: proposals, keyframes, playing.

use crate::support::window::{
    Window, bar, click, drag, on_screen, other, pose, press, proposal, services, session, settle, wait, window,
    window_with, with_network,
};
use eframe::egui::{Key, Modifiers, accesskit, pos2, vec2};
use egui_kittest::kittest::Queryable;
use plushwright::design::animation;
use plushwright::operations::network::Part;
use plushwright::studio::session::{Propose, Selection, Services};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

#[test]
fn networks_are_proposed_previewed_rejected_and_accepted() {
    let mut window = window(bar());
    assert!(session(&window).cannot_propose().is_some());
    pose(&mut window, "Idealized view");
    click(&mut window, "Propose networks");
    assert_eq!(session(&window).discovery().proposals.len(), 2);
    assert!(session(&window).shown_proposal().is_some());
    for stage in ["Activity", "Seeds", "Tree", "Result"] {
        click(&mut window, stage);
    }
    click(&mut window, "Proposal 2");
    assert_eq!(session(&window).discovery().shown, Some(1));
    click(&mut window, "Reject");
    assert_eq!(session(&window).discovery().proposals.len(), 1);
    click(&mut window, "Accept");
    assert_eq!(session(&window).design().networks.len(), 1);
    assert!(session(&window).discovery().proposals.is_empty());
    click(&mut window, "Delete network winch 1");
    click(&mut window, "Undo");
    click(&mut window, "Undo");
    assert!(session(&window).design().networks.is_empty());
}

#[test]
fn discovery_can_be_cancelled() {
    let propose: Propose = Arc::new(|design, _, _, _, cancel| {
        while !cancel.load(Ordering::Relaxed) {
            std::thread::sleep(Duration::from_millis(1));
        }
        vec![Arc::new(proposal(design, 0.1))]
    });
    let mut window = window_with(bar(), Services { propose, ..services() });
    pose(&mut window, "Idealized view");
    window.get_by_label("Propose networks").click();
    wait(&mut window, |s| s.discovery().running.is_some());
    window.step();
    window.get_by_label("Cancel").click();
    settle(&mut window);
    assert!(session(&window).discovery().proposals.is_empty());
    window.get_by_label("Propose networks");
}

#[test]
fn proposals_stream_in_and_a_list_for_another_pose_is_stale() {
    let go_on = Arc::new(AtomicBool::new(false));
    let waits = go_on.clone();
    let propose: Propose = Arc::new(move |design, _, options, found, _| {
        assert!(options.rules && options.fewer);
        let list = vec![Arc::new(proposal(design, 0.05))];
        found(&list);
        while !waits.load(Ordering::Relaxed) {
            std::thread::sleep(Duration::from_millis(1));
        }
        [Arc::new(other(design, 0.01))].into_iter().chain(list).collect()
    });
    let mut window = window_with(bar(), Services { propose, ..services() });
    pose(&mut window, "Idealized view");
    window.get_by_label("Propose networks").click();
    wait(&mut window, |s| !s.discovery().proposals.is_empty());
    window.run_steps(2);
    window.get_by_label("100 mm of cable, 4 holes, 5.0 N, sewn by hand 5.0 %");
    window.get_by_label("serves Pose 1");
    window.get_by_label("Seeds");
    // Picked out by a hand, it stays while a better one comes.
    window.get_by_label("Proposal 1").click();
    window.run_steps(2);
    go_on.store(true, Ordering::Relaxed);
    settle(&mut window);
    assert_eq!((session(&window).discovery().proposals.len(), session(&window).discovery().shown), (2, Some(1)));
    click(&mut window, "Proposal 1");
    assert!(window.query_by_label("Seeds").is_none(), "no stages are known of this one");
    // Other targets: nothing of it holds, and nothing can be accepted.
    let drag_on = |window: &mut Window, from: [f64; 2], to: [f64; 2]| {
        let [from, to] = [from, to].map(|p| on_screen(window, "Idealized view", p));
        drag(window, from, to);
    };
    drag_on(&mut window, [115.0, 45.0], [110.0, 50.0]);
    assert!(session(&window).discovery().is_stale() && session(&window).shown_proposal().is_none());
    assert!(window.query_by_label("Accept").is_none());
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert!(session(&window).design().networks.is_empty());
    click(&mut window, "Undo");
    assert!(!session(&window).discovery().is_stale());
    click(&mut window, "Rest");
    assert!(session(&window).discovery().is_stale());
    click(&mut window, "Pose 1");
    assert!(!session(&window).discovery().is_stale());
    drag_on(&mut window, [115.0, 45.0], [110.0, 50.0]);
    click(&mut window, "Propose again");
    assert!(!session(&window).discovery().is_stale() && session(&window).discovery().proposals.len() == 2);
    click(&mut window, "Accept");
    assert_eq!(session(&window).design().networks.len(), 1);
}

#[test]
fn where_nothing_was_found_the_window_says_what_to_do_until_something_is() {
    let empty = Arc::new(AtomicBool::new(true));
    let nothing = empty.clone();
    let propose: Propose = Arc::new(move |design, _, _, _, _| {
        let strong = plushwright::rigging::Proposal { force_n: 20.0, spool_n: 50.0, ..proposal(design, 0.05) };
        if nothing.load(Ordering::Relaxed) { Vec::new() } else { vec![Arc::new(strong)] }
    });
    let mut window = window_with(bar(), Services { propose, ..services() });
    pose(&mut window, "Idealized view");
    click(&mut window, "Propose networks");
    let found_nothing = |window: &Window| {
        window
            .query_by_label_contains("No network that can be sewn was found for this pose. Move its goals nearer")
            .is_some()
    };
    assert!(found_nothing(&window) && window.query_by_label_contains("Found for another").is_none());
    // In another pose there is nothing that could be taken for its own.
    let [from, to] = [[115.0, 45.0], [110.0, 50.0]].map(|p| on_screen(&window, "Idealized view", p));
    drag(&mut window, from, to);
    assert!(!session(&window).discovery().is_stale() && window.query_by_label_contains("Found for another").is_none());
    empty.store(false, Ordering::Relaxed);
    click(&mut window, "Propose networks");
    assert!(!found_nothing(&window) && session(&window).discovery().proposals.len() == 1);
    // 50 N at a spool are more than the motor of a new design keeps up.
    window.get_by_label_contains("Motor too weak:");
    window.get_by_label_contains("a proposal is shown: its figures are on its card");
}

#[test]
fn what_is_accepted_has_the_figures_that_were_told() {
    let mut window = window_with(bar(), plushwright::studio::services());
    pose(&mut window, "Idealized view");
    click(&mut window, "Propose networks");
    let told = session(&window).shown_proposal().expect("found").clone();
    assert!(told.error_after() < 0.5 * told.error_before() && told.breaches.is_empty());
    click(&mut window, "Accept");
    wait(&mut window, |s| s.is_settled() && !s.is_refining());
    window.run();
    let shown = session(&window).shapes().realizable.as_ref().unwrap().target_error;
    let off = (shown - told.error_after()).abs();
    assert!(off <= f64::max(0.01 * shown, 1e-4), "{shown} after {}", told.error_after());
}

#[test]
fn a_keyframe_can_be_made_of_the_animation() {
    let mut window = with_network();
    click(&mut window, "Add keyframe");
    click(&mut window, "Rest");
    click(&mut window, "Add keyframe");
    let rect = window.get_by_label("Timeline").rect();
    let between = pos2(rect.left() + 0.3 * rect.width(), rect.top() + 8.0);
    drag(&mut window, between, between);
    let time_s = session(&window).playback().time_s;
    assert!(time_s > 0.0 && time_s != 1.0, "at {time_s} s");
    let shown = animation::activations_at(session(&window).design(), time_s);
    click(&mut window, "Add keyframe");
    let keyframes = &session(&window).design().keyframes;
    let added = keyframes.iter().find(|k| (k.time_s - time_s).abs() < 1e-9).expect("at the playhead");
    assert_eq!((keyframes.len(), &added.activations_mm, &added.pose), (3, &shown, &None));
    // What was wanted of a pose that the eye has left does not turn up later.
    click(&mut window, "Pose 1");
    assert_eq!(session(&window).design().keyframes.len(), 3);
}

#[test]
fn keyframes_are_added_dragged_eased_deleted() {
    let mut window = with_network();
    click(&mut window, "Add keyframe");
    click(&mut window, "Rest");
    click(&mut window, "Add keyframe");
    let keyframes = session(&window).design().keyframes.clone();
    assert_eq!(keyframes.len(), 2);
    assert_eq!((keyframes[0].time_s, keyframes[1].time_s), (0.0, 1.0));
    assert!(keyframes[0].activations_mm[0] > 0.0, "{keyframes:?}");
    assert_eq!(keyframes[0].pose.as_deref(), Some("Pose 1"));
    let (first, second) = (window.get_by_label("Keyframe 1").rect(), window.get_by_label("Keyframe 2").rect());
    let second_long = second.center().x - first.center().x;
    drag(&mut window, second.center(), second.center() + vec2(second_long, 0.0));
    assert!((session(&window).design().keyframes[1].time_s - 2.0).abs() < 1e-9);
    assert_eq!(session(&window).history().undo_label(), Some("Move keyframe"));
    // Past the other one: they change places, and the drag stays with the one in hand.
    drag(&mut window, first.center(), first.center() + vec2(second_long * 3.0, 0.0));
    let times: Vec<f64> = session(&window).design().keyframes.iter().map(|k| k.time_s).collect();
    assert!((times[0] - 2.0).abs() < 1e-9 && (times[1] - 3.0).abs() < 1e-9, "{times:?}");
    assert_eq!(session(&window).design().keyframes[1].pose.as_deref(), Some("Pose 1"));
    press(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(session(&window).design().keyframes.len(), 1);
    for _ in 0..5 {
        press(&mut window, Modifiers::COMMAND, Key::Z);
    }
    assert!(session(&window).design().keyframes.is_empty());
}

#[test]
fn the_animation_plays_and_can_be_scrubbed() {
    let mut window = with_network();
    click(&mut window, "Add keyframe");
    click(&mut window, "Rest");
    click(&mut window, "Add keyframe");
    window.get_by_label("Play").click();
    window.run_steps(6);
    let (time, playing) = (session(&window).playback().time_s, session(&window).playback().playing);
    assert!(playing && time > 0.0, "{time}");
    window.get_by_label("Pause").click();
    settle(&mut window);
    let rect = window.get_by_label("Timeline").rect();
    let (first, second) = (window.get_by_label("Keyframe 1").rect(), window.get_by_label("Keyframe 2").rect());
    let middle = pos2((first.center().x + second.center().x) / 2.0, rect.center().y);
    window.drag_at(middle);
    window.step();
    window.drop_at(middle);
    settle(&mut window);
    assert!((session(&window).playback().time_s - 0.5).abs() < 0.01);
    let keyframes = &session(&window).design().keyframes;
    let halfway = keyframes[0].activations_mm[0] / 2.0;
    let wound = session(&window).shapes().realizable.as_ref().unwrap().activations_mm[0];
    assert!((wound - halfway).abs() < 0.05 * halfway, "{wound} {halfway}");
}

#[test]
fn a_keyframe_is_made_of_the_newest_activations_even_where_they_are_hidden() {
    let mut window = with_network();
    let wound = session(&window).shapes().realizable.as_ref().unwrap().activations_mm[0];
    click(&mut window, "Rest");
    click(&mut window, "Show realizable view");
    press(&mut window, Modifiers::NONE, Key::Num2);
    press(&mut window, Modifiers::NONE, Key::Num2);
    click(&mut window, "Pose 1");
    click(&mut window, "Add keyframe");
    let keyframe = &session(&window).design().keyframes[0];
    assert!((keyframe.activations_mm[0] - wound).abs() < 0.1 * wound, "{keyframe:?} {wound}");
    assert!(!session(&window).request().unwrap().show_realizable);
}

#[test]
fn networks_that_no_hand_can_sew_are_marked() {
    let mut design = crate::support::rigged();
    // Slow enough for the motors.
    design.keyframes.iter_mut().for_each(|keyframe| keyframe.time_s *= 10.0);
    let mut window = window(design);
    let marked = |window: &mut Window, name: &str, wanted: bool| {
        let label = format!("Network {name} is hard to sew");
        let started = Instant::now();
        while window.query_by_label(&label).is_some() != wanted {
            assert!(started.elapsed() < Duration::from_secs(60), "{label}: {}", !wanted);
            std::thread::sleep(Duration::from_millis(2));
            window.step();
        }
    };
    // The tendon of the right one turns by 90 degrees.
    marked(&mut window, "right", true);
    marked(&mut window, "left", false);
    click(&mut window, "Settings");
    window.get_by_role_and_label(accesskit::Role::SpinButton, "Sharpest turn").scroll_to_me();
    settle(&mut window);
    let value = window.get_by_role_and_label(accesskit::Role::SpinButton, "Sharpest turn").rect().center();
    drag(&mut window, value, value + vec2(400.0, 0.0));
    assert_eq!(session(&window).design().sewing.turn_degrees, 180.0);
    assert_eq!(session(&window).history().undo_label(), Some("Sewing settings"));
    click(&mut window, "Networks");
    marked(&mut window, "right", false);
    click(&mut window, "Undo");
    assert_eq!(session(&window).design().sewing.turn_degrees, 75.0);
    marked(&mut window, "right", true);
    // So does the next step, where no pose is missed; both have the tool for it.
    click(&mut window, "Rest");
    window.get_by_label("Next step: Mend a cable").click();
    settle(&mut window);
    assert_eq!(session(&window).selection(), Selection::Part(Part::Winch(1)));
    press(&mut window, Modifiers::NONE, Key::Escape);
    click(&mut window, "Network right is hard to sew");
    assert_eq!(session(&window).selection(), Selection::Part(Part::Winch(1)));
    assert!(session(&window).has_taken("tool.tendon"));
}

#[test]
fn candidates_are_cards_that_are_sorted_and_shown_under_the_pointer() {
    let mut window = window(bar());
    pose(&mut window, "Idealized view");
    click(&mut window, "Propose networks");
    let order = |window: &Window| session(window).discovery().sorted();
    assert_eq!(order(&window), [0, 1]);
    wait(&mut window, |s| s.tasks().running("gallery.cards").is_none());
    // The other one's cable is as long, its error is larger; by holes they are alike.
    for (name, sorted) in [("Worst pose", [0, 1]), ("Fewest holes", [0, 1])] {
        window.get_by_role_and_label(accesskit::Role::ComboBox, "Sorted by").click();
        window.run();
        window.get_by_label(name).click();
        settle(&mut window);
        assert_eq!(order(&window), sorted);
    }
    let card = window.get_by_label("Proposal 2").rect().center();
    window.hover_at(card);
    window.run_steps(3);
    assert_eq!(session(&window).discovery().hovered.as_ref().map(|(index, _)| *index), Some(1));
    assert!((session(&window).displayed_proposal().unwrap().error_after() - 0.1).abs() < 1e-9);
    // What is accepted is what was picked.
    assert_eq!(session(&window).discovery().shown, Some(0));
    window.hover_at(window.get_by_label("Idealized view").rect().center());
    window.run_steps(3);
    assert!(session(&window).discovery().hovered.is_none());
}
