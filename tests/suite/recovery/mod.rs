//! The window loses nothing: closing asks, work that is not saved comes back, files of others are not replaced without a question.

mod hostile;

use crate::support::window::{Window, enter_path, open, session};
use eframe::egui::{self, Key, Modifiers, ViewportEvent, ViewportId, vec2};
use egui_kittest::kittest::Queryable;
use plushwright::design::{Design, bundled, edit, file};
use plushwright::studio::session::Services;
use plushwright::studio::store::Store;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::time::{Duration, Instant};

fn pig() -> Design {
    bundled::ALL[0].design().unwrap()
}

fn services() -> Services {
    Services { propose: Arc::new(|_, _, _, _, _| Vec::new()), export: Arc::new(|_, _, _, _| Ok(Vec::new())) }
}

/// A window on a design, and on a file where it has one, that keeps its state in `state`.
fn window(design: Design, path: Option<&Path>, state: &Path) -> Window {
    let mut window = open(design, path.map(Path::to_path_buf), services(), Some(Store::at(state)));
    // The views need not be solved for any of this.
    steps(&mut window);
    window
}

fn steps(window: &mut Window) {
    (0..4).for_each(|_| window.step());
}

fn click(window: &mut Window, name: &str) {
    window.get_by_label(name).click();
    steps(window);
}

fn press(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    steps(window);
}

fn type_path(window: &mut Window, path: &Path) {
    enter_path(window, path);
    steps(window);
}

/// The desktop asks the window to close.
fn close(window: &mut Window) {
    window.input_mut().viewports.get_mut(&ViewportId::ROOT).unwrap().events.push(ViewportEvent::Close);
    steps(window);
}

fn change(window: &mut Window) {
    press(window, Modifiers::COMMAND | Modifiers::SHIFT, Key::N);
    assert!(session(window).history().is_modified());
}

fn is_asked(window: &Window) -> bool {
    window.query_by_label("Discard changes").is_some()
}

