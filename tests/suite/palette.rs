//! The palette, the page of shortcuts, and keys: whatever the table of commands says can be done by keyboard alone.

use super::support::window::{Window, bar, click, pose, press, session, settle, window};
use eframe::egui::accesskit::Role::ListBoxOption;
use eframe::egui::{Key, Modifiers};
use egui_kittest::Node;
use egui_kittest::kittest::{NodeT, Queryable};
use plushwright::picture::palette::Theme;
use plushwright::studio::session::Overlay;
use std::time::Duration;

const BOTH: Modifiers = Modifiers { shift: true, ..Modifiers::COMMAND };

/// A line of the palette.
fn row<'a>(window: &'a Window, name: &'a str) -> Node<'a> {
    window.get_by_role_and_label(ListBoxOption, name)
}

#[test]
fn a_command_is_found_and_run_by_keyboard_alone() {
    let mut window = window(bar());
    press(&mut window, BOTH, Key::P);
    assert_eq!(session(&window).overlay(), Some(Overlay::Palette));
    // The field has the focus; what cannot be done says why.
    window.get_by_label("Look for a command").type_text("theme");
    settle(&mut window);
    row(&window, "Dark theme");
    assert!(
        window.query_by_label("Rest").is_some() && window.query_by_role_and_label(ListBoxOption, "Remesh").is_none()
    );
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!((session(&window).overlay(), session(&window).look().theme), (None, Theme::Dark));
    // Down to the second one that is found, and up again.
    press(&mut window, BOTH, Key::P);
    window.get_by_label("Look for a command").type_text("view show");
    settle(&mut window);
    let chosen = |window: &Window, name: &str| row(window, name).accesskit_node().is_selected();
    assert_eq!(chosen(&window, "Show idealized view"), Some(true));
    for (key, is) in [(Key::ArrowDown, false), (Key::ArrowUp, true), (Key::ArrowDown, false)] {
        press(&mut window, Modifiers::NONE, key);
        assert_eq!(chosen(&window, "Show idealized view"), Some(is));
    }
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert!(!session(&window).look().views.shows(plushwright::studio::viewport::Plushie::Realizable));
    assert!(!session(&window).history().is_modified());
}

#[test]
fn the_palette_says_why_a_command_cannot_be_run_and_escape_closes_it() {
    let mut window = window(bar());
    press(&mut window, BOTH, Key::P);
    window.get_by_label("Look for a command").type_text("propose");
    settle(&mut window);
    let name = "Propose networks: Choose a pose with at least one target first: drag a point of the body";
    assert!(row(&window, name).accesskit_node().is_disabled());
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert!(session(&window).messages().list().iter().any(|m| m.text.contains("at least one target")));
    press(&mut window, BOTH, Key::P);
    press(&mut window, Modifiers::NONE, Key::Escape);
    assert_eq!(session(&window).overlay(), None);
    // It is empty when it comes again, and nothing is drawn while it waits.
    press(&mut window, BOTH, Key::P);
    row(&window, "Remesh");
    press(&mut window, Modifiers::NONE, Key::Escape);
    window.run();
    assert_eq!(window.output().viewport_output.values().next().unwrap().repaint_delay, Duration::MAX);
}

#[test]
fn the_palette_stands_still_whatever_is_typed_and_however_often_it_is_opened() {
    let mut window = window(bar());
    let open = |window: &mut Window| {
        press(window, Modifiers::COMMAND | Modifiers::SHIFT, Key::P);
        window.get_by_label("Look for a command").rect()
    };
    let place = open(&mut window);
    for words in ["theme", "no command has this name"] {
        window.get_by_label("Look for a command").type_text(words);
        settle(&mut window);
        assert_eq!(window.get_by_label("Look for a command").rect(), place, "{words}");
        press(&mut window, Modifiers::NONE, Key::Escape);
        assert_eq!(open(&mut window), place, "after {words}");
    }
}

#[test]
fn the_palette_acts_on_what_is_selected() {
    let mut window = window(bar());
    pose(&mut window, "Idealized view");
    press(&mut window, BOTH, Key::P);
    window.get_by_label("Look for a command").type_text("pin this");
    settle(&mut window);
    press(&mut window, Modifiers::NONE, Key::Enter);
    assert_eq!(session(&window).design().pins.len(), 4);
}

#[test]
fn the_page_of_shortcuts_reads_the_table() {
    let mut window = window(bar());
    press(&mut window, Modifiers::NONE, Key::F1);
    for text in ["Outline", "Ctrl+Shift+Z or Ctrl+Y", "Tendon track", "All commands"] {
        window.get_by_label(text);
    }
    click(&mut window, "Close");
    assert_eq!(session(&window).overlay(), None);
}

#[test]
fn a_key_that_cannot_do_anything_says_so() {
    let mut window = window(bar());
    press(&mut window, Modifiers::NONE, Key::G);
    press(&mut window, Modifiers::COMMAND, Key::Z);
    let said = |words: &str| session(&window).messages().list().iter().any(|m| m.text.contains(words));
    assert!(said("at least one target") && said("Nothing to undo"));
    // The keys of the scale, in the views.
    press(&mut window, Modifiers::NONE, Key::Equals);
    let near = session(&window).look().camera.expect("it was zoomed").scale;
    press(&mut window, Modifiers::NONE, Key::Minus);
    let far = session(&window).look().camera.expect("it was zoomed").scale;
    assert!((near / far - 1.25).abs() < 1e-4);
}
