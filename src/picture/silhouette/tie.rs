//! Points of the felt and what they hang on.

use super::rim;
use crate::outline::Point;

/// A point of the felt and what it hangs on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tie {
    /// Weighted nodes of a triangle.
    Inside([usize; 3], [f64; 3]),
    /// A stretch of rim.
    Rim(rim::Tie),
}

/// Twice the area of a triangle, positive where it turns to the left.
pub fn doubled_area(a: Point, b: Point, c: Point) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
