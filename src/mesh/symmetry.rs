//! Mirror symmetry of an outline: finding the axis, cutting along it, and mirroring a half mesh.
//!
//! A half is meshed in the frame of the axis, `u` along it and `v` to its left, with the axis as a part of its rim; there the
//! mirror image of `(u, v)` is exactly `(u, -v)`. Coordinates across a vertical or horizontal axis are rounded to a power
//! of two, so that the two halves are mirror images to the bit.

use super::Mesh;
use super::grid::Grid;
use super::order::order;
use crate::outline::{Outline, Point, polygon};

/// Farthest that the mirror image may be from the outline, as a fraction of the longer side of the box: 0.3 mm on 300 mm. More
/// than the simplification of an outline leaves, less than a maker sees.
const TOLERANCE: f64 = 1e-3;
/// A moment of the area below this has no say about the axis (dimensionless; that of a random blob is about 0.1).
const SMALLEST_MOMENT: f64 = 0.01;
/// Highest moment looked at: tells the axes of regular shapes with up to this many corners.
const MOMENTS: usize = 8;
/// Vertices this near to the axis are on it, as a fraction of the size.
const SNAP: f64 = 1e-9;
/// Fraction of the size to which coordinates across the axis are rounded.
const ROUNDING: f64 = 1.0 / (1_u64 << 41) as f64;

/// A line through `origin` along the unit vector `along`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    pub origin: Point,
    pub along: Point,
}

impl Axis {
    /// The point's coordinate along the axis and its distance to the left of it.
    fn to_frame(self, p: Point) -> Point {
        let [dx, dy] = [p[0] - self.origin[0], p[1] - self.origin[1]];
        match self.along {
            [0.0, 1.0] => [p[1], -dx],
            [1.0, 0.0] => [p[0], dy],
            [x, y] => [dx * x + dy * y, x * dy - y * dx],
        }
    }

    fn in_plane(self, [u, v]: Point) -> Point {
        let [x0, y0] = self.origin;
        match self.along {
            [0.0, 1.0] => [x0 - v, u],
            [1.0, 0.0] => [u, y0 + v],
            [x, y] => [x0 + u * x - v * y, y0 + u * y + v * x],
        }
    }

    /// The mirror image of a point.
    pub fn mirror(self, p: Point) -> Point {
        let [u, v] = self.to_frame(p);
        self.in_plane([u, -v])
    }
}

/// The axis about which the outline is its own mirror image, if it has one: a vertical one before a horizontal one before
/// others. With it the farthest distance of the mirror image from the outline, mm.
pub fn axis(outline: &Outline) -> Option<(Axis, f64)> {
    let (low, high) = outline.bounding_box();
    let longer = (high[0] - low[0]).max(high[1] - low[1]);
    let unit = rounding(longer);
    let round = |v: f64| (v / unit).round() * unit;
    let center = centroid(outline);
    // The middle of the box has fewer roundings behind it.
    let middle = [0, 1].map(|k| 0.5 * (low[k] + high[k]));
    let upright =
        [0, 1].map(|k| round(if (middle[k] - center[k]).abs() < TOLERANCE * longer { middle[k] } else { center[k] }));
    let mut candidates = vec![
        Axis { origin: [upright[0], 0.0], along: [0.0, 1.0] },
        Axis { origin: [0.0, upright[1]], along: [1.0, 0.0] },
    ];
    candidates.extend(angles(outline, center).into_iter().map(|a| Axis { origin: center, along: [a.cos(), a.sin()] }));
    let grid = Grid::new(outline.polygons().flat_map(polygon::sides).collect());
    let tolerance = TOLERANCE * longer;
    candidates.into_iter().find_map(|axis| {
        let mut farthest: f64 = 0.0;
        for (a, b) in outline.polygons().flat_map(polygon::sides) {
            let steps = (polygon::length(a, b) / (0.01 * longer)).ceil().max(1.0) as usize;
            for k in 0..steps {
                let p = polygon::lerp(a, b, k as f64 / steps as f64);
                farthest = farthest.max(grid.distance(axis.mirror(p)));
                if farthest > tolerance {
                    return None;
                }
            }
        }
        Some((axis, farthest))
    })
}

