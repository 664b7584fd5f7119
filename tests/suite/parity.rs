//! Every operation through the command line and through the window, by accessible names: the same design, byte for byte.

use super::support::window::{Window, click, drag, on_screen, open, press, session, settle, type_path};
use eframe::egui::accesskit::Role;
use eframe::egui::{self, Key, Modifiers, vec2};
use egui_kittest::kittest::Queryable;
use plushwright::design::{Design, Easing, Keyframe, file};
use plushwright::fabrication::Manifest;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

/// 120 x 40 mm.
const BAR: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="120mm" height="40mm" viewBox="0 0 120 40">
<rect width="120" height="40"/></svg>"#;

/// Runs the program in a folder.
#[track_caller]
fn run(folder: &Path, args: &[&str]) {
    let output = Command::new(env!("CARGO_BIN_EXE_plushwright")).args(args).current_dir(folder).output().unwrap();
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
}

/// The window on a design, with the real services.
fn window(design: Design, path: Option<PathBuf>) -> Window {
    let mut window = open(design, path, plushwright::studio::services(), None);
    settle(&mut window);
    window
}

/// Types a value in place of what stands in a field.
fn enter(window: &mut Window, role: Role, name: &str, text: &str) {
    window.get_by_role_and_label(role, name).focus();
    window.step();
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.step();
    window.event(egui::Event::Text(text.to_owned()));
    window.step();
    press(window, Modifiers::NONE, Key::Tab);
}

/// Both ways came to the same design.
#[track_caller]
fn same(window: &Window, path: &Path) {
    let text = file::to_text(session(window).design()).unwrap();
    let told: Vec<&str> = session(window).messages().list().iter().map(|m| m.text.as_str()).collect();
    let by_hand = fs::read_to_string(path).unwrap();
    let apart = text.lines().zip(by_hand.lines()).find(|(a, b)| a != b);
    assert!(text == by_hand, "{}: another design; {told:?}; {apart:?}", path.display());
}

/// A folder with the design of a bar, and the window on it.
fn bar() -> (tempfile::TempDir, Window) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("bar.svg"), BAR).unwrap();
    run(folder.path(), &["new", "bar.svg", "-o", "bar.plush", "--fibers", "60"]);
    let path = folder.path().join("bar.plush");
    let window = window(file::read(&path).unwrap(), Some(path));
    (folder, window)
}

/// A bar with a pin at its left end and a pose, made in the window and saved.
fn posed() -> (tempfile::TempDir, Window) {
    let (folder, mut window) = bar();
    click(&mut window, "Pin tool");
    for p in [[5.0, 10.0], [5.0, 30.0]] {
        let p = on_screen(&window, "Idealized view", p);
        window.hover_at(p);
        window.drag_at(p);
        window.drop_at(p);
        settle(&mut window);
    }
    click(&mut window, "Drag tool");
    let [from, to] = [[112.0, 20.0], [106.3, 37.7]].map(|p| on_screen(&window, "Idealized view", p));
    drag(&mut window, from, to);
    assert_eq!((session(&window).design().pins.len(), session(&window).design().poses.len()), (2, 1));
    press(&mut window, Modifiers::COMMAND, Key::S);
    (folder, window)
}

/// The same bar, rigged by the program, and the window on it.
fn rigged() -> (tempfile::TempDir, Window) {
    let (folder, _) = posed();
    let path = folder.path().join("bar.plush");
    let mut design = file::read(&path).unwrap();
    let mut routing: Vec<usize> = (0..design.mesh.nodes.len()).filter(|&n| design.mesh.nodes[n][1] > 39.9).collect();
    routing.sort_by(|&a, &b| design.mesh.nodes[a][0].total_cmp(&design.mesh.nodes[b][0]));
    let tendon = plushwright::design::Tendon {
        routing: plushwright::design::MaterialPoint::through(routing),
        ratio: 1.0,
        slack_mm: 0.0,
    };
    design.networks.push(plushwright::design::Network::new("winch 1", vec![tendon]));
    file::write(&path, &design).unwrap();
    let window = window(design, Some(path));
    (folder, window)
}

