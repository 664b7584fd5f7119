//! The panels. Each borrows the session, read only, and says what it wants as actions.
//!
//! A panel of the inspector is a file, and a line in [`ALL`].

pub mod accuracy;
mod blueprint_parts;
mod blueprint_preview;
pub mod buttons;
mod curve;
pub mod dialogs;
mod discovery;
mod film;
mod gallery;
mod import;
pub mod inspector;
pub mod log;
mod mesh;
pub mod messages;
mod motors;
mod networks;
mod next;
pub mod outline;
pub mod palette;
mod panel;
pub mod poses;
mod proposal;
mod rig;
mod settings;
mod sewable;
pub mod shortcuts;
mod stages;
pub mod start;
pub mod status;
mod targets;
pub mod tendons;
pub mod timeline;
pub mod toolbar;
mod widgets;
mod winding;

pub use panel::{Entry, Panel};
pub use widgets::frame;

/// The panels of the inspector, by their tabs; the first one is open at first.
pub static ALL: [&Entry; 4] = [&networks::ENTRY, &mesh::ENTRY, &motors::ENTRY, &settings::ENTRY];

#[cfg(test)]
mod tests {
    use super::ALL;
    use crate::studio::commands;

    #[test]
    fn every_panel_has_a_tab_a_tip_and_a_command() {
        for (k, entry) in ALL.iter().enumerate() {
            assert!(ALL[..k].iter().all(|other| other.id != entry.id && other.label != entry.label), "{}", entry.id);
            assert!(entry.id.starts_with("panel.") && entry.tip.len() > 10 && !entry.tip.ends_with('.'));
            assert!(commands::all().any(|command| command.id == entry.id && command.label.ends_with(entry.label)));
        }
    }
}
