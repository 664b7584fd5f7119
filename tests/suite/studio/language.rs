//! The language of the window: chosen, kept, and spoken everywhere.

use crate::support::window::{Window, bar, drag, network, on_screen, open, press, services, session, settle, window};
use eframe::egui::{Key, Modifiers, accesskit::Role, vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use plushwright::design::{Design, bundled};
use plushwright::studio::language::{ALL, Language};
use plushwright::studio::store::Store;
use std::collections::BTreeSet;

fn german() -> &'static Language {
    Language::of("de").unwrap()
}

/// What a text is called in German.
fn de(english: &str) -> &'static str {
    german().texts().find(|(of, _)| *of == english).unwrap_or_else(|| panic!("{english}")).1
}

/// Runs a command by what it is called now: `search` is the name of the field of the palette.
fn command(window: &mut Window, search: &str, words: &str) {
    press(window, Modifiers::COMMAND | Modifiers::SHIFT, Key::P);
    window.get_by_label(search).type_text(words);
    settle(window);
    press(window, Modifiers::NONE, Key::Enter);
}

fn switch_to_german(window: &mut Window) {
    command(window, "Look for a command", "Deutsch");
    assert_eq!(session(window).look().language.language(), german());
}

fn click(window: &mut Window, english: &str) {
    window.get_by_label(de(english)).click();
    settle(window);
}

/// Everything that the window says: names and values of what is on the screen.
fn said(window: &Window) -> BTreeSet<String> {
    let nodes = window.root().children_recursive();
    nodes.flat_map(|node| [node.accesskit_node().label(), node.accesskit_node().value()]).flatten().collect()
}

/// Whether a text is an English one with its values filled in.
fn is_filled(text: &str, english: &str) -> bool {
    let mut pieces = english.split('{').enumerate().map(|(k, piece)| match (k, piece.split_once('}')) {
        (1.., Some((_, after))) => after,
        _ => piece,
    });
    let first = pieces.next().unwrap_or_default();
    let Some(mut rest) = text.strip_prefix(first) else { return false };
    let pieces: Vec<&str> = pieces.collect();
    let Some((last, between)) = pieces.split_last() else { return rest.is_empty() };
    for piece in between {
        let Some(at) = rest.find(piece) else { return false };
        rest = &rest[at + piece.len()..];
    }
    rest.ends_with(last)
}

/// Nothing is said in English that German has other words for.
fn is_german(window: &Window, place: &str) {
    // With next to no words of its own anything would be one.
    let has_words = |english: &str| {
        let bare: String =
            english.split('{').map(|piece| piece.split_once('}').map_or(piece, |(_, after)| after)).collect();
        bare.split_whitespace().any(|word| word.chars().filter(|c| c.is_alphabetic()).count() > 2)
    };
    let texts: Vec<(&str, &str)> =
        german().texts().filter(|(english, own)| english != own && has_words(english)).collect();
    let own: BTreeSet<&str> = german().texts().map(|(_, own)| own).collect();
    for text in said(window) {
        let text = text.trim_end_matches('…');
        let is_own = own.iter().any(|own| own.trim_end_matches('…') == text || is_filled(text, own));
        if is_own {
            continue;
        }
        let found = texts.iter().find(|(english, _)| is_filled(text, english.trim_end_matches('…')));
        assert!(found.is_none(), "{place}: “{text}” is {found:?}");
    }
}

/// A body with a pose, two keyframes, two networks, one of them switched off.
fn rigged() -> Window {
    let mut design = bar();
    design.networks.push(network());
    let mut second = network();
    (second.name, second.muted) = ("winch 2".into(), true);
    design.networks.push(second);
    let mut window = window(design);
    let (from, to) =
        (on_screen(&window, "Realizable view", [120.0, 20.0]), on_screen(&window, "Realizable view", [115.0, 45.0]));
    drag(&mut window, from, to);
    press(&mut window, Modifiers::NONE, Key::K);
    window.get_by_label("Rest").click();
    settle(&mut window);
    press(&mut window, Modifiers::NONE, Key::K);
    assert_eq!(session(&window).design().keyframes.len(), 2);
    window
}

