//! The window, driven by accessible names. No display and no graphics adapter are needed.

mod actions;
mod arranging;
mod craft;
mod files;
mod jobs;
mod language;
mod looks;
mod menus;
mod motors;
mod networks;
mod outline;
mod posing;
mod tendons;
mod timeline;
mod views;
mod winding;