/// Waits until the dialog shows what would be read: it grows then, and its buttons move away from where they were looked for.
#[track_caller]
fn shown(window: &mut Window) {
    let started = Instant::now();
    while window.query_by_label("What would be read").is_none() {
        assert!(started.elapsed() < Duration::from_secs(60), "no preview");
        std::thread::sleep(Duration::from_millis(10));
        window.run_steps(2);
    }
    // The dialog takes some frames to find its size.
    window.run_steps(8);
}

/// Imports a file with options on both ways.
#[track_caller]
fn imported(name: &str, bytes: &[u8], args: &[&str], choose: impl Fn(&mut Window)) -> Design {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    let design = path.with_extension("plush");
    run(folder.path(), &[&["new", name, "-o", design.to_str().unwrap()], args].concat());
    let mut window = window(plushwright::design::bundled::ALL[0].design().unwrap(), None);
    press(&mut window, Modifiers::COMMAND, Key::N);
    type_path(&mut window, &path);
    shown(&mut window);
    choose(&mut window);
    click(&mut window, "Create");
    same(&window, &design);
    file::read(&design).unwrap()
}

fn height(design: &Design) -> f64 {
    design.outline.bounding_box().1[1]
}

const NUMBERS: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" width="600" height="400" viewBox="0 0 600 400">
<path d="M50 50h500v300h-500zM200 150v60h60v-60z" fill-rule="evenodd"/></svg>"#;

#[test]
fn a_drawing_with_and_without_units_has_its_own_size_both_ways() {
    let with = imported("unit.svg", BAR.as_bytes(), &[], |_| ());
    assert!((height(&with) - 40.0).abs() < 1e-3);
    let without = imported("plain.svg", NUMBERS.as_bytes(), &[], |_| ());
    assert!((height(&without) - 300.0 * 25.4 / 96.0).abs() < 0.1);
}

#[test]
fn what_is_asked_for_is_the_same_both_ways() {
    let args = ["--height", "150", "--fibers", "200", "--holes", "fill", "--smooth", "0.5"];
    let design = imported("plain.svg", NUMBERS.as_bytes(), &args, |window| {
        enter(window, Role::SpinButton, "Height", "150");
        enter(window, Role::SpinButton, "Muscle fibres", "200");
        click(window, "Holes: fill");
        click(window, "Reading and clean-up");
        enter(window, Role::SpinButton, "Smooth", "0.5");
    });
    assert!((height(&design) - 150.0).abs() < 1e-6 && design.outline.holes.is_empty());
}

#[test]
fn a_width_is_asked_for_both_ways() {
    let design = imported("plain.svg", NUMBERS.as_bytes(), &["--width", "90"], |window| {
        // The last one that is typed counts.
        enter(window, Role::SpinButton, "Height", "150");
        enter(window, Role::SpinButton, "Width", "90");
    });
    assert!((design.outline.bounding_box().1[0] - 90.0).abs() < 1e-6);
}

#[test]
fn a_flat_mesh_stays_that_mesh_both_ways() {
    let obj = b"v 0 0 0\nv 100 0 0\nv 100 80 0\nv 0 80 0\nv 50 40 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";
    let own = imported("flat.obj", obj, &[], |_| ());
    assert_eq!((own.fiber_routings().len(), height(&own)), (8, 80.0));
    let inches = imported("flat.obj", obj, &["--unit", "in", "--fibers", "150"], |window| {
        enter(window, Role::SpinButton, "Muscle fibres", "150");
        click(window, "Reading and clean-up");
        enter(window, Role::SpinButton, "Unit", "25.4");
    });
    assert!((height(&inches) - 80.0 * 25.4).abs() < 1e-6);
}

#[test]
fn a_picture_and_a_drawing_of_parts_are_read_the_same_both_ways() {
    let mut png = std::io::Cursor::new(Vec::new());
    let ink = |x: u32, y: u32| (f64::from(x) / 150.0 - 1.0).powi(2) + (f64::from(y) / 110.0 - 1.0).powi(2) < 0.7;
    let picture = image::RgbImage::from_fn(300, 220, |x, y| image::Rgb(if ink(x, y) { [30; 3] } else { [250; 3] }));
    picture.write_to(&mut png, image::ImageFormat::Png).unwrap();
    imported("oval.png", png.get_ref(), &["--fibers", "200"], |window| {
        enter(window, Role::SpinButton, "Muscle fibres", "200");
    });
    let parts = b"(parts: [(primitive: Capsule(ends: ((40, 40), (120, 90)), radii: (30, 20))), \
                  (primitive: Circle(center: (40, 40), radius: 8), cut: true)], tracks: [[(50, 60), (120, 90)]])";
    let drawn = imported("limb.ron", parts, &[], |_| ());
    assert!(drawn.drawing.is_some() && drawn.tracks().len() == 1 && drawn.outline.holes.len() == 1);
}

