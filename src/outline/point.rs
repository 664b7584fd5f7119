//! A place in the plane.

/// A point or vector in the plane, mm, y up.
pub type Point = [f64; 2];
