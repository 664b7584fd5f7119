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
//! | `controller-<family>-setup`, `-motion`, `-stop` | the commands that set up, wind and unwind, for each of the [`families`](crate::motion::families) of controllers |
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
mod cables;
mod error;
mod judge;
mod options;
mod product;
pub mod products;
mod sheet;
mod solid;
mod table;
pub mod writers;

pub use crate::files::folder::{Listed as ManifestFile, MANIFEST};
pub use crate::files::sha256;
pub use blueprint::{File, Manifest, blueprint, export};
pub use cables::{holes, tendon_length_mm};
pub use error::ExportError;
pub use options::Options;
pub use product::{Content, Part, Product, Section, Source};
pub use sheet::{Anchor, Color, Entity, Group, Sheet, Style};
pub use solid::Solid;
pub use table::{Column, Table, Values};
