//! The integration tests, one module a subject, in one binary: the crate is linked once.

mod allocations;
mod architecture;
mod budgets;
mod circles;
mod cli;
mod controllers;
mod document;
mod drag;
mod examples;
mod export;
mod exports;
mod extremes;
#[cfg(unix)]
mod files;
mod friction;
mod hostile;
mod import;
#[cfg(feature = "studio")]
mod languages;
mod layers;
mod live;
mod makers;
mod mesh;
mod minimum;
mod mistakes;
mod muted;
mod networks;
mod networks_reference;
mod outlines;
mod pages;
#[cfg(feature = "studio")]
mod palette;
#[cfg(feature = "studio")]
mod parity;
mod physics;
mod problems;
mod properties;
#[cfg(all(feature = "studio", unix))]
mod recovery;
#[cfg(unix)]
mod replacing;
#[cfg(unix)]
mod rig;
mod soft_ik;
#[cfg(feature = "studio")]
mod studio;
mod support;
mod texture;
mod timelines;
mod tracker;
mod winding;
