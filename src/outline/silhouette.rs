//! One connected silhouette and its measures.

use super::grid::Grid;
use super::{Point, polygon, thin};
use serde::{Deserialize, Serialize};

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

    /// Whether there is any such part or gap.
    pub fn has_narrow_parts(&self, width: f64) -> bool {
        thin::has_narrow_parts(&vec![self.polygons().map(Vec::from).collect()], width)
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
