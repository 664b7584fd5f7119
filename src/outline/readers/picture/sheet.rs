//! A sheet of paper in a picture, and what it looks like from straight above.
//!
//! A photo of a sheet shows it as a convex quadrilateral; the map that takes its corners to those of a rectangle is a homography. How much
//! wider than high the sheet is follows from the corners alone where the lens looks at the middle of the picture (Zhang and He 2007,
//! *Whiteboard scanning and image enhancement*); near a right-angled view that is the ratio of its mean sides.

use crate::outline::regions::{self, Shapes};
use crate::outline::{Point, polygon};

/// A region that fills so much of its quadrilateral is one, corners that are worn or round included.
const FILLS: f64 = 0.94;
/// Part of the picture that a sheet covers at least.
const COVERS: f64 = 0.12;
/// Sides that differ by more than this part from those across, or corners that are off a right angle by as much, rad: it is seen at an angle.
const ASKEW: f64 = 0.015;
/// Proportions of common sheets: A4 and its kin, US Letter; taken where they are this near.
const SHEETS: [f64; 2] = [std::f64::consts::SQRT_2, 11.0 / 8.5];
const NEAR_SHEET: f64 = 0.03;

/// A quadrilateral, counter-clockwise (y up), the lower left corner first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sheet(pub [Point; 4]);

impl Sheet {
    /// The sheet that regions of a picture of a size show, if they do.
    pub fn of(shapes: &Shapes, size: [f64; 2]) -> Option<Self> {
        let points: Vec<Point> = shapes.iter().filter_map(|rings| rings.first()).flatten().copied().collect();
        let hull = hull(points);
        let corners = quadrilateral(&hull)?;
        let area = polygon::signed_area(&corners);
        let fits = polygon::signed_area(&hull) > FILLS * area && area > COVERS * size[0] * size[1];
        let low =
            (0..4).min_by(|&a, &b| (corners[a][0] + corners[a][1]).total_cmp(&(corners[b][0] + corners[b][1])))?;
        fits.then(|| Self(std::array::from_fn(|k| corners[(low + k) % 4])))
    }

    /// The corners moved inwards by a distance.
    pub fn shrunk(&self, by: f64) -> Shapes {
        regions::grown(&vec![vec![self.0.to_vec()]], -by)
    }

    /// Whether it is seen at an angle.
    pub fn is_askew(&self) -> bool {
        let side = |k: usize| polygon::length(self.0[k % 4], self.0[(k + 1) % 4]);
        let unlike = |a: f64, b: f64| (a / b - 1.0).abs() > ASKEW;
        let corner = |k: usize| {
            let (p, q, r) = (self.0[k], self.0[(k + 1) % 4], self.0[(k + 2) % 4]);
            let (u, v) = ([q[0] - p[0], q[1] - p[1]], [r[0] - q[0], r[1] - q[1]]);
            ((u[0] * v[0] + u[1] * v[1]) / (side(k) * side(k + 1))).abs() > ASKEW
        };
        unlike(side(0), side(2)) || unlike(side(1), side(3)) || (0..4).any(corner)
    }

    /// The map to a rectangle of the sheet's own proportions, as high as the sheet is on the mean, with its lower left corner where the
    /// sheet's is; and width over height. `middle`: of the picture.
    pub fn straightened(&self, middle: Point) -> Option<(Homography, f64)> {
        let side = |k: usize| polygon::length(self.0[k], self.0[(k + 1) % 4]);
        let plain = (side(0) + side(2)) / (side(1) + side(3));
        let ratio = self.proportions(middle).filter(|ratio| (ratio / plain).ln().abs() < 0.7).unwrap_or(plain);
        let common = SHEETS.into_iter().flat_map(|r| [r, 1.0 / r]).find(|r| (ratio / r - 1.0).abs() < NEAR_SHEET);
        let ratio = common.unwrap_or(ratio);
        let height = 0.5 * (side(1) + side(3));
        let [x, y] = self.0[0];
        let to = [[x, y], [x + ratio * height, y], [x + ratio * height, y + height], [x, y + height]];
        Homography::of(&self.0, &to).map(|map| (map, ratio))
    }

    /// Width over height by the vanishing points of the sides; `None` where these are too far to tell.
    fn proportions(&self, middle: Point) -> Option<f64> {
        let m = self.0.map(|p| [p[0] - middle[0], p[1] - middle[1], 1.0]);
        // Corners of the unit square: m0 (0, 0), m1 (1, 0), m2 (1, 1), m3 (0, 1).
        let k2 = dot(cross(m[0], m[2]), m[3]) / dot(cross(m[1], m[2]), m[3]);
        let k3 = dot(cross(m[0], m[2]), m[1]) / dot(cross(m[3], m[2]), m[1]);
        let n2 = [0, 1, 2].map(|i| k2 * m[1][i] - m[0][i]);
        let n3 = [0, 1, 2].map(|i| k3 * m[3][i] - m[0][i]);
        // The focal length makes the two directions of the sheet perpendicular in space.
        let square = -(n2[0] * n3[0] + n2[1] * n3[1]) / (n2[2] * n3[2]);
        let far = n2[2].abs().min(n3[2].abs()) < 1e-3;
        if far || !(square.is_finite() && square > 0.0) {
            return None;
        }
        let length = |n: [f64; 3]| ((n[0] * n[0] + n[1] * n[1]) / square + n[2] * n[2]).sqrt();
        Some(length(n2) / length(n3))
    }
}

