//! Tools: what a press on a canvas does. A tool is a file, and a line in [`ALL`].

mod arrange;
mod capsule;
mod circle;
mod drag;
mod freehand;
mod grip;
mod parts;
mod pin;
mod polygon;
mod pull;
mod select;
mod snap;
mod starch;
mod tendon;
mod tool;
mod toolbox;
mod track;

pub use pull::PULL;
pub use starch::{RADIUS_MM, STARCH};
pub use tendon::TENDON;
pub use tool::{Drawn, Entry, Tool};
pub use toolbox::{Toolbox, taken};

/// All tools; the first one of a canvas is taken at first.
pub static ALL: [&Entry; 12] = [
    &drag::ENTRY,
    &arrange::ENTRY,
    &pin::ENTRY,
    &starch::ENTRY,
    &tendon::ENTRY,
    &pull::ENTRY,
    &select::ENTRY,
    &freehand::ENTRY,
    &polygon::ENTRY,
    &circle::ENTRY,
    &capsule::ENTRY,
    &track::ENTRY,
];

#[cfg(test)]
mod tests;
