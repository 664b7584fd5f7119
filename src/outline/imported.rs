//! An outline with all that is known of it.

use super::changes::Changes;
use super::drawing::{Drawing, Track};
use super::{Outline, Point};

/// An outline and what was changed to get it.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    pub outline: Outline,
    pub changes: Changes,
    /// The silhouette's box where the file has it: lower left and upper right corner in the file's plain numbers or pixels, y up.
    pub drawn_box: [Point; 2],
    /// The triangles of a file that brings its own mesh, mm, counter-clockwise.
    pub mesh: Option<(Vec<Point>, Vec<[usize; 3]>)>,
    /// The parts that it was drawn from, in the coordinates of `outline`.
    pub drawing: Option<Drawing>,
}

impl Imported {
    /// Lines along which edges of its mesh shall run, in the coordinates of `outline`.
    pub fn tracks(&self) -> &[Track] {
        self.drawing.as_ref().map_or(&[], |drawing| &drawing.tracks)
    }
}