/// A projective map of the plane, row by row, the last entry 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Homography([f64; 9]);

impl Homography {
    /// The map that takes four points to four others; `None` where three of them are in line.
    pub fn of(from: &[Point; 4], to: &[Point; 4]) -> Option<Self> {
        let mut rows = nalgebra::SMatrix::<f64, 8, 8>::zeros();
        let mut right = nalgebra::SVector::<f64, 8>::zeros();
        for (k, ([x, y], [u, v])) in from.iter().zip(to).enumerate() {
            rows.row_mut(2 * k).copy_from_slice(&[*x, *y, 1.0, 0.0, 0.0, 0.0, -u * x, -u * y]);
            rows.row_mut(2 * k + 1).copy_from_slice(&[0.0, 0.0, 0.0, *x, *y, 1.0, -v * x, -v * y]);
            (right[2 * k], right[2 * k + 1]) = (*u, *v);
        }
        let h = rows.lu().solve(&right)?;
        let all: [f64; 9] = std::array::from_fn(|k| if k < 8 { h[k] } else { 1.0 });
        all.iter().all(|v| v.is_finite()).then_some(Self(all))
    }

    pub fn at(&self, [x, y]: Point) -> Point {
        let h = &self.0;
        let w = h[6] * x + h[7] * y + h[8];
        [(h[0] * x + h[1] * y + h[2]) / w, (h[3] * x + h[4] * y + h[5]) / w]
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The convex hull, counter-clockwise (Andrew 1979).
fn hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    let turn = |o: Point, a: Point, b: Point| (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
    let half = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for p in points {
            while chain.len() >= 2 && turn(chain[chain.len() - 2], chain[chain.len() - 1], p) <= 0.0 {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter().copied());
    hull.extend(half(&mut points.iter().rev().copied()));
    hull
}

/// The quadrilateral around a convex polygon that is left when its least sides are taken away, each by making its neighbours longer.
fn quadrilateral(hull: &[Point]) -> Option<[Point; 4]> {
    let mut points = hull.to_vec();
    while points.len() > 4 {
        let n = points.len();
        // What taking side i (from i to i + 1) away would add, and the point where its neighbours meet.
        let without = |i: usize| {
            let (a, b, c, d) = (points[(i + n - 1) % n], points[i], points[(i + 1) % n], points[(i + 2) % n]);
            let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - d[0], c[1] - d[1]]);
            let det = u[0] * v[1] - u[1] * v[0];
            let t = ((c[0] - b[0]) * v[1] - (c[1] - b[1]) * v[0]) / det;
            let meet = [b[0] + t * u[0], b[1] + t * u[1]];
            let added = polygon::signed_area(&[b, meet, c]);
            (t > 0.0 && added.is_finite() && added >= 0.0).then_some((added, i, meet))
        };
        let (_, i, meet) = (0..n).filter_map(without).min_by(|a, b| a.0.total_cmp(&b.0))?;
        points[i] = meet;
        points.remove((i + 1) % n);
    }
    points.try_into().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The corners of a sheet of 210 x 297 as a camera of a focal length sees it that is tilted and turned.
    fn seen(tilt: f64, turn: f64) -> [Point; 4] {
        [[-105.0, -148.5], [105.0, -148.5], [105.0, 148.5], [-105.0, 148.5]].map(|[x, y]: Point| {
            let (x, y) = (x * turn.cos() - y * turn.sin(), x * turn.sin() + y * turn.cos());
            let (y, z) = (y * tilt.cos(), 600.0 + y * tilt.sin());
            [500.0 + 1000.0 * x / z, -400.0 + 1000.0 * y / z]
        })
    }

    #[test]
    fn a_sheet_seen_at_an_angle_is_straightened_to_its_proportions() {
        for (tilt, turn) in [(0.4, 0.2), (-0.5, 0.1), (0.3, -0.3)] {
            let sheet = Sheet::of(&vec![vec![seen(tilt, turn).to_vec()]], [1000.0, 800.0]).unwrap();
            assert!(sheet.is_askew());
            let ratio = sheet.proportions([500.0, -400.0]).unwrap();
            assert!((ratio * 297.0 / 210.0 - 1.0).abs() < 1e-6, "{ratio}");
            let (map, _) = sheet.straightened([500.0, -400.0]).unwrap();
            let [a, b, c, d] = sheet.0.map(|p| map.at(p));
            assert!((polygon::length(a, b) - polygon::length(c, d)).abs() < 1e-6);
            assert!((polygon::length(a, b) / polygon::length(b, c) * 297.0 / 210.0 - 1.0).abs() < 1e-3);
        }
        let plain = Sheet::of(&vec![vec![seen(0.0, 0.0).to_vec()]], [1000.0, 800.0]).unwrap();
        assert!(!plain.is_askew());
        // A disc is no sheet.
        let disc = (0..100).map(|i| f64::from(i) * std::f64::consts::TAU / 100.0);
        let disc = disc.map(|t| [500.0 + 300.0 * t.cos(), -400.0 + 300.0 * t.sin()]).collect();
        assert_eq!(Sheet::of(&vec![vec![disc]], [1000.0, 800.0]), None);
    }
}
