//! What of winches and tendons lies under the pointer, and where the body at rest is there.

use super::ground::{Canvas, Ground};
use crate::design::MaterialPoint;
use crate::operations::network::Part;
use crate::outline::{Point, polygon};

/// How near the pointer must be to a winch, a hole and a piece of cable, logical pixels.
const WINCH_REACH: f64 = 11.0;
const HOLE_REACH: f64 = 9.0;
const PIECE_REACH: f64 = 6.0;

impl Canvas<'_> {
    /// The winch, hole or piece of cable under a point of the view: the nearest, the most specific kind first.
    pub fn strung(&self, p: Point) -> Option<Part> {
        let mut found = [None; 3];
        let mut offer = |kind: usize, distance: f64, reach: f64, part: Part| {
            let nearer = found[kind].is_none_or(|(best, _)| distance < best);
            if distance <= reach * self.mm_per_pixel() && nearer {
                found[kind] = Some((distance, part));
            }
        };
        for (winch, network) in self.session.design().networks.iter().enumerate() {
            for (tendon, cable) in network.tendons.iter().enumerate() {
                let places: Vec<Point> = cable.routing.iter().filter_map(|point| self.shown(point)).collect();
                for (hole, &place) in places.iter().enumerate() {
                    let distance = polygon::length(p, place);
                    if hole == 0 {
                        offer(0, distance, WINCH_REACH, Part::Winch(winch));
                    } else {
                        offer(1, distance, HOLE_REACH, Part::Hole(winch, tendon, hole));
                    }
                }
                for (piece, ends) in places.windows(2).enumerate() {
                    let t = polygon::nearest_parameter(ends[0], ends[1], p);
                    let distance = polygon::length(p, polygon::lerp(ends[0], ends[1], t));
                    offer(2, distance, PIECE_REACH, Part::Piece(winch, tendon, piece));
                }
            }
        }
        // A hole near a winch is taken where it is the nearer one.
        let [winch, hole, piece] = found;
        let point = [winch, hole].into_iter().flatten().min_by(|a, b| a.0.total_cmp(&b.0));
        point.or(piece).map(|(_, part)| part)
    }

    /// The place of a point of the body in the shape that is shown.
    pub fn shown(&self, point: &MaterialPoint) -> Option<Point> {
        let Ground::Plushie(_, Some(shape)) = self.ground else { return None };
        (point.last_node() < shape.nodes.len()).then(|| point.place(&shape.nodes))
    }

    /// The place of a part in the shape that is shown; none of a tendon, the middle of a piece.
    pub fn shown_part(&self, part: Part) -> Option<Point> {
        let hole = |winch: usize, tendon: usize, hole: usize| {
            let network = self.session.design().networks.get(winch)?;
            self.shown(network.tendons.get(tendon)?.routing.get(hole)?)
        };
        match part {
            Part::Winch(winch) => hole(winch, 0, 0),
            Part::Tendon(..) => None,
            Part::Hole(w, t, h) => hole(w, t, h),
            Part::Piece(w, t, p) => Some(polygon::lerp(hole(w, t, p)?, hole(w, t, p + 1)?, 0.5)),
        }
    }

    /// The place at rest of the point of the body that is shown at `p`, or nearest to it, and how far from it, mm.
    pub fn at_rest(&self, p: Point) -> Option<(Point, f64)> {
        let Ground::Plushie(_, Some(shape)) = self.ground else { return None };
        let mesh = &self.session.design().mesh;
        if shape.nodes.len() != mesh.nodes.len() {
            return None;
        }
        let (at, miss) = mesh.locate_nearest(p, &shape.nodes)?;
        Some((mesh.position(&at, &mesh.nodes), miss))
    }
}
