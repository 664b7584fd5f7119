//! Pictures of plushies: what the window and the headless commands both show.
//!
//! A [`Subject`] says what a picture is of; its [`layers`] make a [`Scene`] of it, primitives in painting order with
//! coordinates in mm (y up). Line widths and disc radii are in logical pixels, so that they stay crisp at every zoom.
//! [`raster`] paints scenes without a graphics adapter.
//!
//! ```
//! use plushwright::design::Design;
//! use plushwright::engine::Shape;
//! use plushwright::mesh::Mesh;
//! use plushwright::outline::Outline;
//! use plushwright::picture::palette::{Palette, Theme};
//! use plushwright::picture::{Layers, Subject, raster};
//! use std::sync::Arc;
//!
//! let mesh = Mesh { nodes: vec![[0.0, 0.0], [90.0, 0.0], [0.0, 60.0]], triangles: vec![[0, 1, 2]] };
//! let outline = Outline { outer: mesh.nodes.clone(), holes: Vec::new() };
//! let rest = Arc::new(Shape { nodes: mesh.nodes.clone(), ..Shape::default() });
//! let design = Arc::new(Design::new("triangle", outline, mesh));
//! let subject = Subject { theme: Theme::Dark, ..Subject::new(&design, &rest) };
//! let scene = Layers::of(&subject).scene();
//! let png = raster::png(&scene, &scene, (320, 180), Palette::of(Theme::Dark).background)?;
//! assert!(plushwright::files::is_marked_png(&png));
//! # Ok::<(), raster::RasterError>(())
//! ```

mod color;
pub mod element_quality;
pub mod film;
pub mod layers;
mod letters;
mod pair;
pub mod palette;
mod pixels;
pub mod plush;
mod portrait;
pub mod preview;
pub mod ramp;
pub mod raster;
mod scene;
mod sheet;
pub mod silhouette;
mod texture;
mod textured;
mod weave;

pub use color::Color;
pub use layers::{LAYERS, LOOKS, Layers, Shown, Stage, Subject};
pub use pair::png;
pub use portrait::portrait;
pub use scene::{Item, Scene, Strands};
pub use sheet::sheet;
pub use silhouette::Silhouette;
pub use texture::{Level, Texture};
pub use weave::Weave;
