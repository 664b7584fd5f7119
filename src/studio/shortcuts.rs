//! Keys, and files dropped on the window.

use super::action::{Action, FileAction};
use super::panels::{self, poses, quality};
use super::session::{Session, Tool};
use super::sketching::{Pencil, Sketch};
use super::viewport::Plushie;
use crate::outline::drawing::{Item, Primitive};
use crate::picture::LAYERS;
use crate::picture::palette::Theme;
use eframe::egui::{Context, Key, KeyboardShortcut, Modifiers, Popup};

pub fn collect(ctx: &Context, session: &Session, panels: &mut panels::State, typing: bool, actions: &mut Vec<Action>) {
    for file in ctx.input(|i| i.raw.dropped_files.clone()) {
        actions.push(Action::File(FileAction::Dropped(file.path().to_path_buf())));
    }
    if session.files.dialog.is_some() {
        return;
    }
    let command = Modifiers::COMMAND;
    let both = Modifiers::COMMAND | Modifiers::SHIFT;
    let pressed = |modifiers, key| ctx.input_mut(|i| i.consume_shortcut(&KeyboardShortcut::new(modifiers, key)));
    // The longer ones first: a shortcut also matches with more modifiers held.
    for (modifiers, key, action) in [
        (both, Key::S, Action::File(FileAction::SaveAs)),
        (both, Key::O, Action::File(FileAction::NewDrawing)),
        (command, Key::S, Action::File(FileAction::Save)),
        (command, Key::O, Action::File(FileAction::Open)),
        (command, Key::E, Action::File(FileAction::Export)),
        (command, Key::Q, Action::File(FileAction::Quit)),
    ] {
        if pressed(modifiers, key) {
            actions.push(action);
        }
    }
    if typing {
        return;
    }
    if pressed(both, Key::N) {
        actions.push(Action::Change(super::change::Change::AddPose));
    } else if pressed(command, Key::N) {
        actions.push(Action::File(FileAction::Import));
    }
    if pressed(both, Key::Z) || pressed(command, Key::Y) {
        actions.push(Action::Redo);
    } else if pressed(command, Key::Z) {
        actions.push(Action::Undo);
    }
    if let Some(pose) = session.pose.filter(|_| pressed(command, Key::D)) {
        actions.push(Action::Change(super::change::Change::DuplicatePose(pose)));
    }
    if session.sketching().open {
        sketch_keys(ctx, session, actions);
    } else {
        plain_keys(ctx, session, panels, actions);
    }
}

/// Single keys while the outline is drawn. Those that end a line, Enter and Escape, are the sheet's own while there is one.
fn sketch_keys(ctx: &Context, session: &Session, actions: &mut Vec<Action>) {
    let pressed = |key| ctx.input_mut(|i| i.modifiers.is_none() && i.consume_key(Modifiers::NONE, key));
    let sketching = session.sketching();
    for (key, action) in [
        (Key::Delete, Action::DeleteSelected),
        (Key::Backspace, Action::DeleteSelected),
        (Key::V, Action::Sketch(Sketch::Take(Pencil::Select))),
        (Key::S, Action::Sketch(Sketch::Take(Pencil::Sketch))),
        (Key::P, Action::Sketch(Sketch::Take(Pencil::Polygon))),
        (Key::C, Action::Sketch(Sketch::Take(Pencil::Circle))),
        (Key::L, Action::Sketch(Sketch::Take(Pencil::Capsule))),
        (Key::R, Action::Sketch(Sketch::Take(Pencil::Track))),
        (Key::X, Action::Sketch(Sketch::Cut(!sketching.cut))),
        (Key::F, Action::Sketch(Sketch::Camera(None))),
        (Key::O, Action::Sketch(Sketch::Open(false))),
        (Key::T, other_theme(session)),
    ] {
        if pressed(key) {
            actions.push(action);
        }
    }
    if let (Some(Item::Part(part)), Some(point)) = (sketching.item, sketching.point)
        && pressed(Key::K)
    {
        actions.extend(sharpened(session, part, point));
    }
}

/// The point of a path made a corner, or round again.
fn sharpened(session: &Session, part: usize, point: usize) -> Option<Action> {
    let mut drawing = session.drawing().clone();
    let primitive = &mut drawing.parts.get_mut(part)?.primitive;
    let Primitive::Path { points } = &*primitive else { return None };
    let corner = !points.get(point)?.corner;
    *primitive = primitive.with_corner(point, corner);
    let what = if corner { "Sharpen point" } else { "Round point" };
    Some(Action::Change(super::change::Change::Draw { what, drawing }))
}

fn other_theme(session: &Session) -> Action {
    Action::SetTheme(match session.look.theme {
        Theme::Light => Theme::Dark,
        Theme::Dark => Theme::Light,
    })
}

/// Single keys, while nothing is typed.
fn plain_keys(ctx: &Context, session: &Session, panels: &mut panels::State, actions: &mut Vec<Action>) {
    let pressed = |key| ctx.input_mut(|i| i.modifiers.is_none() && i.consume_key(Modifiers::NONE, key));
    let toggled = |plushie| Action::ShowView(plushie, !session.look.views.shows(plushie));
    let space = if session.playback.playing { Action::Pause } else { Action::Play };
    for (key, action) in [
        (Key::Delete, Action::DeleteSelected),
        (Key::O, Action::Sketch(Sketch::Open(true))),
        (Key::V, Action::SetTool(Tool::Drag)),
        (Key::P, Action::SetTool(Tool::Pin)),
        (Key::F, Action::Fit),
        (Key::Num1, toggled(Plushie::Idealized)),
        (Key::Num2, toggled(Plushie::Realizable)),
        (Key::Q, Action::SetQuality(quality::after(session.quality))),
        (Key::T, other_theme(session)),
        (Key::G, Action::Propose),
        (Key::K, Action::AddKeyframe),
        (Key::L, Action::SetLooping(!session.playback.looping)),
    ] {
        if pressed(key) {
            actions.push(action);
        }
    }
    for layer in LAYERS {
        let key = layer.switch.and_then(|switch| Key::from_name(&switch.key?.to_string()));
        if key.is_some_and(|key| session.cannot_show(layer.name).is_none() && pressed(key)) {
            actions.push(Action::ShowLayer(layer.name, !layer.is_shown(&session.look.shown)));
        }
    }
    // A focused button is pressed by Space and Enter.
    let free = ctx.memory(|m| m.focused()).is_none();
    if free && pressed(Key::Space) {
        actions.push(space);
    }
    if pressed(Key::F2) {
        poses::begin_rename(session, panels);
    }
    if let Some(index) = session.discovery.shown {
        if free && pressed(Key::Enter) {
            actions.push(Action::Accept(index));
        } else if pressed(Key::Backspace) {
            actions.push(Action::Reject(index));
        }
    }
    // An open menu or list is closed by it instead.
    if !Popup::is_any_open(ctx) && pressed(Key::Escape) {
        let running = session.discovery.running.is_some() && !session.is_dragging();
        actions.push(if running { Action::CancelPropose } else { Action::Escape });
    }
}