#[test]
fn the_language_switches_at_once_and_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let again = || {
        let mut window = open(bar(), None, services(), Some(Store::at(folder.path())));
        settle(&mut window);
        window
    };
    let mut first = again();
    first.get_by_label("Add pose");
    first.get_by_label("Settings").click();
    settle(&mut first);
    let choice = |window: &Window, name: &str| window.get_by_role_and_label(Role::ComboBox, name).rect().center();
    let at = choice(&first, "Language");
    assert_eq!(
        first.get_by_role_and_label(Role::ComboBox, "Language").accesskit_node().value().as_deref(),
        Some("System (English)")
    );
    press_at(&mut first, at);
    first.get_by_label("Deutsch").click();
    settle(&mut first);
    assert!(first.query_by_label("Add pose").is_none());
    first.get_by_label("Pose hinzufügen");
    choice(&first, "Sprache");
    drop(first);
    let mut second = again();
    assert_eq!(session(&second).look().language.chosen, Some(german()));
    second.get_by_label("Pose hinzufügen");
    // By its own name, whatever is spoken.
    command(&mut second, de("Look for a command"), "English");
    second.get_by_label("Add pose");
    command(&mut second, "Look for a command", "System language");
    assert_eq!(session(&second).look().language.chosen, None);
    drop(second);
    again().get_by_label("Add pose");
}

fn press_at(window: &mut Window, at: eframe::egui::Pos2) {
    window.hover_at(at);
    window.drag_at(at);
    window.step();
    window.drop_at(at);
    settle(window);
}

#[test]
fn the_system_may_speak_german() {
    let mut window: Window =
        egui_kittest::Harness::builder().with_max_steps(32).with_size(vec2(1280.0, 800.0)).build_ui_state(
            |ui, studio| {
                let studio: &mut plushwright::studio::app::Studio = studio.get_or_insert_with(|| {
                    let studio = plushwright::studio::app::Studio::new(ui.ctx(), bar(), None, services());
                    studio.in_language_of_system(german())
                });
                studio.update(ui);
            },
            None,
        );
    settle(&mut window);
    window.get_by_label("Pose hinzufügen");
    assert_eq!(session(&window).look().language.chosen, None);
    command(&mut window, de("Look for a command"), "English");
    window.get_by_label("Add pose");
}

#[test]
fn what_a_thread_has_to_say_is_in_the_language_of_its_window() {
    let mut failing = services();
    failing.propose = std::sync::Arc::new(|_, _, _, _, _| panic!("out of yarn"));
    let mut window = crate::support::window::window_with(bar(), failing);
    crate::support::window::pose(&mut window, "Idealized view");
    switch_to_german(&mut window);
    click(&mut window, "Propose networks");
    let text = &session(&window).messages().list().last().unwrap().text;
    assert!(text.starts_with(&format!("{} ist gescheitert: ", de("Network discovery"))), "{text}");
    // Another window, on another thread, is none the wiser.
    assert_eq!(std::thread::spawn(plushwright::studio::language::spoken).join().unwrap(), &ALL[0]);
}

