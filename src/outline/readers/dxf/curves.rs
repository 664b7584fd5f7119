//! Lines, arcs, ellipses and splines of a drawing, and their polygons.

use super::entity::Entity;
use super::place::{Place, Point3, cross, unit};
use super::through::Through;
use std::f64::consts::TAU;

/// Most pieces of one curve.
const MAX_PIECES: f64 = 20_000.0;
/// Most pieces between two points that a curve passes.
const MAX_FIT_PIECES: usize = 64;
/// Highest degree of a spline.
const MAX_DEGREE: usize = 12;

pub(super) enum Curve {
    /// Vertices with the bulge of the side that follows: the tangent of a quarter of the arc's angle.
    Polyline { vertices: Vec<(Point3, f64)>, closed: bool },
    /// `centre + cos(t) major + sin(t) minor` for `t` between two angles.
    Ellipse { centre: Point3, major: Point3, minor: Point3, from: f64, to: f64 },
    /// A rational B-spline.
    Spline { degree: usize, knots: Vec<f64>, points: Vec<Point3>, weights: Vec<f64>, closed: bool },
    /// A curve through points.
    Through { curve: Through, closed: bool },
}

impl Curve {
    /// The curve of an entity, if it has one that can bound an area, in coordinates of its own where [`Entity::is_flat`].
    pub fn of(entity: &Entity) -> Option<Self> {
        let plain = |points: Vec<Point3>, closed| {
            Some(Self::Polyline { vertices: points.into_iter().map(|p| (p, 0.0)).collect(), closed })
        };
        match entity.kind {
            "LINE" => plain(vec![entity.point(10), entity.point(11)], false),
            "LWPOLYLINE" => Some(Self::Polyline { vertices: light(entity), closed: entity.has_flag(1) }),
            // Meshes of faces.
            "POLYLINE" if entity.has_flag(16) || entity.has_flag(64) => None,
            "POLYLINE" => {
                // Flag 16 marks control points of a spline frame, which the curve does not pass.
                let on_curve = entity.vertices.iter().filter(|v| !v.has_flag(16));
                let vertices = on_curve.map(|v| (v.point(10), v.number(42).unwrap_or(0.0))).collect();
                Some(Self::Polyline { vertices, closed: entity.has_flag(1) })
            }
            // The corners of a solid are in the order of a Z.
            "SOLID" | "TRACE" => plain([10, 11, 13, 12].map(|code| entity.point(code)).to_vec(), true),
            "3DFACE" => plain([10, 11, 12, 13].map(|code| entity.point(code)).to_vec(), true),
            "CIRCLE" | "ARC" => {
                let r = entity.number(40)?;
                let angle = |code, default: f64| entity.number(code).unwrap_or(default).to_radians();
                let (from, to) = if entity.kind == "CIRCLE" { (0.0, TAU) } else { (angle(50, 0.0), angle(51, 360.0)) };
                Some(Self::arc(entity.point(10), r, from, to))
            }
            "ELLIPSE" => {
                let major = entity.point(11);
                let ratio = entity.number(40)?;
                let (from, to) = (entity.number(41).unwrap_or(0.0), entity.number(42).unwrap_or(TAU));
                // Both axes are the world's; which way round it goes is told by the normal.
                let minor = cross(unit(entity.normal())?, major).map(|v| ratio * v);
                Some(Self::Ellipse { centre: entity.point(10), major, minor, from, to: past(from, to) })
            }
            "SPLINE" => Self::spline(entity),
            _ => None,
        }
    }

    /// The faces of a polyline that is a mesh of them: vertices with flag 64 are corners, those with flag 128 alone name up to four of them,
    /// counted from 1, with a minus where a side is not seen.
    pub fn faces(entity: &Entity) -> Vec<Self> {
        let (corners, faces): (Vec<&Entity>, Vec<&Entity>) = entity.vertices.iter().partition(|v| v.has_flag(64));
        let at = |k: f64| corners.get((k.abs() as usize).checked_sub(1)?).map(|corner| (corner.point(10), 0.0));
        let face = |face: &Entity| {
            let vertices: Vec<(Point3, f64)> = (71..=74).filter_map(|code| face.number(code)).filter_map(at).collect();
            (vertices.len() >= 3).then_some(Self::Polyline { vertices, closed: true })
        };
        faces.into_iter().filter_map(face).collect()
    }

