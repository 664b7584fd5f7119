//! The window, driven by accessible names. No display and no graphics adapter are needed.

mod arranging;
mod craft;
mod files;
mod language;
mod looks;
mod motors;
mod networks;
mod outline;
mod posing;
mod tendons;
mod timeline;
mod views;
mod winding;
