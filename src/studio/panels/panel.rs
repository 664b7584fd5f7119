//! What a panel of the inspector is.

use crate::studio::action::Actions;
use crate::studio::session::Session;
use eframe::egui::Ui;

/// A panel in the table: its tab, and how it is made.
pub struct Entry {
    /// Never changes and stands for it alone: `panel.mesh`.
    pub id: &'static str,
    /// Of its tab.
    pub label: &'static str,
    /// Its contents, as a sentence.
    pub tip: &'static str,
    pub make: fn() -> Box<dyn Panel>,
}

/// The contents of a tab. It reads the session and asks for actions; what it remembers is for the eye alone.
pub trait Panel {
    fn show(&mut self, ui: &mut Ui, session: &Session, actions: &mut Actions);
}
