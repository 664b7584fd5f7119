//! A silhouette as polygons: reading, clean-up, measures.
//!
//! A reader turns a file into painted areas (SVG, PNG and JPEG, DXF, OBJ, drawings); the clean-up makes one outline of them and says what it
//! changed. [`import`] does both.

mod changes;
mod clean;
pub mod drawing;
mod dxf;
mod grid;
mod import;
mod layers;
mod note;
mod obj;
mod picture;
pub mod polygon;
mod regions;
mod simplify;
mod smooth;
pub mod svg;
mod texture;
mod thin;
mod trace;

pub use changes::{Change, Changes, What};
pub use drawing::Drawing;
pub use import::{
    Background, EXTENSIONS, Format, Holes, Import, Imported, MAX_FILE_BYTES, Pieces, import, import_file, read_file,
};
pub use note::Note;
pub use texture::{MAX_TEXTURE_PX, read_texture, shrunk, texture};

use grid::Grid;
use regions::Shapes;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A point or vector in the plane, mm, y up.
pub type Point = [f64; 2];

/// One connected silhouette: an outer polygon and its holes, mm.
///
/// Polygons are closed implicitly (the first point is not repeated), simple, the outer one counter-clockwise, holes
/// clockwise.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Outline {
    pub outer: Vec<Point>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub holes: Vec<Vec<Point>>,
}

/// Why a file gave no outline.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum OutlineError {
    #[error("{0}")]
    Unopened(String),
    #[error("neither an SVG, PNG, JPEG, DXF, OBJ nor drawing file")]
    UnknownFormat,
    #[error("not a readable {format}: {reason}")]
    Unreadable { format: &'static str, reason: String },
    #[error("the file is larger than {max} MB, the most that is read for an outline", max = MAX_FILE_BYTES >> 20)]
    TooLarge,
    #[error("the drawing {0}, too much for an outline; simplify it")]
    TooComplex(&'static str),
    #[error("nothing is painted: {0}")]
    NothingPainted(&'static str),
    #[error("there is no layer \"{name}\"; the drawing has: {layers}")]
    NoSuchLayer { name: String, layers: String },
    #[error("{0} have no layers to choose from; SVG and DXF drawings have")]
    NoLayers(&'static str),
    #[error("{0} has no colours to make a texture of; an SVG, PNG or JPEG has")]
    NoTexture(&'static str),
    #[error("the text \"{0}\" has characters that the bundled font lacks; convert it to paths")]
    NoFont(String),
    #[error("the silhouette is in {pieces} separate pieces, the largest with {largest:.0} % of the area")]
    Pieces { pieces: usize, largest: f64 },
    #[error("the silhouette touches itself in a single point near ({x:.1}, {y:.1}) mm; widen or open it there")]
    Pinched { x: f64, y: f64 },
    #[error("the silhouette is degenerate: it covers no area worth the name")]
    Degenerate,
    #[error("{what} must be a length of at least 0 mm, not {value}")]
    Length { what: &'static str, value: f64 },
    #[error("the height must be between 0.01 and 1000000 mm, not {0} mm")]
    Height(f64),
    #[error("the silhouette would measure {0:e} mm")]
    Size(f64),
}

/// What a reader found in a file: areas that may overlap, y up, and what it has to say about them.
struct Painting {
    shapes: Shapes,
    /// Millimetres in a unit of the shapes.
    unit_mm: f64,
    notes: Vec<Note>,
}

impl Outline {
    /// Outer polygon and holes, in this order.
    pub fn polygons(&self) -> impl Iterator<Item = &[Point]> + Clone {
        std::iter::once(self.outer.as_slice()).chain(self.holes.iter().map(Vec::as_slice))
    }

    /// Area without the holes, mm^2.
    pub fn area(&self) -> f64 {
        self.polygons().map(polygon::signed_area).sum()
    }

    /// Length of all polygons, mm.
    pub fn perimeter(&self) -> f64 {
        self.polygons().map(polygon::perimeter).sum()
    }

    /// Lower left and upper right corner of the box, mm.
    pub fn bounding_box(&self) -> (Point, Point) {
        polygon::bounding_box(&self.outer)
    }

    /// Whether `p` is inside the silhouette (not in a hole). Points on the boundary may fall either way.
    pub fn contains(&self, p: Point) -> bool {
        self.polygons().filter(|ring| polygon::contains(ring, p)).count() % 2 == 1
    }

    /// The boundary in cells, for many questions of distance.
    pub fn near(&self) -> Near {
        Near { grid: Grid::new(self.polygons()) }
    }

    /// How many parts and gaps are narrower than `width`: limbs, necks and whiskers of the body, slits and notches into
    /// it. Corners do not count.
    pub fn narrow_parts(&self, width: f64) -> usize {
        thin::narrow_parts(&vec![self.polygons().map(Vec::from).collect()], width)
    }

    /// Distance from `p` to the nearest boundary, mm, without a sign.
    pub fn distance(&self, p: Point) -> f64 {
        self.polygons().map(|ring| polygon::distance(ring, p)).fold(f64::INFINITY, f64::min)
    }
}

/// The boundary of an outline, prepared for many questions of distance.
pub struct Near {
    grid: Grid,
}

impl Near {
    /// Distance from `p` to the nearest boundary, mm, without a sign.
    pub fn distance(&self, p: Point) -> f64 {
        self.grid.distance(p)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_annulus_of_squares_has_its_closed_form_measures() {
        let outline = Outline {
            outer: vec![[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]],
            holes: vec![vec![[4.0, 4.0], [4.0, 6.0], [6.0, 6.0], [6.0, 4.0]]],
        };
        assert_eq!(outline.area(), 96.0);
        assert_eq!(outline.perimeter(), 48.0);
        assert_eq!(outline.bounding_box(), ([0.0, 0.0], [10.0, 10.0]));
        assert!(outline.contains([1.0, 1.0]) && !outline.contains([5.0, 5.0]) && !outline.contains([11.0, 5.0]));
        assert_eq!(outline.distance([5.0, 5.0]), 1.0);
        assert_eq!(outline.distance([13.0, 14.0]), 5.0);
    }
}
