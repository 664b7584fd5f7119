//! The panels. Each borrows the session, read only, and says what it wants as actions.
//!
//! A panel of the inspector is a file, and a line in [`ALL`].

pub mod buttons;
pub mod dialogs;
mod discovery;
pub mod inspector;
mod mesh;
pub mod messages;
mod networks;
pub mod outline;
pub mod palette;
mod panel;
pub mod poses;
pub mod quality;
mod settings;
pub mod shortcuts;
pub mod status;
pub mod timeline;
pub mod toolbar;
mod widgets;

pub use panel::{Entry, Panel};
pub use widgets::{frame, heading, name_field, primary, wide};

/// The panels of the inspector, by their tabs; the first one is open at first.
pub static ALL: [&Entry; 3] = [&networks::ENTRY, &mesh::ENTRY, &settings::ENTRY];