/// The window is gone, and so are the locks of its work: a child that another test has just started may hold them for a moment.
fn left(window: Window, state: &Path) {
    drop(window);
    let started = Instant::now();
    let is_held = || {
        let folders = fs::read_dir(state.join("work")).into_iter().flatten().flatten();
        let mut locks = folders.filter_map(|entry| fs::File::open(entry.path().join("lock")).ok());
        locks.any(|lock| lock.try_lock().is_err())
    };
    while is_held() {
        assert!(started.elapsed() < Duration::from_secs(10), "the work of a window that is gone is locked");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Frames until the work is on the disk.
fn kept(window: &mut Window, state: &Path) {
    let poses = session(window).design().poses.len();
    kept_as(window, state, |design| design.poses.len() == poses);
}

fn kept_as(window: &mut Window, state: &Path, is: impl Fn(&Design) -> bool) {
    let started = Instant::now();
    let is_kept = || {
        let folders = fs::read_dir(state.join("work")).into_iter().flatten().flatten();
        let mut designs = folders.map(|entry| file::read(&entry.path().join("work.plush")));
        designs.any(|design| design.is_ok_and(|design| is(&design)))
    };
    while !is_kept() {
        assert!(started.elapsed() < Duration::from_secs(30), "nothing was kept");
        window.step();
        std::thread::sleep(Duration::from_millis(20));
    }
}

fn messages(window: &Window) -> String {
    session(window).messages().list().iter().map(|message| message.text.clone() + "\n").collect()
}

#[test]
fn closing_twice_asks_twice() {
    let state = tempfile::tempdir().unwrap();
    let mut window = window(pig(), None, state.path());
    change(&mut window);
    for _ in 0..3 {
        close(&mut window);
        assert!(is_asked(&window) && !session(&window).is_closing());
    }
    click(&mut window, "Cancel");
    for _ in 0..3 {
        press(&mut window, Modifiers::COMMAND, Key::Q);
        assert!(is_asked(&window) && !session(&window).is_closing());
    }
    click(&mut window, "Cancel");
    // Over any dialog, one that was opened past a question too.
    let open: [&dyn Fn(&mut Window); 4] = [
        &|window| press(window, Modifiers::COMMAND | Modifiers::SHIFT, Key::S),
        &|window| press(window, Modifiers::COMMAND, Key::E),
        &|window| {
            press(window, Modifiers::COMMAND, Key::N);
            click(window, "Discard changes");
        },
        &|window| {
            press(window, Modifiers::COMMAND, Key::O);
            click(window, "Discard changes");
        },
    ];
    for open in open {
        open(&mut window);
        assert!(window.query_by_label("Path").is_some());
        close(&mut window);
        assert!(is_asked(&window) && !session(&window).is_closing());
        click(&mut window, "Cancel");
    }
    close(&mut window);
    click(&mut window, "Discard changes");
    assert!(session(&window).is_closing());
    let left = fs::read_dir(state.path().join("work")).unwrap().count();
    assert_eq!(left, 0, "nothing is left of what was not wanted");
}

#[test]
fn saving_on_the_way_out_closes_and_leaves_nothing() {
    let (state, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let mut window = window(pig(), None, state.path());
    change(&mut window);
    close(&mut window);
    click(&mut window, "Save changes");
    type_path(&mut window, &folder.path().join("pig.plush"));
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert!(session(&window).is_closing());
    assert_eq!(file::read(&folder.path().join("pig.plush")).unwrap().poses.len(), pig().poses.len() + 1);
    assert_eq!(fs::read_dir(state.path().join("work")).unwrap().count(), 0);
}

#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        fs::read(&self.0).map_err(|error| error.to_string())
    }
}

#[test]
fn a_file_dropped_on_a_dialog_replaces_nothing() {
    let (state, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let other = folder.path().join("other.plush");
    file::write(&other, &bundled::ALL[1].design().unwrap()).unwrap();
    let mut window = window(pig(), None, state.path());
    let drop = |window: &mut Window| {
        window.input_mut().dropped_files.push(Arc::new(Dropped(other.clone())));
        steps(window);
    };
    change(&mut window);
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    drop(&mut window);
    assert!(session(&window).design().name == "pig" && messages(&window).contains("answer the dialog first"));
    click(&mut window, "Cancel");
    drop(&mut window);
    assert!(is_asked(&window) && session(&window).design().name == "pig");
    click(&mut window, "Discard changes");
    assert_eq!(session(&window).design().name, "robot");
}

#[test]
fn work_that_was_not_saved_is_offered_by_the_next_window() {
    let (state, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let path = folder.path().join("pig.plush");
    file::write(&path, &pig()).unwrap();
    let before = fs::read(&path).unwrap();
    let mut first = window(pig(), Some(&path), state.path());
    change(&mut first);
    kept(&mut first, state.path());
    let work = session(&first).design().clone();
    // As after a kill: it neither asked nor saved.
    left(first, state.path());
    assert_eq!(fs::read(&path).unwrap(), before);
    let mut second = window(bundled::ALL[1].design().unwrap(), None, state.path());
    assert!(second.query_by_label_contains("Recover “pig”").is_some());
    // Not now: it is offered again.
    click(&mut second, "Not now");
    left(second, state.path());
    let mut third = window(bundled::ALL[1].design().unwrap(), None, state.path());
    click(&mut third, "Recover");
    assert_eq!(**session(&third).design(), *work);
    assert!(session(&third).history().is_modified());
    // It is not lost by being recovered either.
    left(third, state.path());
    let mut fourth = window(bundled::ALL[1].design().unwrap(), None, state.path());
    click(&mut fourth, "Recover");
    press(&mut fourth, Modifiers::COMMAND, Key::S);
    assert_eq!(file::read(&path).unwrap(), *work);
    close(&mut fourth);
    assert!(session(&fourth).is_closing());
    drop(fourth);
    let fifth = window(pig(), None, state.path());
    assert!(fifth.query_by_label_contains("Recover").is_none());
}

#[test]
fn work_that_was_not_saved_is_offered_on_the_start_page() {
    let state = tempfile::tempdir().unwrap();
    let mut first = window(pig(), None, state.path());
    change(&mut first);
    kept(&mut first, state.path());
    // As after a kill: it neither asked nor saved.
    left(first, state.path());
    let mut given = Some(Store::at(state.path()));
    let mut window: Window =
        egui_kittest::Harness::builder().with_size(eframe::egui::vec2(1280.0, 800.0)).build_ui_state(
            move |ui, studio: &mut Option<plushwright::studio::app::Studio>| {
                let make = || plushwright::studio::app::Studio::new(ui.ctx(), pig(), None, services());
                let studio = studio.get_or_insert_with(|| {
                    make().with_store(ui.ctx(), given.take().expect("made once")).with_start_page()
                });
                studio.update(ui);
            },
            None,
        );
    steps(&mut window);
    // No question stands in the way: it is the first thing on the page.
    assert!(window.query_by_label_contains("Recover “pig”").is_none());
    let [offer, examples] = ["Recover", "Open example Pig"].map(|name| window.get_by_label(name).rect());
    assert!(offer.bottom() < examples.top());
    let before = session(&window).design().poses.len();
    click(&mut window, "Recover");
    assert_eq!(session(&window).design().poses.len(), before + 1);
    assert!(session(&window).history().is_modified() && session(&window).overlay().is_none());
}

#[test]
fn a_texture_that_was_recovered_goes_with_every_copy_that_is_saved() {
    let (state, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let at = |name: &str| folder.path().join(name);
    let skin = at("skin.png");
    image::RgbImage::from_pixel(4, 4, image::Rgb([200, 30, 30])).save(&skin).unwrap();
    let picture = fs::read(&skin).unwrap();
    let design = Design { texture: Some("skin.png".into()), ..pig() };
    file::write(&at("pig.plush"), &design).unwrap();
    let mut first = window(design, Some(&at("pig.plush")), state.path());
    change(&mut first);
    kept(&mut first, state.path());
    left(first, state.path());
    // Its own folder is gone by then: the picture that was kept is the only one.
    fs::remove_file(&skin).unwrap();
    fs::remove_file(at("pig.plush")).unwrap();
    let mut second = window(pig(), None, state.path());
    click(&mut second, "Recover");
    for (name, texture) in [("one.plush", "one.texture.png"), ("two.plush", "two.texture.png")] {
        press(&mut second, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
        type_path(&mut second, &at(name));
        press(&mut second, Modifiers::NONE, Key::Enter);
        assert_eq!(file::read(&at(name)).unwrap().texture.as_deref(), Some(texture), "{}", messages(&second));
        assert!(fs::read(at(texture)).unwrap() == picture);
        assert!(!session(&second).history().is_modified());
    }
    close(&mut second);
    assert!(session(&second).is_closing());
    drop(second);
    assert_eq!(fs::read_dir(state.path().join("work")).unwrap().count(), 0);
}

#[test]
fn a_line_that_is_only_being_drawn_is_kept_too() {
    let state = tempfile::tempdir().unwrap();
    let mut first = window(pig(), None, state.path());
    press(&mut first, Modifiers::COMMAND | Modifiers::SHIFT, Key::O);
    press(&mut first, Modifiers::NONE, Key::P);
    let center = first.get_by_label("Drawing sheet").rect().center();
    for corner in [vec2(-80.0, -60.0), vec2(80.0, -60.0), vec2(0.0, 70.0)] {
        first.hover_at(center + corner);
        first.step();
        first.drag_at(center + corner);
        first.step();
        first.drop_at(center + corner);
        steps(&mut first);
    }
    assert_eq!(session(&first).drawing().parts.len(), 0, "it is not closed yet");
    let corners = |design: &Design| design.drawing.as_ref()?.parts.first().map(|part| part.primitive.handles().len());
    kept_as(&mut first, state.path(), |design| corners(design) == Some(3));
    left(first, state.path());
    let mut second = window(pig(), None, state.path());
    click(&mut second, "Recover");
    let drawing = session(&second).design().drawing.clone().unwrap();
    assert_eq!((drawing.parts.len(), drawing.parts[0].primitive.handles().len()), (1, 3));
}

#[test]
fn a_file_that_was_changed_is_not_replaced_in_silence() {
    let (state, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let path = folder.path().join("pig.plush");
    file::write(&path, &pig()).unwrap();
    let mut window = window(pig(), Some(&path), state.path());
    let mut theirs = pig();
    edit::rename(&mut theirs, "theirs").unwrap();
    file::write(&path, &theirs).unwrap();
    change(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::S);
    assert!(window.query_by_label_contains("was changed by another program").is_some());
    assert_eq!(file::read(&path).unwrap().name, "theirs");
    click(&mut window, "Cancel");
    assert!(session(&window).history().is_modified());
    press(&mut window, Modifiers::COMMAND, Key::S);
    click(&mut window, "Replace it");
    assert_eq!(file::read(&path).unwrap().name, "pig");
    // Now it is ours again.
    change(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::S);
    assert!(!session(&window).history().is_modified());

    fs::remove_file(&path).unwrap();
    Command::new("mkfifo").arg(&path).status().unwrap();
    change(&mut window);
    press(&mut window, Modifiers::COMMAND, Key::S);
    assert!(messages(&window).contains("nothing would be kept") && session(&window).history().is_modified());
}

#[test]
fn saving_over_another_file_is_a_question() {
    let (state, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let [notes, other] = ["notes.txt", "other.plush"].map(|name| folder.path().join(name));
    fs::write(&notes, "mine").unwrap();
    file::write(&other, &bundled::ALL[1].design().unwrap()).unwrap();
    let mut window = window(pig(), None, state.path());
    for (path, said) in [(&notes, "That file is no plushie"), (&other, "Another plushie has that name")] {
        let before = fs::read(path).unwrap();
        press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
        type_path(&mut window, path);
        press(&mut window, Modifiers::NONE, Key::Enter);
        assert!(window.query_by_label_contains(said).is_some(), "{said}");
        click(&mut window, "Cancel");
        assert_eq!(fs::read(path).unwrap(), before);
    }
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    type_path(&mut window, &notes);
    press(&mut window, Modifiers::NONE, Key::Enter);
    click(&mut window, "Replace it");
    assert_eq!(file::read(&notes).unwrap(), pig());
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    type_path(&mut window, Path::new("/dev/null"));
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert!(messages(&window).contains("nothing would be kept"));
    click(&mut window, "Cancel");
    // A read-only file says so, and what was to follow does not.
    let mut permissions = fs::metadata(&notes).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&notes, permissions).unwrap();
    change(&mut window);
    close(&mut window);
    click(&mut window, "Save changes");
    assert!(messages(&window).contains("read-only") && !session(&window).is_closing());
}

#[test]
fn two_windows_on_one_file_are_told_and_settings_are_remembered() {
    let (state, folder) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let path = folder.path().join("pig.plush");
    file::write(&path, &pig()).unwrap();
    let mut first = window(pig(), Some(&path), state.path());
    assert!(messages(&first).is_empty());
    let second = window(pig(), Some(&path), state.path());
    assert!(messages(&second).contains("open in another window"));
    drop(second);
    let theme = session(&first).look().theme;
    press(&mut first, Modifiers::NONE, Key::T);
    press(&mut first, Modifiers::NONE, Key::M);
    close(&mut first);
    drop(first);
    let third = window(pig(), None, state.path());
    assert_ne!(session(&third).look().theme, theme);
    assert!(!session(&third).look().shown.shows("fibers"));
    assert_eq!(session(&third).recent(), [path]);
}
