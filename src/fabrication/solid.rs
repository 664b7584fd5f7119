//! A solid in mm, to be printed.

/// A body by its surface: triangles counter-clockwise seen from outside, closed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Solid {
    /// mm.
    pub nodes: Vec<[f64; 3]>,
    pub triangles: Vec<[usize; 3]>,
}
