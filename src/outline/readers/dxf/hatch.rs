//! The areas that a hatch fills, by the paths around them.

use super::curves::Curve;
use super::entity::Entity;
use super::place::Point3;
use std::f64::consts::TAU;

/// Most paths of one hatch, and curves of a path.
const MAX_PARTS: usize = 100_000;

/// The curves around a hatch, path by path: one closed polyline, or edges that meet.
pub(super) fn boundary(entity: &Entity) -> Vec<Curve> {
    let tags = &entity.tags;
    let Some(start) = tags.iter().position(|tag| tag.0 == 91) else { return Vec::new() };
    let mut reader = Reader { tags: &tags[start + 1..] };
    let paths = entity.number(91).map_or(0, |n| n.clamp(0.0, MAX_PARTS as f64) as usize);
    let mut curves = Vec::new();
    for _ in 0..paths {
        let Some(kind) = reader.seek(92) else { break };
        // Bit 2: a polyline; bit 8: the box around a text.
        let (kind, is_text) = (kind as i64, kind as i64 & 8 != 0);
        let from = curves.len();
        let read = if kind & 2 != 0 { reader.polyline(&mut curves) } else { reader.edges(&mut curves) };
        if is_text {
            curves.truncate(from);
        }
        if read.is_none() || curves.len() > MAX_PARTS {
            break;
        }
    }
    curves
}

struct Reader<'a> {
    tags: &'a [(i32, &'a str)],
}

impl Reader<'_> {
    /// The number of the next tag with a code.
    fn seek(&mut self, code: i32) -> Option<f64> {
        let at = self.tags.iter().position(|tag| tag.0 == code)?;
        let value = self.tags[at].1.parse().ok().filter(|v: &f64| v.is_finite());
        self.tags = &self.tags[at + 1..];
        value
    }

    fn count(&mut self, code: i32) -> Option<usize> {
        self.seek(code).map(|n| n.clamp(0.0, MAX_PARTS as f64) as usize)
    }

    fn point(&mut self, code: i32) -> Option<Point3> {
        Some([self.seek(code)?, self.seek(code + 10)?, 0.0])
    }

    /// The next tag, if it has this code.
    fn next_is(&self, code: i32) -> bool {
        self.tags.first().is_some_and(|tag| tag.0 == code)
    }

    fn polyline(&mut self, curves: &mut Vec<Curve>) -> Option<()> {
        let bulges = self.seek(72)? != 0.0;
        self.seek(73)?;
        let count = self.count(93)?;
        let mut vertices = Vec::new();
        for _ in 0..count {
            let point = self.point(10)?;
            let bulge = if bulges && self.next_is(42) { self.seek(42)? } else { 0.0 };
            vertices.push((point, bulge));
        }
        curves.push(Curve::Polyline { vertices, closed: true });
        Some(())
    }

    fn edges(&mut self, curves: &mut Vec<Curve>) -> Option<()> {
        let count = self.count(93)?;
        for _ in 0..count {
            match self.seek(72)? as i64 {
                1 => {
                    let ends = [self.point(10)?, self.point(11)?];
                    curves.push(Curve::Polyline { vertices: ends.map(|p| (p, 0.0)).to_vec(), closed: false });
                }
                2 => {
                    let (centre, r) = (self.point(10)?, self.seek(40)?);
                    let (from, to) = self.angles()?;
                    curves.push(Curve::arc(centre, r, from, to));
                }
                3 => {
                    let (centre, major, ratio) = (self.point(10)?, self.point(11)?, self.seek(40)?);
                    let (from, to) = self.angles()?;
                    let minor = [-ratio * major[1], ratio * major[0], 0.0];
                    curves.push(Curve::Ellipse { centre, major, minor, from, to });
                }
                4 => curves.push(self.spline()?),
                _ => return None,
            }
        }
        Some(())
    }

    /// Start and end in the order in which they are passed; those of a clockwise arc are counted the other way round.
    fn angles(&mut self) -> Option<(f64, f64)> {
        let (from, to) = (self.seek(50)?.to_radians(), self.seek(51)?.to_radians());
        let counter_clockwise = self.seek(73)? != 0.0;
        let (from, to) = if counter_clockwise { (from, to) } else { (-to, -from) };
        let turn = (to - from).rem_euclid(TAU);
        Some((from, from + if turn < 1e-9 { TAU } else { turn }))
    }

    fn spline(&mut self) -> Option<Curve> {
        let degree = self.count(94)?;
        self.seek(73)?;
        self.seek(74)?;
        let (knots, points) = (self.count(95)?, self.count(96)?);
        let knots = (0..knots).map(|_| self.seek(40)).collect::<Option<Vec<f64>>>()?;
        let mut weights = Vec::new();
        let mut controls = Vec::new();
        for _ in 0..points {
            controls.push(self.point(10)?);
            if self.next_is(42) {
                weights.push(self.seek(42)?);
            }
        }
        Curve::of_control_points(degree, knots, controls, weights, false)
    }
}