#[test]
fn a_picture_becomes_the_same_texture_both_ways() {
    let folder = tempfile::tempdir().unwrap();
    let [cli, by_hand] = ["cli", "window"].map(|name| folder.path().join(name));
    for path in [&cli, &by_hand] {
        fs::create_dir(path).unwrap();
    }
    let svg = NUMBERS.replace("<path", r##"<path fill="#c81e1e""##);
    fs::write(folder.path().join("skin.svg"), svg).unwrap();
    run(folder.path(), &["new", "skin.svg", "-o", "cli/skin.plush", "--texture"]);
    let mut window = window(plushwright::design::bundled::ALL[0].design().unwrap(), None);
    press(&mut window, Modifiers::COMMAND, Key::N);
    type_path(&mut window, &folder.path().join("skin.svg"));
    click(&mut window, "Keep the picture as texture");
    click(&mut window, "Create");
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    type_path(&mut window, &by_hand.join("skin.plush"));
    press(&mut window, Modifiers::NONE, Key::Enter);
    for name in ["skin.plush", "skin.texture.png"] {
        assert!(fs::read(cli.join(name)).unwrap() == fs::read(by_hand.join(name)).unwrap(), "{name}");
    }
}

#[test]
fn another_resolution_is_the_same_both_ways() {
    let (folder, mut window) = posed();
    run(folder.path(), &["remesh", "bar.plush", "-o", "fine.plush", "--fibers", "150", "--finer", "2"]);
    click(&mut window, "Mesh");
    enter(&mut window, Role::SpinButton, "Muscle fibres", "150");
    enter(&mut window, Role::SpinButton, "Finer body", "2");
    click(&mut window, "Remesh");
    same(&window, &folder.path().join("fine.plush"));
}

#[test]
fn another_silhouette_is_the_same_both_ways() {
    let (folder, mut window) = posed();
    press(&mut window, Modifiers::NONE, Key::O);
    click(&mut window, "Circle");
    // A circle that reaches out of the body.
    let middle = window.get_by_label("Drawing sheet").rect().center();
    drag(&mut window, middle, middle + vec2(130.0, 0.0));
    let drawing = session(&window).drawing();
    assert_eq!(drawing.parts.len(), 2);
    fs::write(folder.path().join("bar.ron"), drawing.to_text().unwrap()).unwrap();
    run(folder.path(), &["reshape", "bar.plush", "bar.ron", "-o", "round.plush"]);
    click(&mut window, "Make the body");
    same(&window, &folder.path().join("round.plush"));
}

#[test]
fn what_is_dragged_can_be_read_off_and_typed() {
    let (folder, window) = posed();
    let design = session(&window).design();
    let place = |at| design.mesh.position(at, &design.mesh.nodes).map(|v| format!("{v:.3}")).join(",");
    let pins: Vec<String> = design.pins.iter().map(|pin| place(&pin.at)).collect();
    let target = &design.poses[0].targets[0];
    let target = format!("{}={:.3},{:.3}", place(&target.at), target.to[0], target.to[1]);
    run(folder.path(), &["new", "bar.svg", "-o", "bar.plush", "--fibers", "60", "--force"]);
    let pose = ["pose", "bar.plush", "-o", "bar.plush", "--name", "Pose 1", "--target", &target];
    run(folder.path(), &[&pose[..], &["--pin", &pins[0], "--pin", &pins[1]]].concat());
    same(&window, &folder.path().join("bar.plush"));
}

#[test]
fn a_pose_and_rest_are_keyed_the_same_both_ways() {
    let (folder, mut window) = rigged();
    let key = ["key", "bar.plush", "-o", "bar.plush", "--pose"];
    run(folder.path(), &[&key[..], &["Pose 1", "--time", "0"]].concat());
    run(folder.path(), &[&key[..], &["rest", "--time", "1"]].concat());
    click(&mut window, "Add keyframe");
    click(&mut window, "Rest");
    click(&mut window, "Add keyframe");
    assert_eq!(session(&window).design().keyframes.len(), 2);
    same(&window, &folder.path().join("bar.plush"));
}

#[test]
fn winches_and_tendons_changed_by_hand_are_the_same_both_ways() {
    let (folder, mut window) = rigged();
    let design = || file::read(&folder.path().join("bar.plush")).unwrap();
    let place = |window: &Window, winch: usize, tendon: usize, hole: usize| {
        let design = session(window).design();
        let place = design.networks[winch].tendons[tendon].routing[hole].place(&design.mesh.nodes);
        place.map(|v| format!("{v:.3}")).join(",")
    };
    let network = |args: &[&str]| {
        run(folder.path(), &[&["network", args[0], "bar.plush", "-o", "bar.plush"], &args[1..]].concat());
    };
    let hand = |window: &mut Window, from: [f64; 2], to: [f64; 2]| {
        let [from, to] = [from, to].map(|p| on_screen(window, "Realizable view", p));
        drag(window, from, to);
    };
    click(&mut window, "Rest");
    click(&mut window, "Tendon tool");
    // The end goes inward; a hole is put in; the winch moves.
    let last = design().networks[0].tendons[0].routing.len() - 1;
    hand(&mut window, [120.0, 40.0], [104.0, 28.0]);
    network(&[
        "move",
        "--winch",
        "1",
        "--tendon",
        "1",
        "--hole",
        &last.to_string(),
        "--to",
        &place(&window, 0, 0, last),
    ]);
    same(&window, &folder.path().join("bar.plush"));
    hand(&mut window, [0.0, 40.0], [12.0, 25.0]);
    network(&["move", "--winch", "winch 1", "--to", &place(&window, 0, 0, 0)]);
    same(&window, &folder.path().join("bar.plush"));
    press(&mut window, Modifiers::NONE, Key::Escape);
    hand(&mut window, [60.0, 12.0], [84.0, 12.0]);
    let through = [place(&window, 1, 0, 0), place(&window, 1, 0, 1)];
    network(&["new", "--through", &through[0], "--through", &through[1]]);
    same(&window, &folder.path().join("bar.plush"));
    hand(&mut window, [72.0, 12.0], [72.0, 17.0]);
    network(&["add-hole", "--winch", "2", "--tendon", "1", "--piece", "1", "--at", &place(&window, 1, 0, 1)]);
    same(&window, &folder.path().join("bar.plush"));
    hand(&mut window, [60.0, 20.0], [45.0, 12.0]);
    network(&["add-tendon", "--winch", "2", "--through", &place(&window, 1, 1, 1)]);
    same(&window, &folder.path().join("bar.plush"));
    click(&mut window, "Give tendon 2 of winch 2");
    click(&mut window, "Give to winch 1");
    network(&["hand-over", "--winch", "2", "--tendon", "2", "--to", "1"]);
    same(&window, &folder.path().join("bar.plush"));
    click(&mut window, "Give tendon 2 of winch 1");
    click(&mut window, "A winch of its own");
    network(&["split", "--winch", "1", "--tendon", "2"]);
    same(&window, &folder.path().join("bar.plush"));
    click(&mut window, "Up");
    network(&["reorder", "--winch", "3", "--to", "2"]);
    click(&mut window, "Switch off");
    network(&["mute", "--winch", "2"]);
    click(&mut window, "Colour of winch 3");
    click(&mut window, "Colour 1");
    network(&["color", "--winch", "2", "--color", "1f68b4"]);
    same(&window, &folder.path().join("bar.plush"));
    click(&mut window, "Switch on");
    network(&["unmute", "--winch", "winch 3"]);
    click(&mut window, "Delete network winch 2");
    network(&["remove", "--winch", "winch 2"]);
    same(&window, &folder.path().join("bar.plush"));
}

#[test]
fn a_network_that_is_proposed_and_accepted_is_the_same_both_ways() {
    let (folder, mut window) = posed();
    let pose = session(&window).design().poses[0].name.clone();
    run(folder.path(), &["propose", "bar.plush", "--pose", &pose, "--accept", "1", "-o", "chosen.plush"]);
    click(&mut window, "Propose networks");
    click(&mut window, "Accept");
    assert_eq!(session(&window).design().networks.len(), 1);
    same(&window, &folder.path().join("chosen.plush"));
}

#[test]
fn a_rig_with_fixed_options_is_the_same_both_ways() {
    let (folder, mut window) = posed();
    let fixed = ["--max-winches", "1", "--tendons", "1", "--seed-num", "12", "--join-depth", "2", "--join-len", "2"];
    let fixed = [&["--method", "algorithm2"][..], &fixed].concat();
    run(folder.path(), &[&["rig", "bar.plush", "-o", "rigged.plush", "--phi", "0.5"][..], &fixed].concat());
    click(&mut window, "Advanced");
    for (name, value) in [("Seeds", "12"), ("Join rounds", "2"), ("Join length", "2"), ("Phi", "0.5")] {
        enter(&mut window, Role::SpinButton, name, value);
    }
    click(&mut window, "All poses");
    enter(&mut window, Role::SpinButton, "Most winches", "1");
    enter(&mut window, Role::TextInput, "Tendons of each winch", "1");
    window.get_by_label("Hold the parameters").scroll_to_me();
    settle(&mut window);
    click(&mut window, "Hold the parameters");
    window.get_by_label("Rig all poses").scroll_to_me();
    settle(&mut window);
    click(&mut window, "Rig all poses");
    assert_eq!(session(&window).design().keyframes.len(), 3);
    same(&window, &folder.path().join("rigged.plush"));
}

#[test]
fn a_rig_of_the_curve_is_the_same_both_ways() {
    let (folder, mut window) = posed();
    let fixed = ["--max-winches", "1", "--tendons", "1", "--seed-num", "12", "--join-depth", "2", "--join-len", "2"];
    let fixed = [&["--explore", "--method", "algorithm2", "--phi", "0.5"][..], &fixed].concat();
    run(folder.path(), &[&["rig", "bar.plush", "-o", "rigged.plush"][..], &fixed].concat());
    click(&mut window, "Advanced");
    for (name, value) in [("Seeds", "12"), ("Join rounds", "2"), ("Join length", "2"), ("Phi", "0.5")] {
        enter(&mut window, Role::SpinButton, name, value);
    }
    click(&mut window, "All poses");
    enter(&mut window, Role::SpinButton, "Most winches", "1");
    enter(&mut window, Role::TextInput, "Tendons of each winch", "1");
    window.get_by_label("Hold the parameters").scroll_to_me();
    settle(&mut window);
    click(&mut window, "Hold the parameters");
    window.get_by_label("Compare numbers of winches").scroll_to_me();
    settle(&mut window);
    click(&mut window, "Compare numbers of winches");
    assert!(session(&window).design().networks.is_empty() && !session(&window).rigging().curve.stale);
    window.get_by_label("Take up to 1 winch of 1").scroll_to_me();
    settle(&mut window);
    click(&mut window, "Take up to 1 winch of 1");
    assert_eq!(session(&window).design().keyframes.len(), 3);
    same(&window, &folder.path().join("rigged.plush"));
    // With it the design is another one, and nothing is taken twice.
    assert!(session(&window).rigging().curve.stale);
    click(&mut window, "Undo");
    assert!(session(&window).design().networks.is_empty() && !session(&window).rigging().curve.stale);
}

/// The window's export has the files of the program's, byte for byte.
#[track_caller]
fn same_blueprint(folder: &Path, cli: &str, by_hand: &str) {
    let files = |name: &str| {
        let mut files: Vec<_> = fs::read_dir(folder.join(name)).unwrap().map(|e| e.unwrap().path()).collect();
        files.sort();
        files
    };
    let [cli, by_hand] = [files(cli), files(by_hand)];
    assert!(cli.len() > 4 && cli.len() == by_hand.len(), "{cli:?} {by_hand:?}");
    for (a, b) in cli.iter().zip(&by_hand) {
        assert_eq!(a.file_name(), b.file_name());
        assert!(fs::read(a).unwrap() == fs::read(b).unwrap(), "{}", a.display());
    }
}

/// Exports with what was chosen in the dialog.
fn export(window: &mut Window, folder: &Path, choose: impl Fn(&mut Window)) {
    press(window, Modifiers::COMMAND, Key::E);
    type_path(window, folder);
    choose(window);
    window.get_by_label("Path").focus();
    window.step();
    press(window, Modifiers::NONE, Key::Enter);
    settle(window);
}

#[test]
fn a_blueprint_is_the_same_both_ways() {
    let (folder, mut window) = rigged();
    run(folder.path(), &["export", "bar.plush", "-o", "cli"]);
    export(&mut window, &folder.path().join("window"), |_| ());
    same_blueprint(folder.path(), "cli", "window");
}

#[test]
fn parts_and_sheets_of_a_blueprint_are_chosen_the_same_both_ways() {
    let (folder, mut window) = rigged();
    let options =
        ["--cutter", "plotter", "--corners", "mitred", "--compensate", "--only", "laser,print,routing,winches,motors"];
    run(folder.path(), &[&["export", "bar.plush", "-o", "cli"], &options[..]].concat());
    export(&mut window, &folder.path().join("window"), |window| {
        click(window, "Compensate for stuffing");
        click(window, "Parts and sheets");
        for control in ["Plotter", "Mitred corners", "Assembly guide"] {
            click(window, control);
        }
    });
    same_blueprint(folder.path(), "cli", "window");
}

#[test]
fn what_is_too_quick_is_refused_or_stretched_the_same_both_ways() {
    let (folder, window) = rigged();
    let mut design = Design::clone(session(&window).design());
    let key = |time_s, mm| Keyframe { time_s, activations_mm: vec![mm], pose: None, easing: Easing::Smooth };
    design.keyframes = vec![key(0.0, 0.0), key(0.01, 30.0)];
    let path = folder.path().join("quick.plush");
    file::write(&path, &design).unwrap();
    let mut window = self::window(design, Some(path));
    run(folder.path(), &["export", "quick.plush", "-o", "cli", "--stretch"]);

    let told = |window: &Window| -> Vec<String> {
        session(window).messages().list().iter().map(|message| message.text.clone()).collect()
    };
    let folder = folder.path();
    export(&mut window, &folder.join("window"), |_| ());
    assert!(!folder.join("window").exists());
    assert!(told(&window).iter().any(|text| text.contains("“Stretch what is too quick”")), "{:?}", told(&window));

    export(&mut window, &folder.join("window"), |window| click(window, "Stretch what is too quick"));
    same_blueprint(folder, "cli", "window");
    let manifest: Manifest = serde_json::from_slice(&fs::read(folder.join("cli/manifest.json")).unwrap()).unwrap();
    assert!(!manifest.remarks.is_empty());
    let shown = told(&window).concat();
    assert!(manifest.remarks.iter().take(4).all(|remark| shown.contains(&**remark)), "{shown}");
}

#[test]
fn what_is_arranged_and_starched_is_the_same_both_ways() {
    let (folder, mut window) = bar();
    let at = |window: &Window, p: [f64; 2]| on_screen(window, "Idealized view", p);
    click(&mut window, "Pin the middle");
    for x in [90.0, 115.0] {
        let (from, to) = (at(&window, [x, 38.0]), at(&window, [x, 46.0]));
        drag(&mut window, from, to);
    }
    assert_eq!(session(&window).design().poses[0].targets.len(), 2);
    let (a, b) = (folder.path().join("a.plush"), folder.path().join("b.plush"));
    file::write(&a, session(&window).design()).unwrap();
    run(folder.path(), &["arrange", "a.plush", "--pose", "Pose 1", "--move", "0,1", "-o", "b.plush"]);
    press(&mut window, Modifiers::NONE, Key::A);
    click(&mut window, "Target 1");
    window.get_by_label("Target 2").click_modifiers(Modifiers::COMMAND);
    settle(&mut window);
    press(&mut window, Modifiers::NONE, Key::ArrowUp);
    same(&window, &b);
    run(folder.path(), &["arrange", "b.plush", "--pose", "Pose 1", "--mirror"]);
    click(&mut window, "Mirror");
    same(&window, &b);
    run(folder.path(), &["starch", "b.plush", "--at", "20,20", "--radius", "15", "--factor", "4"]);
    click(&mut window, "Rest");
    press(&mut window, Modifiers::NONE, Key::B);
    enter(&mut window, Role::SpinButton, "Radius of the brush", "15");
    let place = at(&window, [20.0, 20.0]);
    drag(&mut window, place, place);
    same(&window, &b);
}
