//! The shapes that a drawing is made of, and the handles by which a hand changes them.

use crate::outline::{Point, polygon};
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// Chords of a full circle: they stray from it by 3e-4 of its radius.
const CHORDS: usize = 128;
/// Chords of a curved segment of a path.
const CURVE_CHORDS: usize = 12;

/// A shape, mm, y up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Primitive {
    Circle {
        center: Point,
        radius: f64,
    },
    /// The hull of two circles: a limb. Where one holds the other, that one alone.
    Capsule {
        ends: [Point; 2],
        radii: [f64; 2],
    },
    /// A closed line through points: curved, a centripetal Catmull-Rom spline, but for its corners. Between two corners it
    /// is straight.
    Path {
        points: Vec<PathPoint>,
    },
}

/// A point that a path goes through.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PathPoint {
    pub at: Point,
    #[serde(default, skip_serializing_if = "is_false")]
    pub corner: bool,
}

impl Primitive {
    /// Its name in lists.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Circle { .. } => "Circle",
            Self::Capsule { .. } => "Capsule",
            Self::Path { points } if points.iter().all(|p| p.corner) => "Polygon",
            Self::Path { .. } => "Curve",
        }
    }

    pub(super) fn check(&self, most: f64) -> Result<(), (String, &'static str)> {
        let place = |at: &str, p: &Point| match p.iter().all(|v| v.abs() <= most) {
            true => Ok(()),
            false => Err((at.to_owned(), "a coordinate must lie between -1e7 and 1e7 mm")),
        };
        let length = |at: &str, r: f64| match r > 0.0 && r <= most {
            true => Ok(()),
            false => Err((at.to_owned(), "a radius must be above 0, and at most 1e7 mm")),
        };
        match self {
            Self::Circle { center, radius } => place("center", center).and(length("radius", *radius)),
            Self::Capsule { ends, radii } => (0..2).try_for_each(|k| {
                place(&format!("ends[{k}]"), &ends[k])?;
                length(&format!("radii[{k}]"), radii[k])
            }),
            Self::Path { points } if points.len() < 3 => Err(("points".into(), "a path needs at least three points")),
            Self::Path { points } => {
                points.iter().enumerate().try_for_each(|(k, p)| place(&format!("points[{k}].at"), &p.at))
            }
        }
    }

    /// The shape as a polygon, counter-clockwise; a path that crosses itself may come in any sense.
    pub fn polygon(&self) -> Vec<Point> {
        match self {
            Self::Circle { center, radius } => arc(*center, *radius, 0.0, TAU, CHORDS),
            Self::Capsule { ends: [a, b], radii: [r, s] } => capsule([*a, *b], [*r, *s]),
            Self::Path { points } => {
                let mut ring: Vec<Point> = (0..points.len()).flat_map(|i| segment(points, i)).collect();
                if polygon::signed_area(&ring) < 0.0 {
                    ring.reverse();
                }
                ring
            }
        }
    }

    pub fn contains(&self, p: Point) -> bool {
        polygon::contains(&self.polygon(), p)
    }

    /// Moved by a vector.
    pub fn moved(&self, by: Point) -> Self {
        let to = |p: Point| [p[0] + by[0], p[1] + by[1]];
        match self {
            Self::Circle { center, radius } => Self::Circle { center: to(*center), radius: *radius },
            Self::Capsule { ends, radii } => Self::Capsule { ends: ends.map(to), radii: *radii },
            Self::Path { points } => {
                Self::Path { points: points.iter().map(|p| PathPoint { at: to(p.at), ..*p }).collect() }
            }
        }
    }

    /// Scaled about the origin.
    pub(super) fn scaled(&self, factor: f64) -> Self {
        let to = |p: Point| p.map(|v| v * factor);
        match self {
            Self::Circle { center, radius } => Self::Circle { center: to(*center), radius: radius * factor },
            Self::Capsule { ends, radii } => Self::Capsule { ends: ends.map(to), radii: radii.map(|r| r * factor) },
            Self::Path { points } => {
                Self::Path { points: points.iter().map(|p| PathPoint { at: to(p.at), ..*p }).collect() }
            }
        }
    }

    /// Where a hand can take hold of it: the centre and a point of a circle; the ends of a capsule and a point beside each;
    /// the points of a path.
    pub fn handles(&self) -> Vec<Point> {
        match self {
            Self::Circle { center, radius } => vec![*center, [center[0] + radius, center[1]]],
            Self::Capsule { ends, radii } => {
                let side = side(*ends);
                let rim = |k: usize| [ends[k][0] + radii[k] * side[0], ends[k][1] + radii[k] * side[1]];
                vec![ends[0], ends[1], rim(0), rim(1)]
            }
            Self::Path { points } => points.iter().map(|p| p.at).collect(),
        }
    }

    /// With one of its handles pulled to a place. Nothing gets smaller than `least`, mm.
    #[must_use]
    pub fn pulled(&self, handle: usize, to: Point, least: f64) -> Self {
        let mut pulled = self.clone();
        match &mut pulled {
            Self::Circle { center, .. } if handle == 0 => *center = to,
            Self::Circle { center, radius } => *radius = polygon::length(*center, to).max(least),
            Self::Capsule { ends, radii } => match handle {
                0 | 1 => ends[handle] = to,
                _ => radii[handle.min(3) - 2] = polygon::length(ends[handle.min(3) - 2], to).max(least),
            },
            Self::Path { points } => {
                if let Some(point) = points.get_mut(handle) {
                    point.at = to;
                }
            }
        }
        pulled
    }

    /// The middle of each segment of a path, where a point can be put in; none for other shapes.
    pub fn middles(&self) -> Vec<Point> {
        let Self::Path { points } = self else { return Vec::new() };
        let middle = |i: usize| {
            let chords = segment(points, i);
            match chords.get(CURVE_CHORDS / 2) {
                Some(&p) => p,
                None => polygon::lerp(points[i].at, points[(i + 1) % points.len()].at, 0.5),
            }
        };
        (0..points.len()).map(middle).collect()
    }

    /// With a point put into a path after the one numbered `after`: a corner between corners.
    #[must_use]
    pub fn with_point(&self, after: usize, at: Point) -> Self {
        let mut with = self.clone();
        if let Self::Path { points } = &mut with
            && after < points.len()
        {
            let corner = points[after].corner && points[(after + 1) % points.len()].corner;
            points.insert(after + 1, PathPoint { at, corner });
        }
        with
    }

    /// Without one of the points of a path; `None` where it has only three.
    pub fn without_point(&self, index: usize) -> Option<Self> {
        let Self::Path { points } = self else { return None };
        if points.len() <= 3 || index >= points.len() {
            return None;
        }
        let mut points = points.clone();
        points.remove(index);
        Some(Self::Path { points })
    }

    /// With a point of a path made a corner, or round.
    #[must_use]
    pub fn with_corner(&self, index: usize, corner: bool) -> Self {
        let mut with = self.clone();
        if let Self::Path { points } = &mut with
            && let Some(point) = points.get_mut(index)
        {
            point.corner = corner;
        }
        with
    }
}

