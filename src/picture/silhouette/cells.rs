//! The felt within a drawn silhouette, cut into triangles: those of the mesh, finer, with the drawn rim in the place of its sides.

use super::rim::Rim;
use super::tie::{Tie, doubled_area};
use crate::mesh::Mesh;
use crate::outline::Point;
use std::collections::BTreeMap;

/// Triangles between the drawn rim and the inside.
pub struct Cut {
    pub ties: Vec<Tie>,
    pub rest: Vec<Point>,
    pub triangles: Vec<[usize; 3]>,
    pub rings: Vec<Vec<usize>>,
    /// Whether no triangle is turned over.
    pub is_upright: bool,
}

/// Points on a side of a triangle: part of the way from its first end, and number.
type Side = Vec<(f64, usize)>;

/// Cuts each triangle of a mesh into `parts` times `parts`.
pub fn cut(mesh: &Mesh, rim: &Rim, parts: usize) -> Cut {
    let mut cut = Cut {
        ties: mesh.nodes.iter().enumerate().map(|(n, _)| Tie::Inside([n; 3], [1.0, 0.0, 0.0])).collect(),
        rest: mesh.nodes.clone(),
        triangles: Vec::new(),
        rings: Vec::new(),
        is_upright: true,
    };
    let rims = cut.tie_rims(mesh, rim, parts);
    let mut inner: BTreeMap<[usize; 2], Side> = BTreeMap::new();
    for &corners in &mesh.triangles {
        let sides = [0, 1, 2].map(|k| {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            if let Some(side) = rims.get(&[a, b]) {
                return (side.clone(), true);
            }
            let key = [a.min(b), a.max(b)];
            let side = inner.entry(key).or_insert_with(|| cut.inner_side(mesh, key, parts));
            let side = if a < b { side.clone() } else { side.iter().rev().map(|&(t, p)| (1.0 - t, p)).collect() };
            (side, false)
        });
        cut.triangle(mesh, corners, &sides, parts);
    }
    cut
}

impl Cut {
    fn add(&mut self, tie: Tie, place: Point) -> usize {
        self.ties.push(tie);
        self.rest.push(place);
        self.ties.len() - 1
    }

    /// The drawn points of all rims, by the directed edge of the mesh: both ends, and one at every part of the way.
    fn tie_rims(&mut self, mesh: &Mesh, rim: &Rim, parts: usize) -> BTreeMap<[usize; 2], Side> {
        let mut sides = BTreeMap::new();
        for ring in &rim.rings {
            let mut line = Vec::new();
            let next = ring.iter().cycle().skip(1);
            for (stretch, next) in ring.iter().zip(next) {
                let mut points = stretch.points.clone();
                points.extend(next.points.first().map(|&(_, end)| (1.0, end)));
                for k in 1..parts {
                    insert(&mut points, k as f64 / parts as f64);
                }
                points.pop();
                let mut side = Side::new();
                for &point in &points {
                    let tie = Tie::Rim(rim.tie(mesh, stretch, point));
                    let number = if point.0 == 0.0 {
                        // The node itself, which the drawing may pass at a little distance.
                        (self.ties[stretch.from], self.rest[stretch.from]) = (tie, point.1);
                        stretch.from
                    } else {
                        self.add(tie, point.1)
                    };
                    side.push((point.0, number));
                    line.push(number);
                }
                side.push((1.0, stretch.to));
                sides.insert([stretch.from, stretch.to], side);
            }
            self.rings.push(line);
        }
        sides
    }

    fn inner_side(&mut self, mesh: &Mesh, [a, b]: [usize; 2], parts: usize) -> Side {
        let mut side = vec![(0.0, a)];
        for k in 1..parts {
            let t = k as f64 / parts as f64;
            side.push((t, self.inside(mesh, [a, b, b], [1.0 - t, t, 0.0])));
        }
        side.push((1.0, b));
        side
    }

    fn inside(&mut self, mesh: &Mesh, corners: [usize; 3], weights: [f64; 3]) -> usize {
        let place = [0, 1].map(|k| corners.iter().zip(weights).map(|(&n, w)| w * mesh.nodes[n][k]).sum());
        self.add(Tie::Inside(corners, weights), place)
    }