/// Whether a mesh is its own mirror image about an axis: every node has one, and every triangle.
pub fn is_mirrored(mesh: &Mesh, axis: Axis) -> bool {
    let near = 1e-9 * mesh.body_length();
    // By the coordinates of a grid wide enough that a node and its image differ by one cell at most.
    let cell = |v: f64| (v / (4.0 * near)).floor() as i64;
    let mut at = std::collections::BTreeMap::new();
    for (i, p) in mesh.nodes.iter().enumerate() {
        at.insert([cell(p[0]), cell(p[1])], i);
    }
    let image = |p: &Point| {
        let q = axis.mirror(*p);
        let [x, y] = q.map(cell);
        (x - 1..=x + 1)
            .flat_map(|i| (y - 1..=y + 1).map(move |j| [i, j]))
            .find_map(|key| at.get(&key).copied().filter(|&n| polygon::length(mesh.nodes[n], q) <= near))
    };
    let Some(images) = mesh.nodes.iter().map(image).collect::<Option<Vec<usize>>>() else { return false };
    let mut mirrored: Vec<[usize; 3]> =
        mesh.triangles.iter().map(|&[a, b, c]| [images[a], images[c], images[b]]).collect();
    let mut own = mesh.triangles.clone();
    order(&mut mirrored);
    order(&mut own);
    mirrored == own
}

/// A power of two far below anything that matters at this size.
fn rounding(size: f64) -> f64 {
    (size.log2().ceil().exp2() * ROUNDING).max(f64::MIN_POSITIVE)
}

fn centroid(outline: &Outline) -> Point {
    let o = outline.outer.first().copied().unwrap_or_default();
    let (mut area, mut sum) = (0.0, [0.0; 2]);
    for (a, b) in outline.polygons().flat_map(polygon::sides) {
        let (a, b) = ([a[0] - o[0], a[1] - o[1]], [b[0] - o[0], b[1] - o[1]]);
        let cross = a[0] * b[1] - a[1] * b[0];
        area += 3.0 * cross;
        sum = [sum[0] + cross * (a[0] + b[0]), sum[1] + cross * (a[1] + b[1])];
    }
    [o[0] + sum[0] / area, o[1] + sum[1] / area]
}

/// Directions that an axis can have, rad.
///
/// With `z = x + i y` from the centroid, a mirror axis at the angle `phi` maps `M_m = int z^m dA` to
/// `conj(M_m) exp(2 i m phi)`; they are equal, so `phi = (arg M_m + k pi) / m`. The lowest moment that is not zero decides.
fn angles(outline: &Outline, center: Point) -> Vec<f64> {
    let times = |a: Point, b: Point| [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];
    let area = outline.area();
    let scale = area.sqrt();
    for m in 2..=MOMENTS {
        let mut moment = [0.0; 2];
        for (a, b) in outline.polygons().flat_map(polygon::sides) {
            let a = [(a[0] - center[0]) / scale, (a[1] - center[1]) / scale];
            let b = [(b[0] - center[0]) / scale, (b[1] - center[1]) / scale];
            // Over the triangle 0 a b: cross(a, b) / ((m + 1) (m + 2)) sum_j a^j b^(m - j), by Horner's scheme.
            let (mut sum, mut power) = ([1.0, 0.0], [1.0, 0.0]);
            for _ in 0..m {
                power = times(power, b);
                sum = times(sum, a);
                sum = [sum[0] + power[0], sum[1] + power[1]];
            }
            let weight = (a[0] * b[1] - a[1] * b[0]) / ((m + 1) * (m + 2)) as f64;
            moment = [moment[0] + weight * sum[0], moment[1] + weight * sum[1]];
        }
        if moment[0].hypot(moment[1]) > SMALLEST_MOMENT * 0.4_f64.powi(m as i32) {
            let arg = moment[1].atan2(moment[0]);
            return (0..m).map(|k| (arg + k as f64 * std::f64::consts::PI) / m as f64).collect();
        }
    }
    Vec::new()
}