    /// An arc about z.
    pub fn arc(centre: Point3, r: f64, from: f64, to: f64) -> Self {
        Self::Ellipse { centre, major: [r, 0.0, 0.0], minor: [0.0, r, 0.0], from, to: past(from, to) }
    }

    fn spline(entity: &Entity) -> Option<Self> {
        let (points, knots) = (entity.points(10), entity.numbers(40));
        let degree = entity.number(71)? as usize;
        let closed = entity.has_flag(1);
        if let Some(spline) = Self::of_control_points(degree, knots, points, entity.numbers(41), closed) {
            return Some(spline);
        }
        // A spline may be given by the points it passes alone.
        let end = |code: i32| entity.number(code).map(|_| entity.point(code));
        Through::new(entity.points(11), closed, [end(12), end(13)]).map(|curve| Self::Through { curve, closed })
    }

    /// A rational B-spline; `None` where its numbers do not fit each other.
    pub fn of_control_points(
        degree: usize,
        knots: Vec<f64>,
        points: Vec<Point3>,
        mut weights: Vec<f64>,
        closed: bool,
    ) -> Option<Self> {
        let fits =
            (1..=MAX_DEGREE).contains(&degree) && points.len() > degree && knots.len() == points.len() + degree + 1;
        weights.resize(points.len(), 1.0);
        fits.then_some(Self::Spline { degree, knots, points, weights, closed })
    }

    /// Whether the curve is closed by definition; its ends may meet all the same.
    pub fn is_closed(&self) -> bool {
        match self {
            Self::Polyline { closed, .. } | Self::Spline { closed, .. } | Self::Through { closed, .. } => *closed,
            Self::Ellipse { from, to, .. } => to - from > TAU - 1e-9,
        }
    }

    /// Points whose hull holds the curve, more or less.
    pub fn hull(&self) -> Vec<Point3> {
        match self {
            Self::Polyline { vertices, .. } => vertices.iter().map(|v| v.0).collect(),
            Self::Spline { points, .. } => points.clone(),
            Self::Through { curve, .. } => curve.points.clone(),
            Self::Ellipse { centre: c, major: a, minor: b, .. } => [-1.0, 1.0]
                .into_iter()
                .flat_map(|s| [a, b].map(|axis| std::array::from_fn(|i| c[i] + s * axis[i])))
                .collect(),
        }
    }

    /// The curve as a polygon in the drawing, within `tolerance`.
    pub fn flat(&self, place: &Place, tolerance: f64) -> Vec<Point3> {
        let mut line: Vec<Point3> = match self {
            Self::Polyline { vertices, closed } => {
                let mut line = Vec::new();
                for (k, &(p, bulge)) in vertices.iter().enumerate() {
                    line.push(p);
                    let next = vertices.get(k + 1).or(if *closed { vertices.first() } else { None });
                    if let Some(&(q, _)) = next.filter(|_| bulge != 0.0) {
                        bulged(p, q, bulge, place.scale(), tolerance, &mut line);
                    }
                }
                line
            }
            Self::Ellipse { centre, major, minor, from, to } => {
                let length = |v: &Point3| v.iter().map(|c| c * c).sum::<f64>().sqrt();
                let r = length(major).max(length(minor)) * place.scale();
                let n = pieces(to - from, r, tolerance);
                let at = |t: f64| {
                    let (sin, cos) = t.sin_cos();
                    std::array::from_fn(|axis| centre[axis] + cos * major[axis] + sin * minor[axis])
                };
                (0..=n).map(|i| at(from + (to - from) * i as f64 / n as f64)).collect()
            }
            Self::Spline { degree, knots, points, weights, .. } => {
                let (from, to) = (knots[*degree], knots[points.len()]);
                let spans = points.len() - degree;
                // Each span turns by about a right angle at most: as fine as a circle through its control points.
                let size = extent(points) * place.scale();
                let n = (spans * pieces(0.25 * TAU, size, tolerance).max(2)).min(MAX_PIECES as usize);
                let at = |i: usize| de_boor(*degree, knots, points, weights, from + (to - from) * i as f64 / n as f64);
                (0..=n).map(at).collect()
            }
            Self::Through { curve, .. } => {
                let mut line = curve.points[..1].to_vec();
                for k in 0..curve.points.len() - 1 {
                    let h = curve.parameters[k + 1] - curve.parameters[k];
                    // As fine as a circle of the size of the piece.
                    let n = pieces(0.25 * TAU, h * place.scale(), tolerance).clamp(2, MAX_FIT_PIECES);
                    line.extend((1..=n).map(|i| curve.at(k, i as f64 / n as f64)));
                }
                line
            }
        };
        for p in &mut line {
            *p = place.at(*p);
        }
        line.retain(|p| p.iter().all(|v| v.is_finite()));
        line
    }
}

