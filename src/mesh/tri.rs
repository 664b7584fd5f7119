//! A triangulation of the inside of an outline that grows node by node.
//!
//! Triangles know their neighbours; edges of the rim and of tracks are fixed, all others are kept Delaunay by Lawson's
//! flips with exact predicates, so that the result depends on the input's bits alone.

use super::triangulate::{self, doubled_area};
use crate::outline::Point;
use robust::Coord;

/// No neighbour: beyond the rim.
pub(super) const NONE: usize = usize::MAX;

/// An edge by its triangle and the number of its first corner there.
pub(super) type Side = (usize, usize);

#[derive(Clone)]
pub(super) struct Tri {
    pub points: Vec<Point>,
    /// Corners, counter-clockwise.
    pub corners: Vec<[usize; 3]>,
    /// The triangle across the edge from corner `k` to the next; [`NONE`] at the rim.
    pub across: Vec<[usize; 3]>,
    /// Whether that edge must stay.
    pub fixed: Vec<[bool; 3]>,
    /// A triangle at each node.
    at: Vec<usize>,
    rim: usize,
}

/// Where a straight way ends.
pub(super) enum Way {
    /// In this triangle.
    Inside(usize),
    /// At this fixed edge.
    Blocked(Side),
}

impl Tri {
    /// The constrained Delaunay triangulation inside the `rim`, with `tracks` as edges too. `None` where segments cross,
    /// nodes coincide or one is at no triangle, which none of the walks here could leave.
    pub fn new(points: Vec<Point>, rim: &[[usize; 2]], tracks: &[[usize; 2]]) -> Option<Self> {
        let corners = triangulate::triangles(&points, rim, tracks)?;
        let mut tri = Self {
            at: vec![NONE; points.len()],
            across: vec![[NONE; 3]; corners.len()],
            fixed: vec![[true; 3]; corners.len()],
            rim: rim.len(),
            points,
            corners,
        };
        let mut sides: Vec<([usize; 2], Side)> = Vec::with_capacity(3 * tri.corners.len());
        for (t, c) in tri.corners.iter().enumerate() {
            for k in 0..3 {
                tri.at[c[k]] = t;
                sides.push((sorted(c[k], c[(k + 1) % 3]), (t, k)));
            }
        }
        if tri.at.contains(&NONE) {
            return None;
        }
        sides.sort_unstable();
        let mut tracks: Vec<[usize; 2]> = tracks.iter().map(|&[a, b]| sorted(a, b)).collect();
        tracks.sort_unstable();
        for pair in sides.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            let ((t, k), (u, j)) = (pair[0].1, pair[1].1);
            tri.across[t][k] = u;
            tri.across[u][j] = t;
            let track = tracks.binary_search(&pair[0].0).is_ok();
            tri.fixed[t][k] = track;
            tri.fixed[u][j] = track;
        }
        Some(tri)
    }

    /// Number of edges: `(3 T + B) / 2`.
    pub fn edges(&self) -> usize {
        (3 * self.corners.len() + self.rim) / 2
    }

    /// The ends of an edge.
    pub fn ends(&self, (t, k): Side) -> [usize; 2] {
        [self.corners[t][k], self.corners[t][(k + 1) % 3]]
    }

    pub fn apex(&self, (t, k): Side) -> usize {
        self.corners[t][(k + 2) % 3]
    }

    pub fn places(&self, t: usize) -> [Point; 3] {
        self.corners[t].map(|n| self.points[n])
    }

    /// The other side of an edge.
    pub fn twin(&self, side: Side) -> Option<Side> {
        let u = self.across[side.0][side.1];
        let [a, b] = self.ends(side);
        (u != NONE).then(|| (u, (0..3).find(|&j| self.ends((u, j)) == [b, a]).unwrap_or(0)))
    }

    /// The triangles at a node, counter-clockwise, from the rim if it is there.
    pub fn star(&self, node: usize, found: &mut Vec<usize>) {
        found.clear();
        let first = self.at[node];
        let corner = |t: usize| (0..3).find(|&k| self.corners[t][k] == node).unwrap_or(0);
        // Back to the rim, or once around.
        let mut start = first;
        loop {
            let before = self.across[start][corner(start)];
            if before == NONE || before == first {
                break;
            }
            start = before;
        }
        let mut t = start;
        loop {
            found.push(t);
            t = self.across[t][(corner(t) + 2) % 3];
            if t == NONE || t == start {
                return;
            }
        }
    }

    /// Follows the straight way from inside triangle `t` to `goal`.
    pub fn walk(&self, t: usize, goal: Point) -> Way {
        let [a, b, c] = self.places(t);
        let start = [(a[0] + b[0] + c[0]) / 3.0, (a[1] + b[1] + c[1]) / 3.0];
        let mut t = t;
        let mut came_from = NONE;
        for _ in 0..=self.corners.len() {
            let mut exit = None;
            for k in 0..3 {
                let [a, b] = self.ends((t, k)).map(|n| self.points[n]);
                if orient(a, b, goal) >= 0.0 || (self.across[t][k] == came_from && came_from != NONE) {
                    continue;
                }
                let through = orient(start, goal, a) <= 0.0 && orient(start, goal, b) >= 0.0;
                if through || exit.is_none() {
                    exit = Some(k);
                }
                if through {
                    break;
                }
            }
            let Some(k) = exit else { return Way::Inside(t) };
            if self.fixed[t][k] {
                return Way::Blocked((t, k));
            }
            came_from = t;
            t = self.across[t][k];
        }
        Way::Inside(t)
    }

    /// Adds a node inside triangle `t`; `None` where it falls on a node or an edge too closely.
    pub fn insert(&mut self, t: usize, p: Point) -> Option<usize> {
        let [a, b, c] = self.places(t);
        if doubled_area(a, b, p) <= 0.0 || doubled_area(b, c, p) <= 0.0 || doubled_area(c, a, p) <= 0.0 {
            return None;
        }
        let node = self.new_node(p);
        let [a, b, c] = self.corners[t];
        let (across, fixed) = (self.across[t], self.fixed[t]);
        let (u, w) = (self.corners.len(), self.corners.len() + 1);
        self.corners.extend([[b, c, node], [c, a, node]]);
        self.across.extend([[across[1], w, t], [across[2], t, u]]);
        self.fixed.extend([[fixed[1], false, false], [fixed[2], false, false]]);
        self.corners[t] = [a, b, node];
        self.across[t] = [across[0], u, w];
        self.fixed[t] = [fixed[0], false, false];
        self.redirect(across[1], t, [b, c], u);
        self.redirect(across[2], t, [c, a], w);
        for t in [t, u, w] {
            self.remember(t);
        }
        self.legalise(vec![(t, 0), (u, 0), (w, 0)]);
        Some(node)
    }

    /// Adds a node at `p` on an edge, or near it on an edge of the rim. `None` where a triangle would turn over.
    pub fn split(&mut self, side: Side, p: Point) -> Option<usize> {
        let [a, b] = self.ends(side);
        let twin = self.twin(side);
        for (x, y, apex) in std::iter::once((a, b, self.apex(side))).chain(twin.map(|twin| (b, a, self.apex(twin)))) {
            let [x, y, apex] = [x, y, apex].map(|n| self.points[n]);
            if doubled_area(x, p, apex) <= 0.0 || doubled_area(p, y, apex) <= 0.0 {
                return None;
            }
        }
        let node = self.new_node(p);
        let mut open = Vec::with_capacity(4);
        let far = self.halve(side, node, &mut open);
        match twin {
            Some(twin) => {
                let twin_far = self.halve(twin, node, &mut open);
                // side: a-node stays, node-b is `far`; twin: b-node stays, node-a is `twin_far`.
                self.link((side.0, [a, node]), (twin_far, [node, a]));
                self.link((far, [node, b]), (twin.0, [b, node]));
            }
            None => self.rim += 1,
        }
        self.legalise(open);
        Some(node)
    }

    /// Cuts the triangle of a side from `node` on it to the apex; the new triangle has the second half.
    fn halve(&mut self, (t, k): Side, node: usize, open: &mut Vec<Side>) -> usize {
        let [a, b] = self.ends((t, k));
        let c = self.apex((t, k));
        let (across, fixed) = (self.across[t], self.fixed[t]);
        let (after, before) = ((k + 1) % 3, (k + 2) % 3);
        let u = self.corners.len();
        self.corners.push([node, b, c]);
        self.across.push([across[k], across[after], t]);
        self.fixed.push([fixed[k], fixed[after], false]);
        self.corners[t] = [a, node, c];
        self.across[t] = [across[k], u, across[before]];
        self.fixed[t] = [fixed[k], false, fixed[before]];
        self.redirect(across[after], t, [b, c], u);
        self.remember(t);
        self.remember(u);
        open.extend([(t, 2), (u, 1)]);
        u
    }

    fn link(&mut self, (t, side): (usize, [usize; 2]), (u, other): (usize, [usize; 2])) {
        for (t, side, u) in [(t, side, u), (u, other, t)] {
            if let Some(k) = (0..3).find(|&k| self.ends((t, k)) == side) {
                self.across[t][k] = u;
            }
        }
    }

    fn new_node(&mut self, p: Point) -> usize {
        self.points.push(p);
        self.at.push(NONE);
        self.points.len() - 1
    }

    /// The neighbour `t` of an edge (as seen from the old triangle: `ends`) that was `old` is `new` now.
    fn redirect(&mut self, t: usize, old: usize, [a, b]: [usize; 2], new: usize) {
        if t == NONE {
            return;
        }
        if let Some(k) = (0..3).find(|&k| self.across[t][k] == old && self.ends((t, k)) == [b, a]) {
            self.across[t][k] = new;
        }
    }

    fn remember(&mut self, t: usize) {
        for n in self.corners[t] {
            self.at[n] = t;
        }
    }

    /// Makes every edge Delaunay that is not fixed.
    pub fn legalise_all(&mut self) {
        let open = (0..self.corners.len()).flat_map(|t| (0..3).map(move |k| (t, k))).collect();
        self.legalise(open);
    }

    fn legalise(&mut self, mut open: Vec<Side>) {
        while let Some((t, k)) = open.pop() {
            if self.fixed[t][k] {
                continue;
            }
            let Some((u, j)) = self.twin((t, k)) else { continue };
            let d = self.apex((u, j));
            let [a, b, c] = [self.corners[t][k], self.corners[t][(k + 1) % 3], self.apex((t, k))];
            if !in_circle([a, b, c].map(|n| self.points[n]), self.points[d]) {
                continue;
            }
            // (a b c) and (b a d) become (a d c) and (d b c).
            let (ta, tf, ua, uf) = (self.across[t], self.fixed[t], self.across[u], self.fixed[u]);
            let (k1, k2, j1, j2) = ((k + 1) % 3, (k + 2) % 3, (j + 1) % 3, (j + 2) % 3);
            self.corners[t] = [a, d, c];
            self.across[t] = [ua[j1], u, ta[k2]];
            self.fixed[t] = [uf[j1], false, tf[k2]];
            self.corners[u] = [d, b, c];
            self.across[u] = [ua[j2], ta[k1], t];
            self.fixed[u] = [uf[j2], tf[k1], false];
            self.redirect(ua[j1], u, [a, d], t);
            self.redirect(ta[k1], t, [b, c], u);
            self.remember(t);
            self.remember(u);
            open.extend([(t, 0), (t, 2), (u, 0), (u, 1)]);
        }
    }
}

fn sorted(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

fn coord(p: Point) -> Coord<f64> {
    Coord { x: p[0], y: p[1] }
}

fn orient(a: Point, b: Point, c: Point) -> f64 {
    robust::orient2d(coord(a), coord(b), coord(c))
}

fn in_circle([a, b, c]: [Point; 3], d: Point) -> bool {
    robust::incircle(coord(a), coord(b), coord(c), coord(d)) > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_node_outside_the_rim_is_refused() {
        let mut points = vec![[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]];
        let rim = [[0, 1], [1, 2], [2, 3], [3, 0]];
        assert_eq!(Tri::new(points.clone(), &rim, &[]).unwrap().corners.len(), 2);
        points.push([6.0, 2.0]);
        assert!(Tri::new(points, &rim, &[]).is_none());
    }
}