/// The part of an outline to the left of its axis, in the frame of the axis. Its outer polygon runs along the axis where the
/// body does.
pub(super) struct Half {
    pub outline: Outline,
    /// Vertices of the outer polygon at which it meets the axis, ascending.
    pub on_axis: Vec<usize>,
}

/// Cuts an outline along an axis. `None` where the left part is not one piece.
pub(super) fn half(outline: &Outline, axis: Axis) -> Option<Half> {
    let (low, high) = outline.bounding_box();
    let snap = SNAP * (high[0] - low[0]).max(high[1] - low[1]);
    let mut chains: Vec<Vec<Point>> = Vec::new();
    let mut holes: Vec<Vec<Point>> = Vec::new();
    for ring in outline.polygons() {
        // What is on the axis but for rounding must be exactly there, or a crossing would have two places.
        let snapped = |[u, v]: Point| if v.abs() < snap { [u, 0.0] } else { [u, v] };
        let points: Vec<Point> = ring.iter().map(|&p| snapped(axis.to_frame(p))).collect();
        // The first vertex that the ring enters the left side by.
        let n = points.len();
        let enters = |i: usize| points[i][1] <= 0.0 && points[(i + 1) % n][1] > 0.0;
        let Some(first) = (0..n).find(|&i| enters(i)) else {
            if points.iter().all(|p| p[1] > 0.0) {
                holes.push(points);
            }
            continue;
        };
        for k in 0..n {
            let (a, b) = (points[(first + k) % n], points[(first + k + 1) % n]);
            match (a[1] > 0.0, b[1] > 0.0) {
                (false, true) => chains.push(vec![crossing(a, b), b]),
                (true, true) => chains.last_mut()?.push(b),
                (true, false) => chains.last_mut()?.push(crossing(a, b)),
                (false, false) => {}
            }
        }
    }
    // Along the axis, the body lies between the first and second crossing, the third and fourth, and so on.
    let mut ends: Vec<(f64, usize, bool)> = Vec::new();
    for (k, chain) in chains.iter().enumerate() {
        ends.push((chain.first()?[0], k, true));
        ends.push((chain.last()?[0], k, false));
    }
    ends.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut next = vec![None; chains.len()];
    for pair in ends.chunks(2) {
        let [a, b] = pair else { return None };
        match (a.2, b.2) {
            (true, false) => next[b.1] = Some(a.1),
            (false, true) => next[a.1] = Some(b.1),
            _ => return None,
        }
    }
    let (mut outer, mut on_axis) = (Vec::new(), Vec::new());
    let (mut k, mut visited) = (0, 0);
    loop {
        visited += 1;
        on_axis.push(outer.len());
        outer.extend(chains.get(k)?);
        on_axis.push(outer.len() - 1);
        k = next[k]?;
        if k == 0 {
            break;
        }
        if visited > chains.len() {
            return None;
        }
    }
    let sound = visited == chains.len()
        && polygon::signed_area(&outer) > 0.0
        && holes.iter().all(|hole| polygon::signed_area(hole) < 0.0);
    sound.then_some(Half { outline: Outline { outer, holes }, on_axis })
}

/// Where the side from `a` to `b` meets the axis.
fn crossing(a: Point, b: Point) -> Point {
    let t = a[1] / (a[1] - b[1]);
    [a[0] + t * (b[0] - a[0]), 0.0]
}

