//! Commands of what is shown: camera, layers, views, theme, quality.

use super::command::{Command, Group, Keys, Place, Scope};
use crate::picture::palette::Theme;
use crate::studio::acts::frame;
use crate::studio::canvas::Plushie;
use crate::studio::icons::Icon;
use crate::studio::language::t;
use crate::studio::session::Views;
use eframe::egui::Key;

pub static ALL: [&Command; 15] = [
    &FIT,
    &FIT_SELECTION,
    &ZOOM_IN,
    &ZOOM_OUT,
    &IDEALIZED,
    &REALIZABLE,
    &OVERLAY,
    &STACKED,
    &LINKED,
    &RULERS,
    &ONION,
    &QUALITY,
    &THEME,
    &STILL,
    &GUIDE,
];

/// Of a step with the keys.
const ZOOM: f32 = 1.25;

pub static FIT: Command = Command {
    icon: Some(Icon::Fit),
    keys: &[Keys::plain(Key::F)],
    places: &[Place::Toolbar(Group::Shown), Place::ContextMenu],
    run: &|session, _| {
        if session.sketching.open {
            session.sketching.camera = None;
        } else {
            frame::fit(session);
        }
    },
    ..Command::new(
        "view.fit",
        "Fit view",
        "Fit the body and its goals into the views. Scroll to zoom, drag beside the body to pan",
    )
};

pub static FIT_SELECTION: Command = Command {
    keys: &[Keys::shift(Key::F)],
    scope: Scope::Views,
    places: &[Place::ViewMenu, Place::ContextMenu],
    run: &|session, at| frame::fit_selection(session, at),
    ..Command::new(
        "view.fit-selection",
        "Fit selection",
        "Fit the target, pin, winch or tendon that is selected into the views; with none, the plushies as they are posed",
    )
};

pub static OVERLAY: Command = Command {
    keys: &[Keys::plain(Key::Num3)],
    scope: Scope::Views,
    places: &[Place::ViewMenu],
    on: Some(&|session| session.look.views == Views::Overlay),
    run: &|session, _| {
        let overlaid = session.look.views == Views::Overlay;
        session.look.views = if overlaid { Views::Both } else { Views::Overlay };
    },
    ..Command::new(
        "view.overlay",
        "One view, overlaid",
        "Show the realizable plushie alone, with the outline of the idealized one over it",
    )
};

pub static STACKED: Command = Command {
    scope: Scope::Views,
    places: &[Place::ViewMenu],
    on: Some(&|session| session.look.stacks),
    run: &|session, _| session.look.stacks = !session.look.stacks,
    ..Command::new(
        "view.stacked",
        "Stack views of wide bodies",
        "Show the plushies one above the other where that shows them larger",
    )
};

pub static LINKED: Command = Command {
    scope: Scope::Views,
    places: &[Place::ViewMenu],
    on: Some(&|session| session.look.linked),
    run: &|session, _| {
        let linked = session.look.linked;
        session.look.link(!linked);
    },
    ..Command::new("view.linked", "Linked cameras", "Move and zoom both views together, so that they compare")
};

pub static RULERS: Command = Command {
    keys: &[Keys::shift(Key::R)],
    scope: Scope::Views,
    places: &[Place::ViewMenu],
    on: Some(&|session| session.look.rulers),
    run: &|session, _| session.look.rulers = !session.look.rulers,
    ..Command::new("view.rulers", "Rulers and grid", "Show rulers and a grid in mm")
};

pub static ONION: Command = Command {
    keys: &[Keys::shift(Key::K)],
    scope: Scope::Views,
    places: &[Place::ViewMenu],
    on: Some(&|session| session.look.onion.on),
    why_not: &|session, _| {
        session.design().keyframes.is_empty().then_some(t("There are no keyframes whose neighbours could be shown"))
    },
    run: &|session, _| session.look.onion.on = !session.look.onion.on,
    ..Command::new(
        "view.onion",
        "Onion skins",
        "Show the realizable plushie at the keyframes before (blue) and after (orange) the playhead",
    )
};

pub static ZOOM_IN: Command = Command {
    keys: &[Keys::plain(Key::Plus), Keys::shift(Key::Plus), Keys::plain(Key::Equals)],
    run: &|session, _| session.look.zoom(ZOOM),
    ..Command::new("view.zoom-in", "Zoom in", "Show less, larger")
};

pub static ZOOM_OUT: Command = Command {
    keys: &[Keys::plain(Key::Minus)],
    run: &|session, _| session.look.zoom(1.0 / ZOOM),
    ..Command::new("view.zoom-out", "Zoom out", "Show more, smaller")
};

pub static IDEALIZED: Command = Command {
    icon: Some(Icon::LeftView),
    keys: &[Keys::plain(Key::Num1)],
    scope: Scope::Views,
    places: &[Place::Toolbar(Group::Views)],
    on: Some(&|session| session.look.views.shows(Plushie::Idealized)),
    run: &|session, _| session.look.views = session.look.views.toggled(Plushie::Idealized),
    ..Command::new(
        "view.idealized",
        "Show idealized view",
        "Show the idealized plushie. Hidden, it is not solved and costs nothing",
    )
};

pub static REALIZABLE: Command = Command {
    icon: Some(Icon::RightView),
    keys: &[Keys::plain(Key::Num2)],
    scope: Scope::Views,
    places: &[Place::Toolbar(Group::Views)],
    on: Some(&|session| session.look.views.shows(Plushie::Realizable)),
    run: &|session, _| session.look.views = session.look.views.toggled(Plushie::Realizable),
    ..Command::new(
        "view.realizable",
        "Show realizable view",
        "Show the realizable plushie. Hidden, it is not solved; only where the fibres build on winches these are still wound",
    )
};

pub static QUALITY: Command = Command {
    keys: &[Keys::plain(Key::Q)],
    scope: Scope::Views,
    run: &|session, _| session.solver.next_quality(),
    ..Command::new("view.quality", "Next quality", "Draft, balanced, accurate: how much work a frame may take")
};

pub static THEME: Command = Command {
    icon: Some(Icon::Moon),
    keys: &[Keys::plain(Key::T)],
    places: &[Place::Toolbar(Group::Right)],
    on: Some(&|session| session.look.theme == Theme::Dark),
    face_on: Some((Icon::Sun, "Light theme", "Switch to the light theme")),
    run: &|session, _| {
        session.look.theme = match session.look.theme {
            Theme::Light => Theme::Dark,
            Theme::Dark => Theme::Light,
        }
    },
    ..Command::new("view.theme", "Dark theme", "Switch to the dark theme")
};

pub static STILL: Command = Command {
    on: Some(&|session| session.look.still),
    run: &|session, _| session.look.still = !session.look.still,
    ..Command::new("view.still", "Reduced motion", "Nothing in the window moves by itself but what is asked to play")
};

pub static GUIDE: Command = Command {
    on: Some(&|session| session.guided),
    run: &|session, _| session.guided = !session.guided,
    ..Command::new("view.guide", "Next step", "Show what comes next on the way to a plushie, on top")
};
