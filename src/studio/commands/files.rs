//! Commands of files, and of the window as a whole.

use super::command::{Command, Group, Keys, Place};
use crate::studio::action::FileAction;
use crate::studio::acts;
use crate::studio::language::t;
use crate::studio::session::Overlay;
use eframe::egui::Key;

pub static ALL: [&Command; 12] =
    [&START, &NEW, &NEW_DRAWING, &OPEN, &SAVE, &SAVE_AS, &EXPORT, &PALETTE, &SHORTCUTS, &LOG, &STOP, &QUIT];

pub static START: Command = Command {
    places: &[Place::FileMenu],
    run: &|session, _| session.overlay = Some(Overlay::Start),
    ..Command::new("file.start", "Start page", "Designs to begin with, recent files, and new plushies")
};

pub static NEW: Command = Command {
    keys: &[Keys::ctrl(Key::N)],
    places: &[Place::FileMenu],
    ends_drawing: true,
    run: &|session, _| acts::filing::ask(session, FileAction::Import),
    ..Command::new("file.new", "New from outline…", "Make a plushie of an SVG, picture, DXF, OBJ or drawing")
};

pub static NEW_DRAWING: Command = Command {
    keys: &[Keys::ctrl_shift(Key::O)],
    while_typing: true,
    places: &[Place::FileMenu],
    ends_drawing: true,
    run: &|session, _| acts::filing::ask(session, FileAction::NewDrawing),
    ..Command::new("file.new-drawing", "New drawing", "Draw a plushie on an empty sheet")
};

pub static OPEN: Command = Command {
    keys: &[Keys::ctrl(Key::O)],
    while_typing: true,
    places: &[Place::FileMenu],
    ends_drawing: true,
    run: &|session, _| acts::filing::ask(session, FileAction::Open),
    ..Command::new("file.open", "Open…", "Open a plushie")
};

pub static SAVE: Command = Command {
    keys: &[Keys::ctrl(Key::S)],
    while_typing: true,
    places: &[Place::FileMenu, Place::Toolbar(Group::File)],
    ends_drawing: true,
    run: &|session, _| acts::filing::ask(session, FileAction::Save),
    ..Command::new("file.save", "Save", "Save the plushie")
};

pub static SAVE_AS: Command = Command {
    keys: &[Keys::ctrl_shift(Key::S)],
    while_typing: true,
    places: &[Place::FileMenu],
    ends_drawing: true,
    run: &|session, _| acts::filing::ask(session, FileAction::SaveAs),
    ..Command::new("file.save-as", "Save as…", "Save the plushie under another name")
};

pub static EXPORT: Command = Command {
    keys: &[Keys::ctrl(Key::E)],
    while_typing: true,
    places: &[Place::FileMenu, Place::Toolbar(Group::Right)],
    ends_drawing: true,
    run: &|session, _| acts::filing::ask(session, FileAction::Export),
    ..Command::new(
        "file.export",
        "Export…",
        "Write patterns to cut, or to print as PDF on A4 or Letter pages, ways of the threads to sew, and programs for motors",
    )
};

pub static PALETTE: Command = Command {
    keys: &[Keys::ctrl_shift(Key::P)],
    while_typing: true,
    places: &[Place::FileMenu],
    run: &|session, _| session.overlay = Some(Overlay::Palette),
    ..Command::new("window.commands", "All commands…", "Look for a command by name")
};

pub static SHORTCUTS: Command = Command {
    keys: &[Keys::plain(Key::F1)],
    while_typing: true,
    places: &[Place::FileMenu],
    run: &|session, _| session.overlay = Some(Overlay::Shortcuts),
    ..Command::new("window.shortcuts", "Keyboard shortcuts", "Show what every key does")
};

pub static LOG: Command = Command {
    places: &[Place::FileMenu],
    run: &|session, _| session.overlay = Some(Overlay::Log),
    ..Command::new("window.messages", "Messages", "Show everything that the window has said")
};

pub static STOP: Command = Command {
    why_not: &|session, _| (!session.can_stop()).then_some(t("Nothing is at work that can be stopped")),
    run: &|session, _| acts::filing::stop(session),
    ..Command::new("work.stop", "Stop work", "Stop what the window is busy with; nothing of it is kept")
};

pub static QUIT: Command = Command {
    keys: &[Keys::ctrl(Key::Q)],
    while_typing: true,
    places: &[Place::FileMenu],
    ends_drawing: true,
    run: &|session, _| acts::filing::ask(session, FileAction::Quit),
    ..Command::new("window.quit", "Quit", "Close the window; unsaved changes are asked about")
};