    /// Row `i` of a triangle runs from its first side to its last, `i` parts from its first corner, and has i + 1 points.
    fn triangle(&mut self, mesh: &Mesh, corners: [usize; 3], sides: &[(Side, bool); 3], parts: usize) {
        let part = |k: usize| k as f64 / parts as f64;
        let on = |side: usize, t: f64| {
            let near = sides[side].0.iter().min_by(|a, b| (a.0 - t).abs().total_cmp(&(b.0 - t).abs()));
            near.map_or(corners[side], |&(_, p)| p)
        };
        let mut rows: Vec<Vec<usize>> = Vec::new();
        for i in 0..=parts {
            let row = (0..=i).map(|j| match (i, j) {
                (0, _) => corners[0],
                (_, 0) => on(0, part(i)),
                _ if j == i => on(2, 1.0 - part(i)),
                _ if i == parts => on(1, part(j)),
                _ => self.inside(mesh, corners, [1.0 - part(i), part(i - j), part(j)]),
            });
            let row: Vec<usize> = row.collect();
            rows.push(row);
        }
        // Points of a drawn side between two parts of the way.
        let between = |side: usize, from: f64, to: f64| {
            let (points, drawn) = &sides[side];
            let (low, high) = (from + 1e-9, to - 1e-9);
            let own = points.iter().filter(move |(t, _)| *drawn && *t > low && *t < high);
            own.map(|&(_, p)| p).collect::<Vec<usize>>()
        };
        for i in 0..parts {
            for j in 0..=i {
                let mut cell = vec![rows[i][j]];
                if j == 0 {
                    cell.extend(between(0, part(i), part(i + 1)));
                }
                cell.push(rows[i + 1][j]);
                if i + 1 == parts {
                    cell.extend(between(1, part(j), part(j + 1)));
                }
                cell.push(rows[i + 1][j + 1]);
                if j == i {
                    cell.extend(between(2, 1.0 - part(i + 1), 1.0 - part(i)));
                }
                self.clip(cell);
                if j < i {
                    self.clip(vec![rows[i][j], rows[i + 1][j + 1], rows[i][j + 1]]);
                }
            }
        }
    }

    /// Cuts a polygon into triangles, always where that leaves the widest one.
    fn clip(&mut self, mut cell: Vec<usize>) {
        while cell.len() > 3 {
            let ear = (0..cell.len()).max_by(|&a, &b| self.worth(&cell, a).total_cmp(&self.worth(&cell, b)));
            let ear = ear.unwrap_or_default();
            let [a, b, c] = around(&cell, ear);
            self.push([a, b, c]);
            cell.remove(ear);
        }
        if let [a, b, c] = cell[..] {
            self.push([a, b, c]);
        }
    }

    fn push(&mut self, triangle: [usize; 3]) {
        let [a, b, c] = triangle.map(|p| self.rest[p]);
        self.is_upright &= doubled_area(a, b, c) >= 0.0;
        self.triangles.push(triangle);
    }

    /// How good a triangle a corner of a cell makes: its area by the square of its longest side; below zero where it is none of the cell.
    fn worth(&self, cell: &[usize], corner: usize) -> f64 {
        let ends = around(cell, corner);
        let [a, b, c] = ends.map(|p| self.rest[p]);
        let area = doubled_area(a, b, c);
        let square = |p: Point, q: Point| (q[0] - p[0]).powi(2) + (q[1] - p[1]).powi(2);
        let longest = square(a, b).max(square(b, c)).max(square(c, a)).max(f64::MIN_POSITIVE);
        let holds = |p: &usize| {
            let q = self.rest[*p];
            !ends.contains(p) && [(a, b), (b, c), (c, a)].iter().all(|&(u, v)| doubled_area(u, v, q) > 0.0)
        };
        if area > 0.0 && cell.iter().any(holds) { -1.0 } else { area / longest }
    }
}

fn around(cell: &[usize], corner: usize) -> [usize; 3] {
    let count = cell.len();
    [cell[(corner + count - 1) % count], cell[corner], cell[(corner + 1) % count]]
}

/// Adds a point at a part of the way between the first and the last, unless one is there: that is moved.
fn insert(points: &mut Vec<(f64, Point)>, t: f64) {
    /// Nearer than this part of a stretch two points are one.
    const SAME: f64 = 1e-3;
    let after = points.partition_point(|&(at, _)| at < t);
    let (Some(&(t0, p0)), Some(&(t1, p1))) = (points.get(after.wrapping_sub(1)), points.get(after)) else { return };
    if t - t0 < SAME && after > 1 {
        points[after - 1].0 = t;
    } else if t1 - t < SAME && after + 1 < points.len() {
        points[after].0 = t;
    } else {
        let s = (t - t0) / (t1 - t0);
        points.insert(after, (t, [0, 1].map(|k| p0[k] + s * (p1[k] - p0[k]))));
    }
}
