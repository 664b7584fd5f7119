//! The drawing of the outline while it is changed.

use crate::design::Design;
use crate::outline::drawing::{Item, Primitive};
use crate::outline::{Drawing, Outline};
use crate::studio::canvas::Camera;

/// The tool that an empty sheet begins with.
pub const FREEHAND: &str = "tool.freehand";

#[derive(Default)]
pub struct Sketching {
    pub open: bool,
    pub cut: bool,
    /// The item that is picked out, and which point of a path or track.
    pub item: Option<Item>,
    pub point: Option<usize>,
    /// Something is being drawn that is not in the drawing yet.
    pub waits: bool,
    /// There is no body yet worth looking at.
    pub fresh: bool,
    /// `None`: fits the drawing.
    pub camera: Option<Camera>,
    /// A drawing of the outline that has none of its own.
    traced: Option<(Outline, Drawing)>,
}

impl Sketching {
    /// The drawing of the outline: the document's, or one traced from its outline.
    pub fn drawing<'a>(&'a self, design: &'a Design) -> &'a Drawing {
        static NOTHING: Drawing = Drawing { parts: Vec::new(), tracks: Vec::new() };
        let traced = self.traced.as_ref().map(|(_, drawing)| drawing);
        design.drawing.as_ref().or(traced).unwrap_or(&NOTHING)
    }

    /// Nothing may point beyond the drawing, and there is one while it is open.
    pub(crate) fn clamp(&mut self, design: &Design) {
        if !self.open {
            return;
        }
        let stale = self.traced.as_ref().is_none_or(|(outline, _)| *outline != design.outline);
        if design.drawing.is_none() && stale {
            self.traced = Some((design.outline.clone(), Drawing::of(&design.outline)));
        }
        let drawing = self.drawing(design);
        let item = self.item.filter(|&item| drawing.has(item));
        let points = match item {
            Some(Item::Part(part)) => match &drawing.parts[part].primitive {
                Primitive::Path { points } => points.len(),
                _ => 0,
            },
            Some(Item::Track(track)) => drawing.tracks[track].len(),
            None => 0,
        };
        self.point = self.point.filter(|&point| point < points);
        self.item = item;
    }
}