/// `chords` points from angle `from` on, rad, the last one excluded.
fn arc(center: Point, radius: f64, from: f64, by: f64, chords: usize) -> Vec<Point> {
    let at = |i: usize| {
        let (sin, cos) = (from + by * i as f64 / chords as f64).sin_cos();
        [center[0] + radius * cos, center[1] + radius * sin]
    };
    (0..chords).map(at).collect()
}

/// The unit normal to the left of the way from one end to the other; up for a way of no length.
fn side([a, b]: [Point; 2]) -> Point {
    let length = polygon::length(a, b);
    if length > 0.0 { [(a[1] - b[1]) / length, (b[0] - a[0]) / length] } else { [0.0, 1.0] }
}

fn capsule([a, b]: [Point; 2], [r, s]: [f64; 2]) -> Vec<Point> {
    let length = polygon::length(a, b);
    if length <= (r - s).abs() {
        let (center, radius) = if r >= s { (a, r) } else { (b, s) };
        return arc(center, radius, 0.0, TAU, CHORDS);
    }
    // The common tangents touch both circles under this angle from the way from a to b.
    let way = (b[1] - a[1]).atan2(b[0] - a[0]);
    let tangent = ((r - s) / length).acos();
    let part = |by: f64| ((CHORDS as f64 * by / TAU).ceil() as usize).max(2);
    let (back, front) = (TAU - 2.0 * tangent, 2.0 * tangent);
    let mut ring = arc(a, r, way + tangent, back, part(back));
    ring.extend(arc(a, r, way + tangent + back, PI, 1));
    ring.extend(arc(b, s, way - tangent, front, part(front)));
    ring.extend(arc(b, s, way + tangent, PI, 1));
    ring
}

