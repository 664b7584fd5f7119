//! A silhouette as polygons: reading, clean-up, measures.
//!
//! | file | holds |
//! | --- | --- |
//! | `readers/` | files to painted areas: SVG, PDF, pictures, DXF, flat meshes, drawings; one reader a file, and the table of them |
//! | `options`, `notes`, `error` | how to read, what there is to say about it, why it failed |
//! | `clean` | painted areas to one outline, and what was changed |
//! | `even`, `gaps`, `islands`, `lines`, `basins` | noise, parts that all but touch or lie in each other, figures drawn in lines |
//! | `import` | from the bytes of a file to one clean outline |
//! | `texture` | what a file shows within the silhouette's box |
//! | `drawing/` | outlines drawn by hand |
//! | `silhouette`, `polygon`, `regions`, ... | geometry |

mod basins;
mod changes;
mod clean;
pub mod drawing;
mod error;
mod even;
mod gaps;
mod grid;
mod import;
mod imported;
mod islands;
mod lines;
mod notes;
mod options;
mod point;
pub mod polygon;
pub mod readers;
mod regions;
mod resample;
mod silhouette;
mod simplify;
mod smooth;
mod texture;
mod thin;
mod trace;

pub use changes::{Change, Changes, What};
pub use drawing::Drawing;
pub use error::OutlineError;
pub use import::{import, import_file, read_file};
pub use imported::{Aside, Imported, Why};
pub use notes::{Ground, Note, Remedy, Sizing};
pub use options::{Background, Holes, Import, MAX_FILE_BYTES, Pieces};
pub use point::Point;
pub use readers::{extensions, svg};
pub use resample::{MAX_TEXTURE_PX, shrunk};
pub use silhouette::{Near, Outline};
pub use texture::{read_texture, texture};
