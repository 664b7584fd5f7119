//! An outline with all that is known of it.

use super::changes::Changes;
use super::drawing::{Drawing, Track};
use super::regions::Shapes;
use super::{Outline, Point};

/// Something that a file shows and that is no part of the outline.
#[derive(Clone, Debug, PartialEq)]
pub struct Aside {
    pub why: Why,
    /// Areas, each an outer polygon and its holes, in the coordinates of the outline.
    pub areas: Vec<Vec<Vec<Point>>>,
}

/// Why something is no part of the outline, or why it is though the file does not show it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Why {
    /// Paper, a card, a frame.
    Background,
    /// Hardly seen.
    Faint,
    /// Islands too small.
    Specks,
    /// Smaller pieces, left out as asked.
    Pieces,
    /// Holes that were filled: not shown, and part of the outline.
    Filled,
    /// Gaps that were closed: not shown, and part of the outline.
    Closed,
}

/// An outline and what was changed to get it.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    pub outline: Outline,
    pub changes: Changes,
    /// The silhouette's box where the file has it: lower left and upper right corner in the file's plain numbers or pixels, y up.
    pub drawn_box: [Point; 2],
    /// What the file shows besides.
    pub asides: Vec<Aside>,
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

/// What does not count, in the drawing's coordinates.
pub(super) struct Asides(pub Vec<Aside>);

impl Asides {
    pub fn add(&mut self, why: Why, areas: Shapes) {
        if !areas.is_empty() {
            self.0.push(Aside { why, areas });
        }
    }

    /// In the coordinates of the outline, whose box was `drawn_box` in the drawing.
    pub fn placed(self, outline: &Outline, drawn_box: [Point; 2]) -> Vec<Aside> {
        let (_, high) = outline.bounding_box();
        let scale = high[1] / (drawn_box[1][1] - drawn_box[0][1]);
        self.0
            .into_iter()
            .map(|Aside { why, areas }| Aside { why, areas: placed(areas, drawn_box[0], scale) })
            .collect()
    }
}

/// Scaled to mm, `low` at the origin.
pub(super) fn placed(mut shapes: Shapes, low: Point, scale: f64) -> Shapes {
    for p in shapes.iter_mut().flatten().flatten() {
        *p = [(p[0] - low[0]) * scale, (p[1] - low[1]) * scale];
    }
    shapes
}
