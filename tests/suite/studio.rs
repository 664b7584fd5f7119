//! The window, driven by accessible names. No display and no graphics adapter are needed.

use eframe::egui::{self, Key, Modifiers, Pos2, pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use plushwright::design::{Design, Network, Pin, Tendon, animation};
use plushwright::engine::{EQUILIBRIUM, Quality, Shape};
use plushwright::mesh::Mesh;
use plushwright::outline::drawing::{Part, Primitive};
use plushwright::outline::{Outline, polygon};
use plushwright::picture::palette::Theme;
use plushwright::rigging::Proposal;
use plushwright::studio::app::Studio;
use plushwright::studio::commands::command::Scope;
use plushwright::studio::messages::Level;
use plushwright::studio::session::{Selection, Services, Session, Views};
use plushwright::studio::tools::taken;
use plushwright::studio::viewport::Plushie;
use plushwright::studio::viewport::camera::Camera;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

pub type Window = Harness<'static, Option<Studio>>;

/// A bar of 6 x 2 squares, 120 x 40 mm, its left end pinned.
pub fn bar() -> Design {
    let (across, up) = (7, 3);
    let nodes = (0..up).flat_map(|j| (0..across).map(move |i| [20.0 * i as f64, 20.0 * j as f64])).collect();
    let mut triangles = Vec::new();
    for j in 0..up - 1 {
        for i in 0..across - 1 {
            let [a, b, c, d] = [j * across + i, j * across + i + 1, (j + 1) * across + i + 1, (j + 1) * across + i];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let outer = vec![[0.0, 0.0], [120.0, 0.0], [120.0, 40.0], [0.0, 40.0]];
    let mut design = Design::new("Bar", Outline { outer, holes: Vec::new() }, Mesh { nodes, triangles });
    for node in [0, 7, 14] {
        let at = design.mesh.node_point(node).unwrap();
        design.pins.push(Pin { at, position: None, stiffness: 20.0 });
    }
    design
}

/// A winch at the left end with a tendon along the top, as discovery might propose.
fn network() -> Network {
    let tendon = Tendon { routing: plushwright::design::MaterialPoint::through(14..20), ratio: 1.0, slack_mm: 0.0 };
    Network { name: "winch 1".to_owned(), tendons: vec![tendon] }
}

fn proposal(design: &Design, error_after: f64) -> Proposal {
    Proposal {
        network: network(),
        parameters: Default::default(),
        stages: Arc::default(),
        preview: Arc::new(Shape { nodes: design.mesh.nodes.clone(), ..Shape::default() }),
        error_before: 0.2,
        error_after,
    }
}

/// Proposes two networks at once.
fn services() -> Services {
    Services {
        propose: Arc::new(|design, _, _, _| vec![proposal(design, 0.05), proposal(design, 0.1)]),
        export: Arc::new(|_, folder| {
            std::fs::create_dir(folder).map_err(|e| e.to_string())?;
            std::fs::write(folder.join("pattern.svg"), "<svg/>").map_err(|e| e.to_string())
        }),
    }
}

pub fn window(design: Design) -> Window {
    window_with(design, services())
}

pub fn window_with(design: Design, services: Services) -> Window {
    let mut given = Some((design, services));
    let mut window = Harness::builder().with_max_steps(32).with_size(vec2(1280.0, 800.0)).build_ui_state(
        move |ui, studio: &mut Option<Studio>| {
            let studio = studio.get_or_insert_with(|| {
                let (design, services) = given.take().expect("made once");
                Studio::new(ui.ctx(), design, None, services)
            });
            studio.update(ui);
        },
        None,
    );
    settle(&mut window);
    window
}

pub fn session(window: &Window) -> &Session {
    window.state().as_ref().expect("made in the first frame").session()
}

/// Runs frames until the solver has answered and no thread is busy.
pub fn settle(window: &mut Window) {
    wait(window, |s| {
        s.is_settled() && s.discovery().running.is_none() && !s.is_working() && s.meshing().running.is_none()
    });
    window.run();
}

pub fn wait(window: &mut Window, done: impl Fn(&Session) -> bool) {
    let started = Instant::now();
    loop {
        window.step();
        if done(session(window)) {
            return;
        }
        assert!(started.elapsed() < Duration::from_secs(60), "nothing happened");
        std::thread::sleep(Duration::from_millis(2));
    }
}

pub fn click(window: &mut Window, name: &str) {
    window.get_by_label(name).click();
    settle(window);
}

pub fn press(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    settle(window);
}

/// Where a point of the body is on the screen; both views fit the bar in the same way.
pub fn on_screen(window: &Window, view: &str, p: [f64; 2]) -> Pos2 {
    let rect = window.get_by_label(view).rect();
    let scale = (rect.width() / (120.0 * 1.32)).min(rect.height() / (40.0 * 1.32));
    let center = rect.center();
    pos2(center.x + (p[0] as f32 - 60.0) * scale, center.y - (p[1] as f32 - 20.0) * scale)
}

pub fn drag(window: &mut Window, from: Pos2, to: Pos2) {
    window.hover_at(from);
    window.step();
    window.drag_at(from);
    window.step();
    for i in 1..=4 {
        window.hover_at(from.lerp(to, i as f32 / 4.0));
        window.step();
    }
    window.drop_at(to);
    settle(window);
}

/// Drags the free end of the bar up.
pub fn pose(window: &mut Window, view: &str) {
    let (from, to) = (on_screen(window, view, [120.0, 20.0]), on_screen(window, view, [115.0, 45.0]));
    drag(window, from, to);
}

pub fn with_network() -> Window {
    let mut design = bar();
    design.networks.push(network());
    let mut window = window(design);
    pose(&mut window, "Realizable view");
    window
}

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
    let propose: plushwright::studio::session::Propose = Arc::new(|design, _, _, cancel| {
        while !cancel.load(Ordering::Relaxed) {
            std::thread::sleep(Duration::from_millis(1));
        }
        vec![proposal(design, 0.1)]
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
fn what_goes_wrong_is_said_and_can_be_dismissed() {
    let services = Services { propose: Arc::new(|_, _, _, _| panic!("out of yarn")), ..services() };
    let mut window = window_with(bar(), services);
    pose(&mut window, "Idealized view");
    click(&mut window, "Propose networks");
    let message = session(&window).messages().list().last().unwrap().clone();
    assert_eq!(message.level, Level::Error);
    assert!(message.text.contains("out of yarn"));
    click(&mut window, "Dismiss message");
    assert!(session(&window).messages().list().is_empty());
    press(&mut window, Modifiers::COMMAND, Key::O);
    click(&mut window, "Discard changes");
    window.get_by_label("Path").type_text("does-not-exist.plush");
    settle(&mut window);
    assert!(window.query_by_label("There is no such file.").is_some());
    let folder = tempfile::tempdir().unwrap();
    let broken = folder.path().join("broken.plush");
    std::fs::write(&broken, "not a plushie").unwrap();
    type_path(&mut window, &broken);
    click(&mut window, "Open");
    assert!(session(&window).messages().list().iter().any(|m| m.level == Level::Error));
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

#[test]
fn networks_that_no_hand_can_sew_are_marked() {
    let mut window = window(crate::support::rigged());
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
    window.get_by_role_and_label(egui::accesskit::Role::SpinButton, "Sharpest turn").scroll_to_me();
    settle(&mut window);
    let value = window.get_by_role_and_label(egui::accesskit::Role::SpinButton, "Sharpest turn").rect().center();
    drag(&mut window, value, value + vec2(400.0, 0.0));
    assert_eq!(session(&window).design().sewing.turn_degrees, 180.0);
    assert_eq!(session(&window).history().undo_label(), Some("Sewing settings"));
    click(&mut window, "Networks");
    marked(&mut window, "right", false);
    click(&mut window, "Undo");
    assert_eq!(session(&window).design().sewing.turn_degrees, 75.0);
    marked(&mut window, "right", true);
}

#[test]
fn saving_opening_and_exporting() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bar.plush");
    let mut window = with_network();
    press(&mut window, Modifiers::COMMAND, Key::S);
    type_path(&mut window, &path);
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert!(path.is_file());
    assert!(!session(&window).history().is_modified());
    let blueprint = folder.path().join("blueprint");
    press(&mut window, Modifiers::COMMAND, Key::E);
    type_path(&mut window, &blueprint);
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert!(blueprint.join("pattern.svg").is_file());
    click(&mut window, "Delete pose");
    press(&mut window, Modifiers::COMMAND, Key::O);
    click(&mut window, "Save changes");
    type_path(&mut window, &path);
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert!(session(&window).design().poses.is_empty());
    assert_eq!(session(&window).history().undo_label(), None);
}

fn type_path(window: &mut Window, path: &std::path::Path) {
    window.get_by_label("Path").focus();
    window.step();
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.step();
    window.get_by_label("Path").type_text(&path.to_string_lossy());
    settle(window);
}

#[test]
fn another_resolution_can_be_had_and_undone() {
    let mut window = with_network();
    let before = session(&window).design().clone();
    click(&mut window, "Mesh");
    for name in ["Muscle fibres", "Finer body"] {
        window.get_by_role_and_label(egui::accesskit::Role::SpinButton, name);
    }
    window.get_by_label_contains("Histogram of smallest angles");
    let value = window.get_by_role_and_label(egui::accesskit::Role::SpinButton, "Muscle fibres").rect().center();
    drag(&mut window, value, value + vec2(120.0, 0.0));
    let asked = session(&window).resolution().fibers;
    assert!(asked > before.mesh.edges().len() + 20, "{asked}");
    assert_eq!(*session(&window).design(), before, "nothing has changed yet");
    click(&mut window, "Remesh");
    let after = session(&window).design().clone();
    let fibers = after.mesh.edges().len();
    assert!(fibers.abs_diff(asked) * 100 <= 3 * asked, "{fibers} for {asked}");
    assert_eq!((after.pins.len(), after.networks.len(), after.poses.len()), (3, 1, 1));
    let shape = session(&window).shapes().idealized.clone().expect("solved on the new mesh");
    assert_eq!(shape.nodes.len(), after.mesh.nodes.len());
    assert_eq!(session(&window).history().undo_label(), Some("Remesh"));
    // Undo brings back the old mesh, and shapes that belong to it.
    click(&mut window, "Undo");
    assert_eq!(*session(&window).design(), before);
    let shape = session(&window).shapes().idealized.clone().expect("solved on the old mesh");
    assert_eq!(shape.nodes.len(), before.mesh.nodes.len());
    click(&mut window, "Redo");
    assert_eq!(session(&window).design().mesh, after.mesh);
    // A mesh that nobody waits for any more changes nothing.
    window.get_by_label("Remesh").click();
    window.step();
    window.step();
    if session(&window).meshing().running.is_some() {
        window.get_by_label("Cancel meshing").click();
    }
    settle(&mut window);
}

/// Where a place of the drawing is on the screen, while the sheet shows the box from `low` to `high`.
pub fn on_sheet(window: &Window, (low, high): ([f64; 2], [f64; 2]), p: [f64; 2]) -> Pos2 {
    let rect = window.get_by_label("Drawing sheet").rect();
    Camera::fit(low, high, rect.size()).to_screen(rect, p)
}

const BAR: ([f64; 2], [f64; 2]) = ([0.0, 0.0], [120.0, 40.0]);

fn parts(window: &Window) -> &[Part] {
    &session(window).drawing().parts
}

#[test]
fn the_outline_is_drawn_with_the_mouse_and_becomes_a_body() {
    let mut window = with_network();
    let before = session(&window).design().clone();
    press(&mut window, Modifiers::NONE, Key::O);
    // The outline as it is, traced: nothing is in the document yet.
    assert!(
        matches!(parts(&window), [Part { primitive: Primitive::Path { points }, cut: false }] if points.len() == 4)
    );
    assert_eq!(*session(&window).design(), before);
    // A head on the free end.
    click(&mut window, "Circle");
    let [from, to] = [[100.0, 20.0], [100.0, 50.0]].map(|p| on_sheet(&window, BAR, p));
    drag(&mut window, from, to);
    let Primitive::Circle { center, radius } = parts(&window)[1].primitive else { panic!("{:?}", parts(&window)) };
    assert!((center[0] - 100.0).abs() < 0.5 && (center[1] - 20.0).abs() < 0.5 && (radius - 30.0).abs() < 0.5);
    assert_eq!(session(&window).history().undo_label(), Some("Draw a circle"));
    assert_eq!(session(&window).design().mesh, before.mesh, "the body is the old one until a new one is made");
    // Its rim, pulled in by hand, is one step of undo.
    press(&mut window, Modifiers::NONE, Key::V);
    let [rim, pulled] = [center[0] + radius, center[0] + 25.0].map(|x| on_sheet(&window, BAR, [x, center[1]]));
    drag(&mut window, rim, pulled);
    let Primitive::Circle { radius, .. } = parts(&window)[1].primitive else { panic!() };
    assert!((radius - 25.0).abs() < 0.5, "{radius}");
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(matches!(parts(&window)[1].primitive, Primitive::Circle { radius, .. } if (radius - 30.0).abs() < 0.5));
    click(&mut window, "Make the body");
    let after = session(&window).design().clone();
    assert!(!session(&window).sketching().open, "the plushie is shown again");
    let (_, high) = after.outline.bounding_box();
    assert!((high[0] - 130.0).abs() < 1.0 && (high[1] - 60.0).abs() < 1.0, "{high:?}");
    assert_eq!((after.pins.len(), after.networks.len(), after.poses.len()), (3, 1, 1));
    after.validate().unwrap();
    settle(&mut window);
    let shape = session(&window).shapes().realizable.clone().expect("solved on the new body");
    assert_eq!(shape.nodes.len(), after.mesh.nodes.len());
    // Undo takes it all back.
    assert_eq!(session(&window).history().undo_label(), Some("New body"));
    press(&mut window, Modifiers::COMMAND, Key::Z);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(*session(&window).design(), before);
}

/// One click of the mouse on the sheet, and time enough for the next one not to be a double click.
fn click_at(window: &mut Window, p: Pos2) {
    window.hover_at(p);
    window.step();
    window.drag_at(p);
    window.step();
    window.drop_at(p);
    settle(window);
    window.run_steps(30);
}

/// Whether edges of the mesh run along a track, within 0.01 mm, between two of its places.
fn has_edges_along(mesh: &Mesh, [a, b]: [[f64; 2]; 2]) -> bool {
    let edges = mesh.edges();
    (0..=40).all(|k| {
        let p = polygon::lerp(a, b, f64::from(k) / 40.0);
        edges.iter().any(|e| polygon::distance_to_segment(mesh.nodes[e[0]], mesh.nodes[e[1]], p) < 0.01)
    })
}

#[test]
fn a_tendon_track_is_drawn_changed_and_becomes_edges_of_the_body() {
    let mut window = with_network();
    let before = session(&window).design().clone();
    press(&mut window, Modifiers::NONE, Key::O);
    click(&mut window, "Tendon track");
    let tracks = |window: &Window| session(window).drawing().tracks.clone();
    let at = |window: &Window, p: [f64; 2]| on_sheet(window, BAR, p);
    // One that Escape drops, and one that a double click ends.
    for p in [[20.0, 10.0], [60.0, 30.0]] {
        let p = at(&window, p);
        click_at(&mut window, p);
    }
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert!(session(&window).sketching().open && *session(&window).design() == before, "nothing was drawn");
    for p in [[15.0, 25.0], [60.0, 25.0], [105.0, 25.0], [105.0, 25.0]] {
        let p = at(&window, p);
        click_at(&mut window, p);
    }
    assert!(matches!(tracks(&window).as_slice(), [track] if track.len() == 3), "{:?}", tracks(&window));
    assert_eq!(session(&window).history().undo_label(), Some("Draw a track"));
    // A second one, ended with Enter, is deleted again by its button; then a part of undo brings it back and takes it.
    press(&mut window, Modifiers::NONE, Key::R);
    for p in [[15.0, 8.0], [40.0, -8.0]] {
        let p = at(&window, p);
        click_at(&mut window, p);
    }
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(tracks(&window).len(), 2);
    // It leaves the body, the first one does not.
    window.get_by_label_contains("cut off where they leave the body: 2.");
    click(&mut window, "Delete track 2");
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(tracks(&window).len(), 2);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(tracks(&window).len(), 1);
    // Its middle point is pulled down, a point is put in, and taken out again.
    press(&mut window, Modifiers::NONE, Key::V);
    let on_it = at(&window, [30.0, 25.0]);
    click_at(&mut window, on_it);
    let [from, to] = [[60.0, 25.0], [60.0, 18.0]].map(|p| at(&window, p));
    drag(&mut window, from, to);
    let pulled = tracks(&window)[0].clone();
    assert!((pulled[1][1] - 18.0).abs() < 0.5 && pulled.len() == 3, "{pulled:?}");
    let [from, to] = [[82.5, 21.5], [82.5, 15.0]].map(|p| at(&window, p));
    drag(&mut window, from, to);
    assert_eq!((tracks(&window)[0].len(), session(&window).history().undo_label()), (4, Some("Add point")));
    press(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(tracks(&window)[0], pulled);
    click(&mut window, "Make the body");
    let after = session(&window).design().clone();
    after.validate().unwrap();
    assert_eq!(after.networks.len(), 1);
    let track = after.tracks()[0].clone();
    for piece in track.windows(2) {
        assert!(has_edges_along(&after.mesh, [piece[0], piece[1]]), "{piece:?}");
    }
    // Another resolution keeps to it.
    click(&mut window, "Mesh");
    click(&mut window, "Remesh");
    assert!(has_edges_along(&session(&window).design().mesh, [track[1], track[2]]));
    while session(&window).history().undo_label() != Some("Add target") {
        press(&mut window, Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(*session(&window).design(), before);
}

#[test]
fn a_polygon_that_is_not_closed_is_kept() {
    let mut window = with_network();
    let before = session(&window).design().clone();
    let clicked = |window: &mut Window, points: &[[f64; 2]]| {
        for &p in points {
            let p = on_sheet(window, BAR, p);
            click_at(window, p);
        }
    };
    press(&mut window, Modifiers::NONE, Key::O);
    // Another pencil finishes three corners, as one step of undo, and drops two.
    click(&mut window, "Polygon");
    clicked(&mut window, &[[20.0, 20.0], [50.0, 20.0], [35.0, 55.0]]);
    click(&mut window, "Circle");
    let corners = |part: &Part| match &part.primitive {
        Primitive::Path { points } => points.iter().filter(|p| p.corner).count(),
        _ => 0,
    };
    assert_eq!((parts(&window).len(), corners(&parts(&window)[1])), (2, 3));
    assert_eq!(taken(session(&window), Scope::Outline).id, "tool.circle");
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(*session(&window).design(), before);
    click(&mut window, "Polygon");
    clicked(&mut window, &[[20.0, 20.0], [50.0, 20.0]]);
    press(&mut window, Modifiers::NONE, Key::V);
    assert_eq!(*session(&window).design(), before);
    // So does closing the sheet; a track of two points is kept as well.
    click(&mut window, "Tendon track");
    clicked(&mut window, &[[20.0, 20.0], [100.0, 20.0]]);
    click(&mut window, "Polygon");
    assert_eq!(session(&window).drawing().tracks.len(), 1);
    clicked(&mut window, &[[20.0, 20.0], [50.0, 20.0], [35.0, 55.0], [25.0, 50.0]]);
    press(&mut window, Modifiers::NONE, Key::O);
    assert!(!session(&window).sketching().open);
    let drawing = session(&window).design().drawing.clone().expect("it was drawn");
    assert_eq!((drawing.parts.len(), corners(&drawing.parts[1])), (2, 4));
    press(&mut window, Modifiers::COMMAND, Key::Z);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(*session(&window).design(), before);
}

#[test]
fn a_new_plushie_is_drawn_on_an_empty_sheet() {
    let mut window = window(bar());
    click(&mut window, "File");
    window.get_by_label_contains("New drawing").click();
    settle(&mut window);
    assert!(parts(&window).is_empty() && session(&window).sketching().open);
    let sheet = ([0.0, 0.0], [300.0, 240.0]);
    let at = |window: &Window, p: [f64; 2]| on_sheet(window, sheet, p);
    // A freehand line around, its ends not quite together.
    let round: Vec<Pos2> = (0..=40)
        .map(|i| {
            let (sin, cos) = (0.15 * f64::from(i)).sin_cos();
            at(&window, [150.0 + 90.0 * cos, 120.0 + 70.0 * sin])
        })
        .collect();
    window.hover_at(round[0]);
    window.step();
    window.drag_at(round[0]);
    for &p in &round {
        window.hover_at(p);
        window.step();
    }
    window.drop_at(round[40]);
    settle(&mut window);
    assert!(matches!(&parts(&window)[0].primitive, Primitive::Path { points } if (4..40).contains(&points.len())));
    let area: f64 = plushwright::outline::polygon::signed_area(&parts(&window)[0].primitive.polygon());
    assert!((area / (std::f64::consts::PI * 90.0 * 70.0) - 1.0).abs() < 0.03, "{area}");
    // A triangle is cut out of it, corner by corner, closed on the first one.
    press(&mut window, Modifiers::NONE, Key::P);
    press(&mut window, Modifiers::NONE, Key::X);
    let corners = [[140.0, 100.0], [180.0, 100.0], [160.0, 140.0], [140.0, 100.0]];
    for p in corners {
        let p = at(&window, p);
        click_at(&mut window, p);
    }
    assert_eq!(parts(&window).len(), 2, "{:?}", parts(&window));
    assert!(parts(&window)[1].cut && parts(&window)[1].primitive.handles().len() == 3);
    // A part by its name, a point by hand, and both deleted.
    press(&mut window, Modifiers::NONE, Key::V);
    click(&mut window, "2 Polygon, cut out");
    press(&mut window, Modifiers::NONE, Key::Delete);
    assert_eq!(parts(&window).len(), 1);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(parts(&window).len(), 2);
    click(&mut window, "Make the body");
    let design = session(&window).design().clone();
    assert_eq!(design.outline.holes.len(), 1);
    assert!((design.outline.area() - (area - 800.0)).abs() < 0.02 * area, "{}", design.outline.area());
    design.validate().unwrap();
}

#[test]
fn the_texture_is_read_aside_shown_and_hidden() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bar.plush");
    let mut design = bar();
    design.texture = Some("bar.png".into());
    plushwright::design::file::write(&path, &design).unwrap();
    image::RgbaImage::from_pixel(3000, 1000, image::Rgba([200, 30, 30, 255]))
        .save(folder.path().join("bar.png"))
        .unwrap();
    // Without a texture the switch says why it cannot be used.
    let mut window = window(bar());
    let is_disabled = |window: &Window| window.get_by_label("Show the texture").accesskit_node().is_disabled();
    assert!(is_disabled(&window) && session(&window).cannot_show("texture").unwrap().contains("has no texture"));
    let open = |window: &mut Window| {
        press(window, Modifiers::COMMAND, Key::O);
        type_path(window, &path);
        press(window, Modifiers::NONE, Key::Enter);
        wait(window, |s| s.cannot_show("texture").is_none_or(|why| why.contains("missing")));
        settle(window);
    };
    open(&mut window);
    let texture = session(&window).texture().expect("it was read").clone();
    assert!((texture.levels()[0].width, texture.levels()[0].height) == (2048, 683));
    assert!(!is_disabled(&window) && session(&window).look().shown.shows("texture"));
    click(&mut window, "Show the texture");
    assert!(!session(&window).look().shown.shows("texture"));
    press(&mut window, Modifiers::NONE, Key::X);
    assert!(session(&window).look().shown.shows("texture") && !session(&window).history().is_modified());
    // It is read once, and nothing is drawn while nothing changes.
    pose(&mut window, "Idealized view");
    assert!(Arc::ptr_eq(&texture, session(&window).texture().unwrap()));
    window.run();
    assert_eq!(window.output().viewport_output.values().next().unwrap().repaint_delay, Duration::MAX);
    // Saved elsewhere, and there again, a copy goes with it.
    std::fs::create_dir(folder.path().join("sub")).unwrap();
    let moved = folder.path().join("sub/bar.plush");
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    type_path(&mut window, &moved);
    press(&mut window, Modifiers::NONE, Key::Enter);
    for _ in 0..2 {
        let saved = plushwright::design::file::read(&moved).unwrap();
        assert_eq!(saved.texture.as_deref(), Some("bar.texture.png"));
        press(&mut window, Modifiers::COMMAND, Key::S);
    }
    let bytes = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    assert_eq!(bytes("sub/bar.texture.png"), bytes("bar.png"));
    assert!(Arc::ptr_eq(&texture, session(&window).texture().unwrap()));
    // A picture that is gone is said to be, and the plushie is shown without it.
    std::fs::remove_file(folder.path().join("bar.png")).unwrap();
    open(&mut window);
    let said = |window: &Window| session(window).messages().list().last().unwrap().clone();
    assert!(session(&window).texture().is_none() && is_disabled(&window));
    assert!(
        said(&window).level == Level::Warning && said(&window).text.contains("cannot be shown"),
        "{:?}",
        said(&window)
    );
    wait(&mut window, |s| s.shapes().realizable.is_some());
}

#[test]
fn the_picture_of_an_import_is_kept_as_texture() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("block.svg");
    let svg = r##"<svg xmlns="http://www.w3.org/2000/svg" width="200" height="100"><path d="M10 10h180v80h-180z" fill="#c81e1e"/></svg>"##;
    std::fs::write(&picture, svg).unwrap();
    let mut window = window(bar());
    press(&mut window, Modifiers::COMMAND, Key::O);
    type_path(&mut window, &picture);
    press(&mut window, Modifiers::NONE, Key::Enter);
    click(&mut window, "Keep the picture as texture");
    click(&mut window, "Create");
    wait(&mut window, |s| s.texture().is_some());
    settle(&mut window);
    assert!(session(&window).history().is_modified());
    // It waits where nobody sees it until the plushie has a place.
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    for name in ["one.plush", "two.plush"] {
        let path = folder.path().join(name);
        press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
        type_path(&mut window, &path);
        press(&mut window, Modifiers::NONE, Key::Enter);
        let saved = plushwright::design::file::read(&path).unwrap();
        let expected = name.replace("plush", "texture.png");
        assert_eq!(saved.texture.as_deref(), Some(expected.as_str()));
        let texture = image::open(folder.path().join(expected)).unwrap().to_rgba8();
        assert_eq!(texture.get_pixel(texture.width() / 2, texture.height() / 2).0, [200, 30, 30, 255]);
    }
    assert!(session(&window).texture().is_some() && !session(&window).history().is_modified());
}

#[test]
fn a_refused_import_can_be_asked_for_anew() {
    let folder = tempfile::tempdir().unwrap();
    let picture = folder.path().join("dots.svg");
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" width="200" height="100"><circle cx="50" cy="50" r="40"/><circle cx="150" cy="50" r="30"/></svg>"#;
    std::fs::write(&picture, svg).unwrap();
    let mut window = window(bar());
    press(&mut window, Modifiers::COMMAND, Key::N);
    type_path(&mut window, &folder.path().join("none.svg"));
    assert!(window.query_by_label("There is no such file.").is_some());
    press(&mut window, Modifiers::NONE, Key::Enter);
    type_path(&mut window, &picture);
    assert!(window.query_by_label("There is no such file.").is_none());
    click(&mut window, "Fill holes");
    click(&mut window, "Create");
    wait(&mut window, |s| !s.is_working());
    settle(&mut window);
    assert!(window.query_by_label_contains("The silhouette is in 2 separate pieces").is_some());
    click(&mut window, "Largest piece only");
    assert!(window.query_by_label_contains("2 separate pieces").is_none());
    click(&mut window, "Create");
    wait(&mut window, |s| s.design().name == "dots");
}

#[test]
fn an_example_opens_from_the_menu() {
    let mut window = window(bar());
    click(&mut window, "Examples");
    window.get_by_label("Robot").click();
    wait(&mut window, |s| s.design().name != "Bar");
    assert_eq!(session(&window).history().undo_label(), None);
    assert!(!session(&window).history().is_modified());
    wait(&mut window, |s| s.shapes().realizable.is_some());
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
fn nothing_is_drawn_while_nothing_changes() {
    let mut window = window(bar());
    pose(&mut window, "Idealized view");
    window.run();
    let viewport = window.output().viewport_output.values().next().unwrap();
    assert_eq!(viewport.repaint_delay, Duration::MAX);
}
