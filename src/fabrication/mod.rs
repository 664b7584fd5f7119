//! The blueprint of a design: what is cut, how cables run, and what the motors do.
//!
//! [`products`] are what is made: [`Sheet`]s in mm, [`Solid`]s, [`Table`]s, programs for motors, guides and pages to read. [`writers`] are how each
//! kind is written: SVG, DXF, PDF, HTML, CSV, text, STL, 3MF. Every product is written by every writer that knows its kind. [`blueprint`] makes the
//! files in memory, [`export`] puts them on the disk, all or none.
//!
//! | file | holds |
//! | --- | --- |
//! | `pattern.svg`, `.dxf` | front and mirrored back on sheets: `front-cut`, `front-stitch` and so on, `reference` |
//! | `pattern-print.pdf`, `-a4.pdf`, `-letter.pdf` | the same on paper |
//! | `stuffed.svg`, `.pdf` | the silhouette when the body is stuffed |
//! | `routing-front`, `routing-back`, `routing.csv`, `threading.csv` | holes and threads of each face; enough for cables pulled by hand |
//! | `winch-N-spool`, `winch-housing`, `winch-N`, `motors.csv` | solids, drawings, and which motors fit |
//! | `assembly.html`, `.pdf` | parts list and steps |
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
mod remark;
mod sheet;
mod solid;
pub mod stuffing;
mod table;
pub mod winch;
pub mod writers;

pub use crate::files::folder::{Listed as ManifestFile, MANIFEST};
pub use crate::files::sha256;
pub use blueprint::{File, Manifest, Watch, blueprint, blueprint_watched, export, export_watched};
pub use cables::{holes, tendon_length_mm};
pub use catalogue::{Catalogue, CatalogueError};
pub use demand::{Demand, demands, strong_enough};
pub use error::ExportError;
pub use options::{Options, Topic, Topics};
pub use preset::{Cutter, Preset, SheetSize};
pub use product::{Content, Part, Product, Section, Shared, Source};
pub use remark::Remark;
pub use sheet::{Anchor, Color, Entity, Group, Layer, Sheet, Style};
pub use solid::Solid;
pub use table::{Column, Table, Values};
