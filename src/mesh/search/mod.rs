//! The search for the best mesh of a given number of edges.
//!
//! A triangulation with `B` boundary nodes, `I` interior nodes and `H` holes has `E = 2 B + 3 I - 3 + 3 H` edges (Euler:
//! `V - E + T = 1 - H`, and `3 T = 2 E - B`). So once the boundary is sampled, nodes are added until the count is there; a
//! node or two more on the boundary make the division by three come out. Two mirrored halves with `A` edges on the axis
//! have `2 E - A`, and a node more on the axis plays its part. What is searched is the spacing along the boundary, among
//! a few about the one at which boundary and interior would be equally dense, and how closely the outline is followed.

mod attempt;
mod budget;
mod found_mesh;
mod subject;

pub(in crate::mesh) use budget::{Thoroughness, WorkBudget};
pub(in crate::mesh) use subject::Subject;

use super::Mesh;
use super::curve::Curve;
use super::quality::MeshQuality;
use super::sample::{Closeness, Extra, Rim};
use super::symmetry::{Axis, Half};
use crate::outline::{Outline, Point};
use attempt::FILLS;
use budget::REFINE_WORK;
use found_mesh::take_best;
use std::cell::{Cell, OnceCell, RefCell};
use subject::most_nodes;

/// The part of all work for finding out how many edges good angles need.
const LEAST_SHARE: f64 = 0.4;
/// Farthest that a chord may stray from the outline, as fractions of its height, tried in turn: with few fibres fine features
/// are rounded off rather than refused.
const STRAYS: [f64; 4] = [0.0047, 0.008, 0.016, 0.03];
/// Limbs and gaps thinner than this part of the height are fine features.
const FINE: f64 = 0.03;
/// Fibres from which following the outline goes before limbs that are two triangles across.
const CLOSE_FROM: usize = 400;
/// Fibres from which fine features are followed as well.
const ALL_CLOSE_FROM: usize = 2000;
/// Area that the mesh may lose or win at each of those, as a fraction.
const AREAS: [f64; 4] = [0.0095, 0.0095, 0.0095, 0.03];

/// The polygons of an outline by arc length.
pub(super) struct Pool<'a>(Vec<Curve<'a>>);

impl<'a> Pool<'a> {
    pub fn of(outline: &'a Outline) -> Self {
        Self(outline.polygons().map(Curve::new).collect())
    }
}

impl<'a> Subject<'a> {
    /// `fibers` are those asked for at first.
    pub fn whole(outline: &'a Outline, pool: &'a Pool<'a>, tracks: &'a [Vec<Point>], fibers: usize) -> Self {
        let rim = Rim { outline, curves: &pool.0, on_axis: &[] };
        let vertices = vertices(outline);
        Self {
            whole: outline,
            rim,
            tracks,
            sampled: RefCell::new(None),
            axis: None,
            height: height(outline),
            off: 0.0,
            vertices,
            spent: Cell::new(0),
            budget: WorkBudget::new(fibers),
            has_fine_features: OnceCell::new(),
            lenient: Cell::new(false),
        }
    }

    pub fn half(
        outline: &'a Outline,
        half: &'a Half,
        pool: &'a Pool<'a>,
        (axis, off): (Axis, f64),
        fibers: usize,
    ) -> Self {
        let rim = Rim { outline: &half.outline, curves: &pool.0, on_axis: &half.on_axis };
        let vertices = vertices(&half.outline);
        Self { rim, axis: Some(axis), off, vertices, ..Self::whole(outline, pool, &[], fibers) }
    }

    /// Whether no more work is allowed.
    pub fn is_exhausted(&self) -> bool {
        self.budget.is_exhausted()
    }

    /// Lets the outline be followed as closely as can be, where it cannot be followed as closely as it should.
    pub fn relax(&self) {
        self.lenient.set(true);
    }

    /// Whether more work might have given more.
    pub fn has_given_up(&self) -> bool {
        self.budget.was_short()
    }

    /// The spacing at which boundary and interior are equally dense.
    pub fn even(&self, fibers: usize) -> f64 {
        even_spacing(self.whole, fibers)
    }

