//! A silhouette as polygons: reading, clean-up, measures.

mod clean;
pub mod polygon;
pub mod svg;

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
    #[error("not a readable SVG: {0}")]
    NotSvg(String),
    #[error("nothing is painted in the SVG (text must be converted to paths; pictures do not count)")]
    NothingPainted,
    #[error("the SVG uses {0}, which an outline cannot follow; expand it to plain paths")]
    Unsupported(&'static str),
    #[error("the silhouette falls into {pieces} pieces; a plushie is made of one, so join them or delete the others")]
    Pieces { pieces: usize },
    #[error("the silhouette touches itself in a single point near ({x:.1}, {y:.1}) mm; widen or open it there")]
    Pinched { x: f64, y: f64 },
    #[error("the silhouette is degenerate: it covers no area worth the name")]
    Degenerate,
    #[error("the height must be a positive length, not {0} mm")]
    Height(f64),
}

impl Outline {
    /// Outer polygon and holes, in this order.
    pub fn polygons(&self) -> impl Iterator<Item = &[Point]> {
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

    /// Distance from `p` to the nearest boundary, mm, without a sign.
    pub fn distance(&self, p: Point) -> f64 {
        self.polygons().map(|ring| polygon::distance(ring, p)).fold(f64::INFINITY, f64::min)
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
