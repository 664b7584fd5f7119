//! The kinds of links, one a file.

mod file;
mod simulated;

pub use file::FileLink;
pub use simulated::SimulatedLink;
