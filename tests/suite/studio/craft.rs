//! The craft of the window: where it speaks, what has the focus, how large its questions are.

use crate::support::window::{
    Window, bar, click, network, on_screen, pose, press, services, session, settle, wait, window, window_with,
};
use eframe::egui::{self, Key, Modifiers};
use egui_kittest::kittest::Queryable;
use plushwright::design::{Easing, Keyframe, Pose, Target};
use plushwright::studio::session::{Overlay, Services};

#[test]
fn every_stop_of_the_tab_key_is_seen() {
    let mut design = bar();
    design.networks.push(network());
    let mut window = window(design);
    let ringed = |window: &crate::support::window::Window| {
        let ring =
            |shape: &egui::Shape| matches!(shape, egui::Shape::Rect(r) if r.stroke.width == 2.0 && r.fill.a() == 0);
        window.output().shapes.iter().any(|clipped| ring(&clipped.shape))
    };
    assert!(!ringed(&window));
    for stop in 0..60 {
        window.key_press(Key::Tab);
        // egui moves the focus at the end of the frame.
        window.run_steps(3);
        assert!(ringed(&window), "stop {stop} shows nothing");
    }
    // A click needs no ring.
    click(&mut window, "Rest");
    assert!(!ringed(&window));
}

/// The frame of the press and that of the release are more than a second apart where a large window is drawn in software.
#[test]
fn a_press_and_its_release_in_slow_frames_are_a_click() {
    let mut window = window(bar());
    assert!(window.query_by_label("Propose networks").is_some());
    let at = window.get_by_label("Mesh").rect().center();
    window.hover_at(at);
    window.step();
    window.drag_at(at);
    let begun = window.ctx.input(|input| input.time);
    while window.ctx.input(|input| input.time) < begun + 1.5 {
        window.step();
    }
    window.drop_at(at);
    window.step();
    window.step();
    assert!(window.query_by_label("Propose networks").is_none());
}

#[test]
fn messages_stand_beside_the_views_and_all_of_them_in_the_log() {
    let mut window = window(bar());
    press(&mut window, Modifiers::NONE, Key::K);
    let text = session(&window).messages().list()[0].text.clone();
    let view = window.get_by_label("Idealized view").rect();
    assert!(window.get_by_label(&text).rect().right() <= view.left());
    click(&mut window, "Dismiss message");
    assert!(window.query_by_label(&text).is_none());
    press(&mut window, Modifiers::NONE, Key::K);
    click(&mut window, "All messages");
    assert_eq!(session(&window).overlay(), Some(Overlay::Log));
    assert!(session(&window).messages().log().count() == 2);
    window.get_by_label("Close").click();
    settle(&mut window);
    assert_eq!(session(&window).overlay(), None);
}

#[test]
fn the_newest_message_is_on_top() {
    let mut window = window(bar());
    press(&mut window, Modifiers::NONE, Key::K);
    press(&mut window, Modifiers::SHIFT, Key::N);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    let texts: Vec<String> = session(&window).messages().list().iter().map(|message| message.text.clone()).collect();
    assert!(texts.len() > 1, "{texts:?}");
    let tops: Vec<f32> = texts.iter().map(|text| window.get_by_label(text).rect().top()).collect();
    assert!(tops.windows(2).all(|pair| pair[0] > pair[1]), "{texts:?} {tops:?}");
    let foot = window.get_by_label("All messages").rect();
    assert!(tops[0] < foot.top() && foot.bottom() <= window.get_by_label("Idealized view").rect().bottom());
}

#[test]
fn what_is_in_hand_stays_in_hand_when_messages_come_and_go() {
    let mut window = window(bar());
    press(&mut window, Modifiers::SHIFT, Key::N);
    window.get_by_label("Rest").focus();
    window.run();
    assert!(window.get_by_label("Rest").is_focused());
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(!session(&window).messages().list().is_empty() && window.get_by_label("Rest").is_focused());
    // What was done goes away by itself.
    wait(&mut window, |s| s.messages().list().is_empty());
    assert!(window.get_by_label("Rest").is_focused());
    // A press before, the release after.
    let at = window.get_by_label("Add pose").rect().center();
    window.hover_at(at);
    window.drag_at(at);
    window.key_press(Key::K);
    window.step();
    window.drop_at(at);
    settle(&mut window);
    assert!(!session(&window).messages().list().is_empty());
    assert_eq!(session(&window).design().poses.len(), 1);
}

#[test]
fn a_question_has_its_own_size_whatever_was_open_before() {
    let mut window = window(bar());
    click(&mut window, "Add pose");
    let height = |window: &mut crate::support::window::Window| {
        press(window, Modifiers::COMMAND, Key::O);
        window.run();
        let ends = ["Without saving they are lost.", "Discard changes"].map(|name| window.get_by_label(name).rect());
        press(window, Modifiers::NONE, Key::Escape);
        ends[1].bottom() - ends[0].top()
    };
    let before = height(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::E);
    window.run();
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(height(&mut window), before);
}

