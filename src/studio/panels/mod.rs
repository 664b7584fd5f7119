//! The panels. Each borrows the session, read only, and says what it wants as actions.

pub mod buttons;
pub mod dialogs;
pub mod discovery;
pub mod mesh;
pub mod messages;
pub mod networks;
pub mod outline;
pub mod palette;
pub mod poses;
pub mod quality;
pub mod settings;
pub mod shortcuts;
pub mod status;
pub mod timeline;
pub mod toolbar;

use super::action::Action;
pub use super::action::Actions;
use super::commands::document::CANCEL_MESHING;
use super::session::Session;
use super::style;
use super::viewport::thumbnail::Thumbnails;
use eframe::egui::{Button, Frame, Margin, Response, RichText, Spinner, Ui};

/// What belongs to the controls alone: half-typed text, which tab is open.
#[derive(Default)]
pub struct State {
    pub tab: Tab,
    pub timeline: timeline::State,
    pub mesh: mesh::State,
    pub palette: palette::State,
    pub thumbnails: Thumbnails,
    /// Whether pictures can be drawn.
    pub gpu: bool,
}

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tab {
    #[default]
    Networks,
    Mesh,
    Settings,
}

/// Height of a button that takes the width of its panel, logical pixels.
pub const WIDE: f32 = 30.0;

/// Of side panels: no fill, see [`style`].
pub fn frame() -> Frame {
    Frame::new().inner_margin(Margin::symmetric(12, 10))
}

/// A heading of a panel.
pub fn heading(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).strong().size(13.5));
}

/// The one button of a panel that matters most.
pub fn primary(ui: &mut Ui, enabled: bool, text: &str, width: f32) -> Response {
    let theme = style::theme_of(ui.visuals());
    let label = RichText::new(text).strong().color(style::on_accent(theme));
    wide(ui, enabled, Button::new(label).fill(style::accent(theme)), width)
}

/// What stands in the place of a button while it is at work.
pub fn meshing(ui: &mut Ui, session: &Session, actions: &mut Actions) {
    ui.horizontal(|ui| {
        ui.add(Spinner::new());
        ui.label("Meshing");
        buttons::text(ui, session, &CANCEL_MESHING, actions);
    });
}

/// A button of a given width, its text in the middle.
pub fn wide(ui: &mut Ui, enabled: bool, button: Button<'_>, width: f32) -> Response {
    ui.add_enabled_ui(enabled, |ui| ui.add_sized([width, WIDE], button)).inner
}

/// A text field that is taken with Enter or a click elsewhere and dropped with Escape. The name, once it is taken.
pub fn name_field(ui: &mut Ui, session: &Session, label: &str, actions: &mut Actions) -> Option<String> {
    let (what, text) = session.renaming()?;
    let mut typed = text.clone();
    let field = eframe::egui::TextEdit::singleline(&mut typed).desired_width(f32::INFINITY);
    let response = ui.add(field).accessible_name(label);
    if !response.has_focus() && !response.lost_focus() {
        response.request_focus();
    }
    if response.lost_focus() {
        actions.push(Action::Typed(None));
        return (!ui.input(|i| i.key_pressed(eframe::egui::Key::Escape))).then_some(typed);
    }
    if typed != *text {
        actions.push(Action::Typed(Some((*what, typed))));
    }
    None
}
