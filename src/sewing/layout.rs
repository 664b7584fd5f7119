//! What is judged: a body with its seam, winches and their cables.

use crate::outline::{Near, Outline, Point};

/// A winch and its cables, each from the winch to its end, mm.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rig {
    pub winch: Point,
    pub cables: Vec<Vec<Point>>,
}

/// The seam that rules measure to: the rim of the body, where the felt is sewn together.
pub struct Body<'a> {
    outline: &'a Outline,
    near: Near,
}

impl<'a> Body<'a> {
    /// Prepares a body for many judgements.
    pub fn new(outline: &'a Outline) -> Self {
        Self { outline, near: outline.near() }
    }

    /// Distance from a point to the seam, mm, negative outside of the body.
    pub fn depth(&self, p: Point) -> f64 {
        let distance = self.near.distance(p);
        if self.outline.contains(p) { distance } else { -distance }
    }

    /// Outer polygon and holes, mm.
    pub fn polygons(&self) -> impl Iterator<Item = &[Point]> + Clone {
        self.outline.polygons()
    }

    /// Lower left and upper right corner of the box around the body, mm.
    pub fn bounding_box(&self) -> (Point, Point) {
        self.outline.bounding_box()
    }
}
