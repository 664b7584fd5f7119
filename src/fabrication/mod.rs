//! The blueprint of a design: what is cut, how cables run, and what the motors do.
//!
//! [`products`] are what is made: [`Sheet`]s in mm, [`Table`]s, programs for motors, pages to read. [`writers`] are how each
//! kind is written: SVG, CSV, text, STL. Every product is written by every writer that knows its kind. [`blueprint`] makes the
//! files in memory, [`export`] puts them on the disk, all or none.
//!
//! | file | holds |
//! | --- | --- |
//! | `pattern.svg` | front and mirrored back: `cut`, `stitch`, `note`, `reference` |
//! | `routing.svg`, `routing.csv` | holes and tendons; enough for cables pulled by hand |
//! | `tracks.csv` | cable wound by each winch over time; one row of zeros if the design has no keyframes |
//! | `controller-ascii-setup.txt`, `-motion.txt`, `-stop.txt` | the commands that set up, wind and unwind, for controllers of the classic ASCII family |
//! | `README.txt` | how to use the files, and remarks on this design |
//! | `manifest.json` | name, size and SHA-256 of every other file |
//!
//! ```
//! use plushwright::{design::bundled, fabrication};
//!
//! let pig = bundled::ALL[0].design()?;
//! let (files, manifest) = fabrication::blueprint(&pig, &Default::default())?;
//! assert_eq!(files[0].name, "pattern.svg");
//! assert!(files[0].bytes.starts_with(b"<?xml"));
//! assert_eq!(manifest.files.len() + 1, files.len(), "the manifest names all files but itself");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod blueprint;
mod buildable;
mod cables;
pub mod catalogue;
mod demand;
mod error;
pub mod font;
pub mod guide;
mod judge;
mod options;
pub mod piece;
mod preset;
pub mod prisms;
mod product;
pub mod products;
mod sheet;
mod solid;
pub mod stuffing;
mod table;
pub mod winch;
pub mod writers;

pub use crate::files::folder::{Listed as ManifestFile, MANIFEST};
pub use crate::files::sha256;
pub use blueprint::{File, Manifest, blueprint, export};
pub use cables::{holes, tendon_length_mm};
pub use catalogue::{Catalogue, CatalogueError};
pub use demand::{Demand, demands};
pub use error::ExportError;
pub use options::{Options, Topic, Topics};
pub use preset::{Cutter, Preset};
pub use product::{Content, Part, Product, Section, Shared, Source};
pub use sheet::{Anchor, Color, Entity, Group, Layer, Sheet, Style};
pub use solid::Solid;
pub use table::{Column, Table, Values};