    /// The best mesh found with `fibers` edges, or nearly.
    pub fn mesh(&self, even: f64, fibers: usize, effort: Thoroughness) -> Option<(Mesh, MeshQuality)> {
        let mut found = Vec::new();
        let effort = effort.most(self.vertices + fibers);
        self.spent.set(0);
        for (k, (stray, area)) in STRAYS.into_iter().zip(AREAS).enumerate() {
            let close = Closeness { stray: (stray * self.height - self.off).max(0.5 * stray * self.height), area };
            // Each has its share, and what those before left.
            let effort = effort * (k + 1) / STRAYS.len();
            let good = self.search(even, fibers, close, effort, &mut found);
            if self.is_exhausted() {
                break;
            }
            let unbridged = || found.iter().any(|c| c.quality.bridges == 0);
            let follows = || found.iter().any(|c| c.is_good() && c.follows(self.whole));
            if good && if fibers < CLOSE_FROM { unbridged() } else { follows() || !self.must_be_close(fibers) } {
                break;
            }
        }
        while let Some(best) = take_best(&mut found, fibers) {
            let close = best.is_nearly_good() && best.follows(self.whole);
            if fibers < CLOSE_FROM || close || !self.must_be_close(fibers) {
                return Some((best.mesh, best.quality));
            }
        }
        None
    }

    /// Whether the outline must be followed closely: there are fibres enough, for all features or for those that there are.
    fn must_be_close(&self, fibers: usize) -> bool {
        let should = fibers >= ALL_CLOSE_FROM
            || fibers >= CLOSE_FROM
                && !*self.has_fine_features.get_or_init(|| self.whole.has_narrow_parts(FINE * self.height));
        should && !self.lenient.get()
    }

    /// The fewest edges that good angles need, of those at a few spacings; at most `most`. Once some are found, no more
    /// than [`budget::EFFORT`] is spent on fewer, and no more than a part of all work on any.
    pub fn least_edges(&self, asked: usize, most: usize) -> Option<usize> {
        let mut least = None;
        self.spent.set(0);
        let enough = self.budget.after_share(LEAST_SHARE);
        // From a coarse following of the outline, which needs the fewest, to a close one.
        for (stray, area) in STRAYS.into_iter().zip(AREAS).rev() {
            let close = Closeness { stray: stray * self.height, area };
            // From a spacing that is far too coarse for the count to the even one of many times as many.
            for k in (-7..4).rev() {
                if self.budget.exceeds(enough) {
                    return least;
                }
                if least.is_some() && self.spent.get() > budget::EFFORT {
                    return least;
                }
                let h = self.even(asked) * 1.5_f64.powi(k);
                let limit = least.unwrap_or(most);
                self.spend(self.vertices);
                let Some(nodes) = most_nodes(self.rim.outline, limit) else { return least };
                let bends = self.bends(h);
                let Some(boundary) = self.sample(&bends, Extra::default(), close, nodes) else { continue };
                let Some(mut refiner) = self.refiner(&boundary, h, FILLS[0]) else { continue };
                let good = refiner.run_angles(limit).is_some();
                self.spend(refiner.edges());
                self.budget.spend(REFINE_WORK * refiner.edges());
                if good {
                    least = Some(least.unwrap_or(usize::MAX).min(refiner.edges()));
                }
            }
        }
        least
    }
}

fn vertices(outline: &Outline) -> usize {
    outline.polygons().map(<[Point]>::len).sum()
}

fn height(outline: &Outline) -> f64 {
    let (low, high) = outline.bounding_box();
    high[1] - low[1]
}

/// The edge length at which equilateral triangles fill the area and the boundary with `fibers` edges in all:
/// `2 E = 3 T + B` with `T = A / (sqrt(3)/4 h^2)` and `B = P / h`, solved for `h`.
pub(super) fn even_spacing(outline: &Outline, fibers: usize) -> f64 {
    let a = 4.0 * 3.0_f64.sqrt() * outline.area();
    let p = outline.perimeter();
    let e2 = 2.0 * fibers.max(1) as f64;
    (p + (p * p + 4.0 * a * e2).sqrt()) / (2.0 * e2)
}