#[test]
fn an_empty_sheet_opens_without_a_warning() {
    let mut window = window(bar());
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::O);
    window.run();
    assert!(session(&window).sketching().open);
    assert!(window.query_by_label_contains("Draw something that is not cut out").is_none());
    assert!(window.query_by_label_contains("Draw the silhouette").is_some());
}

#[test]
fn the_next_step_leads_from_a_bare_body_to_a_network() {
    let mut design = bar();
    design.pins.clear();
    let mut window = window(design);
    click(&mut window, "Next step: Pin and pose");
    let made = session(&window).design().clone();
    assert!(made.pins.len() == 1 && made.poses[0].name == "Wave" && made.poses[0].targets.len() == 1);
    assert!(
        window.query_by_label_contains("free to").is_none() && window.query_by_label_contains("Out of reach").is_none()
    );
    click(&mut window, "Next step: Propose networks");
    click(&mut window, "Next step: Accept a network");
    assert_eq!(session(&window).design().networks.len(), 1);
    click(&mut window, "Next step: Make it move");
    let keyframes = session(&window).design().keyframes.clone();
    assert_eq!(keyframes.iter().map(|k| k.time_s).collect::<Vec<_>>(), [0.0, 1.0, 2.0]);
    assert_eq!(keyframes.iter().map(|k| k.pose.as_deref()).collect::<Vec<_>>(), [None, Some("Wave"), None]);
    assert_eq!(session(&window).history().undo_label(), Some("First keyframes"));
    let next = ["Make it fit", "Propose for this pose", "Mend a cable", "Export the blueprint"]
        .map(|words| format!("Next step: {words}"));
    assert!(next.iter().any(|name| window.query_by_label(name).is_some()));
    while session(&window).history().undo_label().is_some() {
        click(&mut window, "Undo");
    }
    assert!(session(&window).design().pins.is_empty() && session(&window).design().poses.is_empty());
}

#[test]
fn the_next_step_is_not_asked_for_in_vain() {
    let mut design = bar();
    let at = design.mesh.locate_nearest([119.0, 20.0], &design.mesh.nodes).unwrap().0;
    // Its cable bends the bar up.
    let targets = vec![Target { at, to: [110.0, -30.0], weight: 1.0 }];
    design.poses.push(Pose { name: "down".into(), targets });
    design.networks.push(network());
    let rest = |time_s| Keyframe { time_s, activations_mm: vec![0.0], pose: None, easing: Easing::Smooth };
    design.keyframes = vec![rest(0.0), rest(2.0)];
    let nothing = Services { propose: std::sync::Arc::new(|_, _, _, _, _| Vec::new()), ..services() };
    let mut window = window_with(design, nothing);
    click(&mut window, "down");
    let offered = |window: &Window| window.query_by_label("Next step: Propose for this pose").is_some();
    wait(&mut window, |s| s.judging().error(0).is_some_and(|known| known.fresh && known.thorough));
    settle(&mut window);
    assert!(offered(&window));
    // It would be refused while the animation plays.
    window.get_by_label("Play").click();
    wait(&mut window, |s| s.playback().playing);
    window.run_steps(2);
    assert!(!offered(&window));
    window.key_press(Key::Space);
    wait(&mut window, |s| !s.playback().playing);
    click(&mut window, "down");
    assert!(offered(&window));
    click(&mut window, "Next step: Propose for this pose");
    assert!(!offered(&window));
    window.get_by_label("Next step: Mend a cable");
    // What was not found was not found for this pose alone.
    assert!(window.query_by_label_contains("No network that can be sewn").is_some());
    click(&mut window, "Rest");
    assert!(window.query_by_label_contains("No network that can be sewn").is_none());
}

#[test]
fn the_start_page_opens_examples_and_recent_files() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.plush");
    let mine = plushwright::design::Design { name: "mine".into(), ..bar() };
    plushwright::design::file::write(&path, &mine).unwrap();
    let store = plushwright::studio::store::Store::at(folder.path().join("state"));
    let services = crate::support::window::services();
    let mut window = crate::support::window::open(mine, Some(path.clone()), services, Some(store));
    settle(&mut window);
    click(&mut window, "File");
    click(&mut window, "Start page");
    assert_eq!(session(&window).overlay(), Some(Overlay::Start));
    crate::support::window::wait(&mut window, |s| s.tasks().running("start.pictures").is_none());
    window.get_by_label("Open example Pig").click();
    settle(&mut window);
    assert_eq!((session(&window).design().name.as_str(), session(&window).overlay()), ("pig", None));
    click(&mut window, "File");
    click(&mut window, "Start page");
    window.get_by_label_contains("mine.plush").click();
    settle(&mut window);
    assert_eq!(session(&window).design().name, "mine");
}

