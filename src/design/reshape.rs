//! Another silhouette for a design that is already posed and rigged.
//!
//! What lies on the old body is carried over to the new one by where it is at rest ([`remesh::carry`]). The origin of a design
//! is the lower left corner of its silhouette's box: where that corner moves, everything moves with it.

use super::remesh::{self, Report};
use super::{Design, FiberSet};
use crate::mesh::{Mesh, MeshError, MeshSpec};
use crate::outline::{Drawing, Imported, Outline, Point};

/// A body to be put in place of a design's own.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    pub outline: Outline,
    pub mesh: Mesh,
    pub fibers: FiberSet,
    /// The parts it was drawn from, in the coordinates of `outline`.
    pub drawing: Option<Drawing>,
    /// Where the origin of the new body lies in the old one, mm.
    pub corner: Point,
}

impl Body {
    /// The body of a silhouette, meshed along its own tracks. Its lower left corner is that of the design, unless `corner`
    /// says otherwise.
    ///
    /// # Errors
    /// [`MeshError`] where the outline has no such mesh.
    pub fn new(imported: Imported, spec: &MeshSpec, finer: usize, corner: Point) -> Result<Self, MeshError> {
        let spec = MeshSpec { tracks: imported.tracks().to_vec(), ..spec.clone() };
        let (mesh, fibers) = remesh::body(&imported.outline, &spec, finer)?;
        Ok(Self { outline: imported.outline, mesh, fibers, drawing: imported.drawing, corner })
    }
}

/// A silhouette that was not drawn keeps the tracks of the design, whose lower left corner it shares.
pub fn keep_tracks(design: &Design, imported: &mut Imported) {
    if imported.drawing.is_none() && !design.tracks().is_empty() {
        let drawing = Drawing::of(&imported.outline);
        imported.drawing = Some(Drawing { tracks: design.tracks().to_vec(), ..drawing });
    }
}

/// Gives the design another body. Pins, poses, networks and keyframes stay; activations are as they were.
pub fn reshape(design: &mut Design, body: Body) -> Report {
    let Body { outline, mesh, fibers, drawing, corner } = body;
    let shift = |p: &mut Point| {
        for axis in 0..2 {
            p[axis] -= corner[axis];
        }
    };
    design.mesh.nodes.iter_mut().for_each(shift);
    design.pins.iter_mut().filter_map(|pin| pin.position.as_mut()).for_each(shift);
    design.poses.iter_mut().flat_map(|pose| &mut pose.targets).for_each(|target| shift(&mut target.to));
    // The picture stays where it was, whatever box the new silhouette has.
    design.texture_box = design.texture.is_some().then(|| {
        let mut corners = design.texture_rect();
        corners.iter_mut().for_each(shift);
        corners
    });
    design.outline = outline;
    design.drawing = drawing;
    remesh::carry(design, mesh, fibers)
}

#[cfg(test)]
mod tests {
    use super::super::{Pin, Pose, Target, bundled};
    use super::*;
    use crate::outline::drawing::{Part, Primitive};
    use crate::outline::{Import, polygon};

    #[test]
    fn what_is_drawn_to_the_left_moves_the_origin_and_nothing_else() {
        let mut design = bundled::ALL[0].design().unwrap();
        design.texture = Some("robot.png".into());
        let before = design.clone();
        let mut drawing = Drawing::of(&design.outline);
        let [x, y] = [-30.0, 0.5 * design.body_length_mm()];
        // An arm that reaches out of the old box to the left.
        let arm = Primitive::Capsule { ends: [[x, y], [0.5 * design.body_length_mm(), y]], radii: [20.0, 20.0] };
        drawing.parts.push(Part::joined(arm));
        let at = design.mesh.locate_nearest([60.0, 20.0], &design.mesh.nodes).unwrap().0;
        design.pins.push(Pin { position: Some([5.0, 6.0]), ..Pin::at_rest(at, 20.0) });
        design.poses.push(Pose { name: "far".into(), targets: vec![Target { at, to: [7.0, 8.0], weight: 1.0 }] });
        let imported = drawing.import(&Import::default()).unwrap();
        let corner = imported.drawn_box[0];
        assert!((corner[0] + 50.0).abs() < 1e-3 && corner[1].abs() < 0.5, "{corner:?}");
        let body = Body::new(imported, &MeshSpec::fibers(500), 1, corner).unwrap();
        let report = reshape(&mut design, body);
        design.validate().unwrap();
        assert_eq!(design.fiber_routings().len(), report.fibers[1]);
        let (low, high) = design.outline.bounding_box();
        assert!(low.iter().all(|v| v.abs() < 1e-9));
        assert!((high[0] - before.outline.bounding_box().1[0] - 50.0).abs() < 0.01 * high[0]);
        assert_eq!(design.poses.last().unwrap().targets[0].to, [7.0 - corner[0], 8.0 - corner[1]]);
        assert_eq!(design.pins.last().unwrap().position, Some([5.0 - corner[0], 6.0 - corner[1]]));
        let moved = |p: Point| [p[0] - corner[0], p[1] - corner[1]];
        assert_eq!(design.texture_rect(), before.texture_rect().map(moved));
        for (new, old) in design.pins.iter().zip(&before.pins) {
            let [a, b] = [(&design.mesh, new), (&before.mesh, old)].map(|(m, pin)| m.position(&pin.at, &m.nodes));
            assert!(polygon::length(a, [b[0] - corner[0], b[1] - corner[1]]) < 0.01 * high[1], "{a:?} {b:?}");
        }
        // The drawing lies over the new outline.
        let again = design.drawing.as_ref().unwrap().import(&Import::default()).unwrap().drawn_box[0];
        assert!(again[0].abs() < 1e-6 && again[1].abs() < 1e-6, "{again:?}");
    }
}