#[test]
fn every_panel_and_menu_speaks_german() {
    let mut window = rigged();
    switch_to_german(&mut window);
    is_german(&window, "at first");
    for panel in ["Mesh", "Motors", "Settings", "Networks"] {
        click(&mut window, panel);
        is_german(&window, panel);
    }
    for menu in ["File", "Examples", "View"] {
        click(&mut window, menu);
        is_german(&window, menu);
        press(&mut window, Modifiers::NONE, Key::Escape);
    }
    window.get_by_role_and_label(Role::ComboBox, de("Quality")).click();
    settle(&mut window);
    is_german(&window, "quality");
    press(&mut window, Modifiers::NONE, Key::Escape);
    for folded in ["Advanced", "All poses", "Wind by hand"] {
        click(&mut window, folded);
        is_german(&window, folded);
    }
    window.get_by_label("Pose 1").click();
    settle(&mut window);
    click(&mut window, "Propose networks");
    assert!(!session(&window).discovery().proposals.is_empty());
    is_german(&window, "proposals");
    for look in ["Strain", "Gap", "Cable force", "Fibre contraction", "Crumpling"] {
        command(&mut window, de("Look for a command"), de(look));
        is_german(&window, look);
    }
    // All of the timeline picked out, its tools on the left, what lies under the pointer.
    command(&mut window, de("Look for a command"), de("Select all keyframes"));
    is_german(&window, "keyframes");
    command(&mut window, de("Look for a command"), de("Starch brush"));
    is_german(&window, "brush");
    let at = window.get_by_label(de("Realizable view")).rect().center();
    window.hover_at(at);
    window.step();
    window.event(eframe::egui::Event::PointerButton {
        pos: at,
        button: eframe::egui::PointerButton::Secondary,
        pressed: true,
        modifiers: Modifiers::NONE,
    });
    window.step();
    window.event(eframe::egui::Event::PointerButton {
        pos: at,
        button: eframe::egui::PointerButton::Secondary,
        pressed: false,
        modifiers: Modifiers::NONE,
    });
    settle(&mut window);
    is_german(&window, "context menu");
}

#[test]
fn every_dialog_and_page_speaks_german() {
    let folder = tempfile::tempdir().unwrap();
    let taken = folder.path().join("taken.plush");
    std::fs::write(&taken, bundled::ALL[0].text).unwrap();
    let mut window = rigged();
    switch_to_german(&mut window);
    let pages = ["Start page", "Keyboard shortcuts", "Messages"];
    let dialogs = ["Save as…", "Export…", "Export film…", "Open…", "New from outline…"];
    for words in pages.into_iter().chain(dialogs) {
        command(&mut window, de("Look for a command"), de(words));
        is_german(&window, words);
        let is_question = window.query_by_label(de("Discard changes")).is_some();
        if is_question {
            click(&mut window, "Discard changes");
            is_german(&window, words);
        }
        for folded in ["Parts and sheets", "Controllers", "Reading and clean-up"] {
            if window.query_by_label(de(folded)).is_some() {
                click(&mut window, folded);
                is_german(&window, folded);
            }
        }
        if words == "Save as…" {
            window.get_by_label(de("Path")).focus();
            window.step();
            window.key_press_modifiers(Modifiers::COMMAND, Key::A);
            window.step();
            window.get_by_label(de("Path")).type_text(&taken.to_string_lossy());
            settle(&mut window);
            press(&mut window, Modifiers::NONE, Key::Enter);
            window.get_by_label(de("Replace it"));
            is_german(&window, "replace");
        }
        press(&mut window, Modifiers::NONE, Key::Escape);
    }
    press(&mut window, Modifiers::COMMAND | Modifiers::SHIFT, Key::P);
    is_german(&window, "palette");
    press(&mut window, Modifiers::NONE, Key::Escape);
    command(&mut window, de("Look for a command"), de("Edit outline"));
    is_german(&window, "outline");
    command(&mut window, de("Look for a command"), de("Polygon"));
    is_german(&window, "polygon");
}

#[test]
fn every_example_and_what_comes_next_is_told_in_german() {
    let design = |k: usize| -> Design { bundled::ALL[k].design().unwrap() };
    let mut window = window(design(0));
    switch_to_german(&mut window);
    is_german(&window, bundled::ALL[0].name);
    command(&mut window, de("Look for a command"), de("Panel Networks"));
    for network in session(&window).design().networks.clone() {
        window.get_by_label(&de("Network {name}").replace("{name}", &network.name)).click();
        settle(&mut window);
        is_german(&window, &network.name);
    }
}
