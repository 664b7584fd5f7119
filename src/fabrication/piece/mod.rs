//! Pieces of felt: where they are cut, sewn, marked and left open, before they are laid on sheets.
//!
//! Coordinates are those of the design, mm; a [`Piece`] is the front as it is seen from the front. The back is its mirror image.

mod access;
mod allowance;
mod clearance;
mod gap;
mod labels;
mod marks;
mod nest;
mod snip;

pub use access::Access;
pub use allowance::{Corners, Cutting, grown, with_kerf};
pub use clearance::{LEAST_FELT_MM, Passage, passages};
pub use gap::{Seam, Ways, seam_of};
pub use labels::Labels;
pub use marks::match_marks;
pub use nest::{Bed, Laid, nest};
pub use snip::{Closed, closed_notches};

use crate::design::Design;
use crate::outline::Point;

/// A piece of felt with all that is on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Rim (counter-clockwise) and what is cut out within it.
    pub rim: Vec<Point>,
    pub cut_outs: Vec<Vec<Point>>,
    pub seam: Seam,
    /// Seams around the body's own holes.
    pub inner_seams: Vec<Vec<Point>>,
    /// Where the allowances meet, and the line to snip along.
    pub closed: Vec<Closed>,
    /// Short lines across the allowance that meet those of the other piece.
    pub notches: Vec<[Point; 2]>,
    /// Places where cables or winches pass the felt.
    pub passages: Vec<Passage>,
    pub pins: Vec<Point>,
}

impl Piece {
    /// The front of a design's skin.
    pub fn front(design: &Design, corners: Corners) -> Self {
        let allowance_mm = design.fabrication.seam_allowance_mm;
        let mut shapes = grown(&design.outline, allowance_mm, corners);
        // The outline is one piece, and so is what is grown from it.
        let mut shape = if shapes.is_empty() { vec![design.outline.outer.clone()] } else { shapes.swap_remove(0) };
        let rim = shape.remove(0);
        let closed = closed_notches(&design.outline, &rim, &shape, allowance_mm);
        let seam = seam_of(design);
        let notches = match_marks(&design.outline, &rim, &seam, allowance_mm);
        let pins = design.pins.iter().map(|p| design.mesh.position(&p.at, &design.mesh.nodes)).collect();
        let passages = passages(design);
        Self { rim, cut_outs: shape, seam, inner_seams: design.outline.holes.clone(), closed, notches, passages, pins }
    }

    /// The piece as a cutter gets it that burns away so much, so that it comes out as it is here: the rim is moved outward by half of that, cut-outs,
    /// holes and openings inward. A hole that is no wider than what is burned away is marked, not cut.
    pub fn for_cutter(&self, kerf_mm: f64) -> Self {
        if kerf_mm <= 0.0 {
            return self.clone();
        }
        let mut piece = self.clone();
        let shape = std::iter::once(self.rim.clone()).chain(self.cut_outs.iter().cloned()).collect();
        let mut cut = with_kerf(vec![shape], kerf_mm).into_iter().flatten();
        (piece.rim, piece.cut_outs) = (cut.next().unwrap_or_default(), cut.collect());
        for passage in &mut piece.passages {
            if 2.0 * passage.radius_mm > kerf_mm {
                passage.radius_mm -= 0.5 * kerf_mm;
            } else {
                passage.is_cut = false;
            }
        }
        piece
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::testing;
    use crate::outline::polygon::bounding_box;

    #[test]
    fn a_cutter_gets_lines_that_leave_the_piece_as_it_is() {
        let piece = Piece::front(&testing::sample(), Corners::Mitred);
        let radii = |piece: &Piece| piece.passages.iter().map(|p| p.radius_mm).collect::<Vec<_>>();
        let cut = piece.for_cutter(0.4);
        let ((low, high), (cut_low, cut_high)) = (bounding_box(&piece.rim), bounding_box(&cut.rim));
        for axis in 0..2 {
            assert!((low[axis] - cut_low[axis] - 0.2).abs() < 1e-3 && (cut_high[axis] - high[axis] - 0.2).abs() < 1e-3);
        }
        assert!(!piece.passages.is_empty());
        for (own, cut) in radii(&piece).iter().zip(radii(&cut)) {
            assert!((own - cut - 0.2).abs() < 1e-12);
        }
        assert_eq!((cut.seam, cut.notches), (piece.seam.clone(), piece.notches.clone()));
        // What the kerf is as wide as is marked.
        let widest = 2.0 * radii(&piece).into_iter().fold(0.0, f64::max);
        assert!(piece.for_cutter(widest).passages.iter().all(|passage| !passage.is_cut));
        assert_eq!(piece.for_cutter(0.0), piece);
    }
}
