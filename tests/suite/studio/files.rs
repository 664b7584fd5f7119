//! Opening, saving, importing, textures, and what goes wrong.

use crate::support::window::{
    Window, bar, click, pose, press, services, session, settle, type_path, wait, window, window_with, with_network,
};
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};
use plushwright::studio::messages::Level;
use plushwright::studio::session::Services;
use std::sync::Arc;
use std::time::Duration;

#[test]
fn what_goes_wrong_is_said_and_can_be_dismissed() {
    let services = Services { propose: Arc::new(|_, _, _, _, _| panic!("out of yarn")), ..services() };
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
    click(&mut window, "Holes: fill");
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
fn an_import_shows_what_it_reads_before_it_is_made() {
    let folder = tempfile::tempdir().unwrap();
    let drawing = folder.path().join("sheet.svg");
    let svg = r##"<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200">
        <rect x="20" y="20" width="120" height="90" fill="#fff"/><path d="M40 40h60v50h-60z" fill="#a50"/></svg>"##;
    std::fs::write(&drawing, svg).unwrap();
    let mut window = window(bar());
    press(&mut window, Modifiers::COMMAND, Key::N);
    type_path(&mut window, &drawing);
    let shows = |window: &mut Window, text: &str| {
        let start = std::time::Instant::now();
        while window.query_by_label_contains(text).is_none() {
            assert!(start.elapsed() < std::time::Duration::from_secs(60), "{text}");
            std::thread::sleep(std::time::Duration::from_millis(10));
            window.run_steps(2);
        }
    };
    shows(&mut window, "60 x 50 mm");
    assert!(window.query_by_label("What would be read").is_some());
    assert!(window.query_by_label_contains("was taken for the background and left out").is_some());
    click(&mut window, "Keep it");
    shows(&mut window, "120 x 90 mm");
    assert!(window.query_by_label_contains("was taken for the background").is_none());
    click(&mut window, "Create");
    wait(&mut window, |s| s.design().name == "sheet");
    let (_, high) = session(&window).design().outline.bounding_box();
    assert!((high[0] - 120.0).abs() < 1e-3 && (high[1] - 90.0).abs() < 1e-3, "{high:?}");
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