#[test]
fn a_page_stands_still_as_soon_as_it_is_seen() {
    let mut window = window(bar());
    let stands = |window: &mut Window, name: &str| {
        for _ in 0..2 {
            window.step();
        }
        let place = |window: &Window| window.get_all_by_label(name).next().unwrap().rect();
        let first = place(window);
        for _ in 0..12 {
            window.step();
        }
        assert_eq!(place(window), first, "{name}");
        press(window, Modifiers::NONE, Key::Escape);
    };
    click(&mut window, "File");
    window.get_by_label("Start page").click();
    window.step();
    stands(&mut window, "Open example Pig");
    window.key_press(Key::F1);
    window.step();
    stands(&mut window, "Keyboard shortcuts");
    press(&mut window, Modifiers::NONE, Key::K);
    window.get_by_label("All messages").click();
    window.step();
    stands(&mut window, "Close");
}

#[test]
fn a_blueprint_is_seen_before_it_is_written() {
    let mut design = bar();
    design.networks.push(network());
    let mut window = window(design);
    press(&mut window, Modifiers::COMMAND, Key::E);
    window.run();
    window.get_by_label("Preview").click();
    crate::support::window::wait(&mut window, |s| s.tasks().running("blueprint.preview").is_none());
    window.run();
    assert!(window.query_by_label("Sheet").is_some() && window.query_by_label_contains("1 of ").is_some());
    window.get_by_label("Next page").click();
    window.run();
    assert!(window.query_by_label_contains("2 of ").is_some());
}

#[test]
fn ways_of_working_are_as_they_were_left() {
    let folder = tempfile::tempdir().unwrap();
    let again = || {
        let store = plushwright::studio::store::Store::at(folder.path());
        let mut window = crate::support::window::open(bar(), None, crate::support::window::services(), Some(store));
        settle(&mut window);
        window
    };
    let mut first = again();
    press(&mut first, Modifiers::NONE, Key::T);
    press(&mut first, Modifiers::SHIFT, Key::N);
    let theme = session(&first).look().theme;
    drop(first);
    let second = again();
    assert_eq!((session(&second).look().theme, session(&second).posing().snaps), (theme, false));
}

#[test]
fn what_a_press_will_do_is_said_before_it_is_done() {
    let mut design = bar();
    design.networks.push(network());
    let mut window = window(design);
    pose(&mut window, "Idealized view");
    let target = session(&window).design().poses[0].targets[0].to;
    let goal = on_screen(&window, "Idealized view", target);
    let says = |window: &mut Window, at: egui::Pos2| {
        window.hover_at(at);
        window.run_steps(4);
        window.output().platform_output.cursor_icon
    };
    assert_eq!(says(&mut window, goal), egui::CursorIcon::Grab);
    assert!(window.query_by_label_contains("Drag moves the goal of this target").is_some());
    // Rings around it, in both views.
    let rings = |window: &Window| {
        let ring = |shape: &egui::Shape| matches!(shape, egui::Shape::Circle(c) if c.radius == 11.0);
        window.output().shapes.iter().filter(|clipped| ring(&clipped.shape)).count()
    };
    assert_eq!(rings(&window), 2);
    press(&mut window, Modifiers::NONE, Key::P);
    let pin = session(&window).design().pins[0].anchor(&session(&window).design().mesh);
    let pin = on_screen(&window, "Idealized view", pin);
    says(&mut window, pin);
    assert!(window.query_by_label_contains("Click takes this pin out").is_some());
    press(&mut window, Modifiers::NONE, Key::W);
    // Beside the body the tool says what it is for.
    let rect = window.get_by_label("Idealized view").rect();
    says(&mut window, rect.left_top() + egui::vec2(4.0, 40.0));
    assert!(window.query_by_label_contains("Drag holes and winches").is_some());
}

#[test]
fn no_other_command_acts_behind_the_palette() {
    let mut window = window(bar());
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::P);
    for key in [Key::O, Key::N, Key::E, Key::S, Key::Z] {
        press(&mut window, Modifiers::COMMAND, key);
        assert_eq!(session(&window).overlay(), Some(Overlay::Palette), "{key:?}");
        assert!(window.query_by_label("Path").is_none(), "{key:?}");
    }
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(session(&window).overlay(), None);
}

#[test]
fn the_tip_of_a_card_stands_over_no_view() {
    let mut window = window(bar());
    pose(&mut window, "Idealized view");
    click(&mut window, "Propose networks");
    let card = window.get_by_label("Proposal 1").rect();
    let view = window.get_by_label("Realizable view").rect();
    window.hover_at(card.center());
    window.run_steps(24);
    let tip = window.get_by_label_contains("Error of the realizable plushie without and with it").rect();
    assert!(tip.left() >= view.right() && tip.top() >= card.bottom(), "{tip:?} {card:?} {view:?}");
}

#[test]
fn a_question_that_waits_for_text_draws_nothing() {
    let mut window = window(bar());
    for (modifiers, key) in [(Modifiers::COMMAND, Key::O), (Modifiers::COMMAND | Modifiers::SHIFT, Key::P)] {
        press(&mut window, modifiers, key);
        window.run();
        assert!(window.ctx.text_edit_focused(), "{key:?}");
        let next = window.output().viewport_output.values().map(|viewport| viewport.repaint_delay).min();
        assert!(next.is_some_and(|after| after > std::time::Duration::from_secs(60)), "{key:?}: {next:?}");
        press(&mut window, Modifiers::NONE, Key::Escape);
    }
}
