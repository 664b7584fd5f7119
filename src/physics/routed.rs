//! The Hessian of an element of any routing, which may pass a node several times.

use super::element::{Element, segment};
use super::pattern::Scatter;
use std::ops::Range;

/// What the routing of an element means for its stencil.
#[derive(Clone, Debug)]
pub(super) struct Routed {
    /// Its place among all elements.
    pub element: usize,
    /// Stencil position and weight of every node that carries a point; the points' ranges in it.
    parts: Vec<(u32, f64)>,
    points: Vec<Range<usize>>,
    /// For each stencil position, the segments whose direction its node changes, ascending, and by what part.
    touches: Vec<Vec<(u32, f64)>>,
}

/// Entries of scratch memory that need no allocation: 24 KiB, enough for a tendon through 512 nodes.
const ON_STACK: usize = 1024;

impl Routed {
    /// `stencil`: the distinct nodes that carry the element, ascending.
    pub fn new(element: usize, of: &Element, stencil: &[usize]) -> Self {
        let mut out = Self { element, parts: Vec::new(), points: Vec::new(), touches: vec![Vec::new(); stencil.len()] };
        for point in &of.routing {
            let first = out.parts.len();
            out.parts.extend(point.parts().map(|(n, w)| (stencil.partition_point(|m| *m < n) as u32, w)));
            out.points.push(first..out.parts.len());
        }
        for (k, ends) in out.points.windows(2).enumerate() {
            for (sign, end) in [(-1.0, &ends[0]), (1.0, &ends[1])] {
                for &(position, weight) in &out.parts[end.clone()] {
                    let touches = &mut out.touches[position as usize];
                    match touches.last_mut() {
                        Some((segment, part)) if *segment == k as u32 => *part += sign * weight,
                        _ => touches.push((k as u32, sign * weight)),
                    }
                }
            }
        }
        out
    }

    /// Adds `U'' G^T G + tau d2l`.
    pub fn add_hessian(&self, of: &Element, x: &[f64], tau: f64, tangent: f64, out: &mut Scatter) {
        let (mut stack, mut heap) = ([[0.0; 3]; ON_STACK], Vec::new());
        let count = self.touches.len() + self.points.len();
        let scratch = if count <= ON_STACK {
            &mut stack[..count]
        } else {
            heap.resize(count, [0.0; 3]);
            &mut heap[..]
        };
        let (g, units) = scratch.split_at_mut(self.touches.len());
        let point = of.point();
        for ((s, ends), unit) in of.routing.windows(2).zip(self.points.windows(2)).zip(units.iter_mut()) {
            let (dx, dy, length) = segment(x, s, point);
            let (ux, uy) = (dx / length, dy / length);
            for &(p, w) in &self.parts[ends[0].clone()] {
                g[p as usize][0] -= w * ux;
                g[p as usize][1] -= w * uy;
            }
            for &(p, w) in &self.parts[ends[1].clone()] {
                g[p as usize][0] += w * ux;
                g[p as usize][1] += w * uy;
            }
            // d2 of a length is (I - u u^T) / l = (n n^T + (w/l)^2 I) / l: the normal and the width, times the root of tau/l.
            let root = (tau / length).sqrt();
            *unit = [-uy * root, ux * root, point / length * root];
        }
        out.add(self.element, |a, b| {
            let (ga, gb) = (g[a], g[b]);
            let mut block =
                [tangent * ga[0] * gb[0], tangent * ga[0] * gb[1], tangent * ga[1] * gb[0], tangent * ga[1] * gb[1]];
            for (segment, s) in common(&self.touches[a], &self.touches[b]) {
                let n = units[segment];
                let ww = n[2] * n[2];
                block[0] += s * (n[0] * n[0] + ww);
                block[1] += s * n[0] * n[1];
                block[2] += s * n[1] * n[0];
                block[3] += s * (n[1] * n[1] + ww);
            }
            block
        });
    }
}

/// The segments that two nodes touch both, and the product of their parts.
fn common<'a>(a: &'a [(u32, f64)], b: &'a [(u32, f64)]) -> impl Iterator<Item = (usize, f64)> + 'a {
    let (mut i, mut j) = (0, 0);
    std::iter::from_fn(move || {
        while let (Some(&(s, u)), Some(&(t, v))) = (a.get(i), b.get(j)) {
            i += (s <= t) as usize;
            j += (t <= s) as usize;
            if s == t && u * v != 0.0 {
                return Some((s as usize, u * v));
            }
        }
        None
    })
}