/// The vertices of a light polyline: a bulge belongs to the vertex before it.
fn light(entity: &Entity) -> Vec<(Point3, f64)> {
    let elevation = entity.number(38).unwrap_or(0.0);
    let mut vertices: Vec<(Point3, f64)> = Vec::new();
    for &(code, value) in &entity.tags {
        let Some(value) = value.parse().ok().filter(|v: &f64| v.is_finite()) else { continue };
        match (code, vertices.last_mut()) {
            (10, _) => vertices.push(([value, 0.0, elevation], 0.0)),
            (20, Some(last)) => last.0[1] = value,
            (42, Some(last)) => last.1 = value,
            _ => {}
        }
    }
    vertices
}

/// `to`, whole turns on, so that it lies up to one turn past `from`.
fn past(from: f64, to: f64) -> f64 {
    let turn = (to - from).rem_euclid(TAU);
    from + if turn < 1e-9 { TAU } else { turn }
}

/// Number of chords of an arc: each leaves it by `r (1 - cos(angle / 2))`.
fn pieces(angle: f64, r: f64, tolerance: f64) -> usize {
    let step = 2.0 * (1.0 - (tolerance / r).min(1.0)).acos();
    let n = (angle.abs() / step.max(1e-6)).ceil();
    if n.is_finite() { n.clamp(1.0, MAX_PIECES) as usize } else { 1 }
}

/// The inner points of the arc from `p` to `q` with a bulge: the tangent of a quarter of its angle, positive to the left
/// of the way.
pub(super) fn bulged(p: Point3, q: Point3, bulge: f64, scale: f64, tolerance: f64, line: &mut Vec<Point3>) {
    let angle = 4.0 * bulge.atan();
    let half = [0.5 * (q[0] - p[0]), 0.5 * (q[1] - p[1])];
    // From the middle of the chord to the centre: half the chord over the tangent of half the angle, to the left.
    let away = 1.0 / (0.5 * angle).tan();
    let centre = [p[0] + half[0] - away * half[1], p[1] + half[1] + away * half[0]];
    let arm = [p[0] - centre[0], p[1] - centre[1]];
    let n = pieces(angle, arm[0].hypot(arm[1]) * scale, tolerance);
    for i in 1..n {
        let (sin, cos) = (angle * i as f64 / n as f64).sin_cos();
        line.push([centre[0] + cos * arm[0] - sin * arm[1], centre[1] + sin * arm[0] + cos * arm[1], p[2]]);
    }
}

fn extent(points: &[Point3]) -> f64 {
    let along = |axis: usize| {
        let (low, high) =
            points.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p[axis]), h.max(p[axis])));
        high - low
    };
    (0..3).map(along).fold(0.0, f64::max)
}

/// A point of a rational B-spline by de Boor's algorithm in homogeneous coordinates.
fn de_boor(degree: usize, knots: &[f64], points: &[Point3], weights: &[f64], t: f64) -> Point3 {
    let last = points.len() - 1;
    let k = (degree..=last).rev().find(|&k| knots[k] <= t && knots[k] < knots[k + 1]).unwrap_or(degree);
    let mut d: Vec<[f64; 4]> = (0..=degree)
        .map(|j| {
            let (p, w) = (points[j + k - degree], weights[j + k - degree]);
            [p[0] * w, p[1] * w, p[2] * w, w]
        })
        .collect();
    for r in 1..=degree {
        for j in (r..=degree).rev() {
            let (low, high) = (knots[j + k - degree], knots[j + 1 + k - r]);
            let a = if high > low { (t - low) / (high - low) } else { 0.0 };
            d[j] = [0, 1, 2, 3].map(|axis| (1.0 - a) * d[j - 1][axis] + a * d[j][axis]);
        }
    }
    let [x, y, z, w] = d[degree];
    [x / w, y / w, z / w]
}