/// The line of a path from point `i` on, the next one excluded.
///
/// Control points of the centripetal spline: with `d = sqrt |b - a|` of three neighbouring chords,
/// `c = (d0^2 p2 - d1^2 p0 + (2 d0^2 + 3 d0 d1 + d1^2) p1) / (3 d0 (d0 + d1))`. At a corner it is a third of the way.
pub(super) fn segment(points: &[PathPoint], i: usize) -> Vec<Point> {
    let n = points.len();
    let [before, from, to, after] = [i + n - 1, i, i + 1, i + 2].map(|k| points[k % n]);
    if from.corner && to.corner {
        return vec![from.at];
    }
    let control = |outer: Point, p: PathPoint, inner: Point| {
        let (d0, d1) = (polygon::length(outer, p.at).sqrt(), polygon::length(p.at, inner).sqrt());
        let bottom = 3.0 * d0 * (d0 + d1);
        if p.corner || bottom <= 0.0 {
            return polygon::lerp(p.at, inner, 1.0 / 3.0);
        }
        let weight = 2.0 * d0 * d0 + 3.0 * d0 * d1 + d1 * d1;
        [0, 1].map(|k| (d0 * d0 * inner[k] - d1 * d1 * outer[k] + weight * p.at[k]) / bottom)
    };
    let (c, d) = (control(before.at, from, to.at), control(after.at, to, from.at));
    let at = |k: usize| {
        let t = k as f64 / CURVE_CHORDS as f64;
        let u = 1.0 - t;
        let [w0, w1, w2, w3] = [u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t];
        [0, 1].map(|k| w0 * from.at[k] + w1 * c[k] + w2 * d[k] + w3 * to.at[k])
    };
    (0..CURVE_CHORDS).map(at).collect()
}

