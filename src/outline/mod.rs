//! A silhouette as polygons: reading, clean-up, measures.

use serde::{Deserialize, Serialize};

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
