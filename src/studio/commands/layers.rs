//! Commands that show and hide the layers of the pictures: one for each that has a switch.

use super::command::{Command, Group, Keys, Place, Scope};
use crate::picture::LAYERS;
use crate::picture::layers::{Entry, Switch};
use crate::studio::icons::Icon;
use crate::studio::session::Session;
use eframe::egui::Key;
use std::sync::LazyLock;

/// One for each layer with a switch, from the body upward.
pub static ALL: LazyLock<Vec<Command>> =
    LazyLock::new(|| LAYERS.iter().filter_map(|layer| Some(command(layer, layer.switch?))).collect());

fn command(layer: &Entry, switch: Switch) -> Command {
    let name = layer.name;
    let key = switch.key.and_then(|key| Key::from_name(&key.to_string()));
    Command {
        icon: Some(Icon::Layer(switch.icon)),
        keys: Box::leak(key.map(Keys::plain).into_iter().collect()),
        scope: Scope::Views,
        places: &[Place::Toolbar(Group::Shown)],
        on: Some(Box::leak(Box::new(move |session: &Session| {
            session.look.shown.shows(name) && session.cannot_show(name).is_none()
        }))),
        why_not: Box::leak(Box::new(move |session: &Session, _| session.cannot_show(name))),
        run: Box::leak(Box::new(move |session: &mut Session, _| {
            let shown = session.look.shown.shows(name);
            session.look.shown.set(name, !shown);
        })),
        ..Command::new(Box::leak(format!("layer.{name}").into_boxed_str()), switch.label, switch.tip)
    }
}