pub(super) fn is_false(value: &bool) -> bool {
    !value
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(primitive: &Primitive) -> f64 {
        polygon::signed_area(&primitive.polygon())
    }

    #[test]
    fn circles_and_capsules_have_their_areas() {
        let circle = Primitive::Circle { center: [3.0, -4.0], radius: 10.0 };
        assert!((area(&circle) / (100.0 * PI) - 1.0).abs() < 5e-4);
        let straight = Primitive::Capsule { ends: [[0.0, 0.0], [30.0, 40.0]], radii: [10.0, 10.0] };
        assert!((area(&straight) / (1000.0 + 100.0 * PI) - 1.0).abs() < 5e-4);
        // Two circles of radii r and s and their tangents: sectors and two trapezoids.
        let (r, s, l) = (20.0, 8.0, 60.0_f64);
        let tapered = Primitive::Capsule { ends: [[5.0, 5.0], [5.0, 5.0 + l]], radii: [r, s] };
        let t = ((r - s) / l).acos();
        let expected = r * r * (PI - t) + s * s * t + (r + s) * (l * l - (r - s) * (r - s)).sqrt();
        assert!((area(&tapered) / expected - 1.0).abs() < 1e-3, "{} {expected}", area(&tapered));
        for p in tapered.polygon() {
            let d = [polygon::length(p, [5.0, 5.0]) - r, polygon::length(p, [5.0, 5.0 + l]) - s];
            assert!(d[0].abs().min(d[1].abs()) < 1e-9);
        }
        let held = Primitive::Capsule { ends: [[0.0, 0.0], [5.0, 0.0]], radii: [2.0, 10.0] };
        assert!((area(&held) / (100.0 * PI) - 1.0).abs() < 5e-4);
    }

    #[test]
    fn a_path_goes_through_its_points_and_keeps_its_corners() {
        let points = [[0.0, 0.0], [50.0, 0.0], [60.0, 30.0], [20.0, 50.0]];
        let path = |corner| Primitive::Path { points: points.map(|at| PathPoint { at, corner }).to_vec() };
        assert_eq!(path(true).polygon(), points);
        let round = path(false);
        for p in points {
            assert!(polygon::distance(&round.polygon(), p) < 1e-9);
        }
        assert!(area(&round) > area(&path(true)));
        // Around a regular polygon the curve is nearly the circle.
        let on_circle = |i: usize| {
            let (sin, cos) = (TAU * i as f64 / 12.0).sin_cos();
            PathPoint { at: [50.0 * cos, 50.0 * sin], corner: false }
        };
        let ring = Primitive::Path { points: (0..12).map(on_circle).collect() };
        for p in ring.polygon() {
            assert!((p[0].hypot(p[1]) - 50.0).abs() < 0.15);
        }
        // Clockwise points make the same shape; repeated ones do no harm.
        let mut reversed = points.to_vec();
        reversed.reverse();
        let reversed: Vec<PathPoint> = reversed.into_iter().map(|at| PathPoint { at, corner: false }).collect();
        assert!((area(&Primitive::Path { points: reversed }) - area(&round)).abs() < 1e-9);
        let twice = round.with_point(1, points[1]);
        assert!(twice.polygon().iter().flatten().all(|v| v.is_finite()));
    }

    #[test]
    fn handles_follow_the_hand() {
        let shapes = [
            Primitive::Circle { center: [1.0, 2.0], radius: 10.0 },
            Primitive::Capsule { ends: [[0.0, 0.0], [30.0, 5.0]], radii: [4.0, 6.0] },
            Primitive::Path {
                points: [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0]].map(|at| PathPoint { at, corner: true }).into(),
            },
        ];
        for shape in shapes {
            for (k, at) in shape.handles().into_iter().enumerate() {
                let same = shape.pulled(k, at, 0.1);
                for (a, b) in same.handles().into_iter().zip(shape.handles()) {
                    assert!(polygon::length(a, b) < 1e-9);
                }
            }
            let moved = shape.moved([3.0, 4.0]);
            assert!((polygon::length(moved.handles()[0], shape.handles()[0]) - 5.0).abs() < 1e-12);
        }
        let circle = Primitive::Circle { center: [0.0, 0.0], radius: 10.0 };
        assert_eq!(circle.pulled(1, [0.0, 7.0], 0.1), Primitive::Circle { center: [0.0, 0.0], radius: 7.0 });
        assert_eq!(circle.pulled(1, [0.0, 0.0], 0.1), Primitive::Circle { center: [0.0, 0.0], radius: 0.1 });
    }

    #[test]
    fn points_are_put_in_and_taken_out() {
        let corner = |at| PathPoint { at, corner: true };
        let path = Primitive::Path { points: [[0.0, 0.0], [9.0, 0.0], [9.0, 9.0]].map(corner).into() };
        assert_eq!(path.middles()[0], [4.5, 0.0]);
        let with = path.with_point(2, [4.0, 5.0]);
        assert_eq!(with.handles()[3], [4.0, 5.0]);
        assert_eq!(with.without_point(3), Some(path.clone()));
        assert_eq!(path.without_point(0), None);
        assert_eq!(with.with_corner(1, false).with_corner(1, true), with);
        assert_eq!((path.name(), with.with_corner(1, false).name()), ("Polygon", "Curve"));
    }
}