/// A mesh of the left half, in the axis' frame, and its mirror image, joined along the axis and brought back.
pub(super) fn unfold(half: &Mesh, axis: Axis, size: f64) -> Mesh {
    let unit = rounding(size);
    let mut nodes: Vec<Point> = Vec::with_capacity(2 * half.nodes.len());
    let rounded = |v: f64| if v > 0.0 { ((v / unit).round() * unit).max(unit) } else { 0.0 };
    nodes.extend(half.nodes.iter().map(|&[u, v]| axis.in_plane([u, rounded(v)])));
    let mut image: Vec<usize> = (0..nodes.len()).collect();
    for (i, &[u, v]) in half.nodes.iter().enumerate() {
        if v > 0.0 {
            image[i] = nodes.len();
            nodes.push(axis.in_plane([u, -rounded(v)]));
        }
    }
    let mirrored = half.triangles.iter().map(|&[a, b, c]| [image[a], image[c], image[b]]);
    let mut triangles: Vec<[usize; 3]> = half.triangles.iter().copied().chain(mirrored).collect();
    order(&mut triangles);
    Mesh { nodes, triangles }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(ring: &[Point], angle: f64) -> Vec<Point> {
        let (s, c) = angle.sin_cos();
        ring.iter().map(|p| [40.0 + c * p[0] - s * p[1], 70.0 + s * p[0] + c * p[1]]).collect()
    }

    /// An arrow that points up.
    const ARROW: [Point; 7] =
        [[-5.0, -30.0], [5.0, -30.0], [5.0, 10.0], [20.0, 10.0], [0.0, 40.0], [-20.0, 10.0], [-5.0, 10.0]];

    #[test]
    fn the_axis_of_a_turned_arrow_is_found() {
        for k in 0..24 {
            let angle = 0.3 * f64::from(k);
            let outline = Outline { outer: turned(&ARROW, angle), holes: Vec::new() };
            let (found, off) = axis(&outline).unwrap_or_else(|| panic!("turned by {angle}"));
            let wanted = [-angle.sin(), angle.cos()];
            assert!((found.along[0] * wanted[1] - found.along[1] * wanted[0]).abs() < 1e-9 && off < 1e-9, "{angle}");
        }
    }

    #[test]
    fn lopsided_shapes_have_none() {
        let mut outer = turned(&ARROW, 0.0);
        outer[3][0] += 2.0;
        assert_eq!(axis(&Outline { outer, holes: Vec::new() }), None);
        let s = [
            [0.0, 0.0],
            [20.0, 0.0],
            [20.0, 30.0],
            [30.0, 30.0],
            [30.0, 40.0],
            [10.0, 40.0],
            [10.0, 10.0],
            [0.0, 10.0],
        ];
        assert_eq!(axis(&Outline { outer: s.to_vec(), holes: Vec::new() }), None, "a rotation is no mirror image");
    }

    #[test]
    fn regular_shapes_have_an_upright_axis_or_one_of_their_own() {
        for corners in [3, 4, 5, 6, 7] {
            for turn in [0.0, 0.1, 1.0] {
                let corner = |i: usize| {
                    let a = turn + std::f64::consts::TAU * i as f64 / corners as f64;
                    [50.0 * a.cos(), 50.0 * a.sin()]
                };
                let outline = Outline { outer: (0..corners).map(corner).collect(), holes: Vec::new() };
                assert!(axis(&outline).is_some(), "{corners} corners turned by {turn}");
            }
        }
    }

    #[test]
    fn halves_have_half_the_area_and_know_their_seam() {
        let ring = |r: f64| (0..4).map(move |i| turned(&[[r, 0.0]], 0.5 * std::f64::consts::PI * f64::from(i))[0]);
        let outline = Outline { outer: ring(30.0).collect(), holes: vec![ring(10.0).rev().collect()] };
        let (axis, _) = axis(&outline).unwrap();
        assert_eq!(axis.along, [0.0, 1.0]);
        let half = half(&outline, axis).unwrap();
        assert!((half.outline.area() - 0.5 * outline.area()).abs() < 1e-9);
        assert_eq!(half.on_axis.len(), 4);
        assert!(half.on_axis.iter().all(|&i| half.outline.outer[i][1] == 0.0) && half.outline.holes.is_empty());
    }
}
