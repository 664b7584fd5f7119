//! The search for the best mesh of a given number of edges.
//!
//! A triangulation with `B` boundary nodes, `I` interior nodes and `H` holes has `E = 2 B + 3 I - 3 + 3 H` edges (Euler:
//! `V - E + T = 1 - H`, and `3 T = 2 E - B`). So once the boundary is sampled, nodes are added until the count is there; a
//! node or two more on the boundary make the division by three come out. Two mirrored halves with `A` edges on the axis
//! have `2 E - A`, and a node more on the axis plays its part. What is searched is the spacing along the boundary, among
//! a few about the one at which boundary and interior would be equally dense, and how closely the outline is followed.

use super::curve::Curve;
use super::quality::{Fit, Quality};
use super::refine::{Fill, Refiner};
use super::sample::{Bends, Boundary, Closeness, Extra, Rim, sample};
use super::smooth::Sliding;
use super::symmetry::{Axis, Half, unfold};
use super::tracks::Sampled;
use super::{Mesh, generate, smooth, tracks};
use crate::outline::{Outline, Point};
use std::cell::{Cell, OnceCell, RefCell};

/// Boundary spacings tried, relative to the evenly dense one.
const SPACINGS: [f64; 18] =
    [1.0, 1.08, 0.94, 1.16, 1.24, 1.04, 1.12, 1.2, 0.97, 1.02, 1.06, 1.1, 1.14, 1.18, 0.91, 1.3, 1.37, 1.5];
/// How the nodes inside are shared out, tried in turn while the body is one triangle across somewhere: a coarser trunk leaves
/// more nodes for the limbs.
const FILLS: [Fill; 3] = [
    Fill { coarsest: 1.25, limbs: 1.35, narrow: 1.0, poor_deg: 23.0 },
    Fill { coarsest: 1.25, limbs: 1.35, narrow: 1.5, poor_deg: 23.0 },
    Fill { coarsest: 1.6, limbs: 1.8, narrow: 1.25, poor_deg: 23.0 },
];
/// The same where the boundary takes so many that none are left for better angles than must be.
const SPARING: Fill = Fill { poor_deg: 20.3, ..FILLS[0] };
/// Number of spacings tried with it, from the even one to coarser ones.
const SPARING_TRIES: i32 = 5;
/// Attempts times fibres after which the best mesh so far is taken if it is good, and the fewest and most attempts: some
/// tens of milliseconds.
const PATIENCE: usize = 24_000;
const LEAST_TRIES: usize = 1;
const MOST_TRIES: usize = 54;
/// Most work for one mesh, in vertices, nodes and edges handled: some tenths of a second. Then the best mesh so far is
/// taken, good or not. Counted and not timed, so that the same outline gives the same bits on every machine.
const EFFORT: usize = 300_000;
/// The same in samplings of large meshes, of which one alone may take as much.
const LEAST_SAMPLINGS: usize = 12;
/// Edges that smoothing and measuring a mesh weigh, for each that it has.
const SMOOTHING: usize = 3;
/// Most work for all that is tried of an outline, the search for a possible count included, in units of about 0.1 us: some
/// seconds, which only outlines with hundreds of holes need. Then what was found is taken, or the outline is refused.
/// [`EFFORT`] weighs neither how finely the boundary is sampled nor how often a count is tried; this does.
const WORK: usize = 100_000_000;
/// The same for each fibre asked for.
const WORK_PER_FIBER: usize = 1000;
/// The part of it for finding out how many edges good angles need.
const LEAST_SHARE: f64 = 0.4;
/// Units for a vertex of the outline when bends are looked for, for an edge that is refined, and one that is smoothed.
const VERTEX_WORK: usize = 4;
const REFINE_WORK: usize = 20;
const SMOOTH_WORK: usize = 40;
/// A mesh without bridges and with no angle below this is taken at once, degrees.
const FINE_DEG: f64 = 30.5;
/// Farthest that a chord may stray from the outline, as fractions of its height, tried in turn: with few fibres fine features
/// are rounded off rather than refused.
const STRAYS: [f64; 4] = [0.0047, 0.008, 0.016, 0.03];
/// How near, as a part of the height, the boundary must be to an outline without such features.
const CLOSE: f64 = 0.005;
/// How near its area must be, as a part.
const CLOSE_AREA: f64 = 0.01;
/// Limbs and gaps thinner than this part of the height are such features.
const FINE: f64 = 0.03;
/// Fibres from which following the outline goes before limbs that are two triangles across.
const CLOSE_FROM: usize = 400;
/// Fibres from which fine features are followed as well.
const ALL_CLOSE_FROM: usize = 2000;
/// Area that the mesh may lose or win at each of those, as a fraction.
const AREAS: [f64; 4] = [0.0095, 0.0095, 0.0095, 0.03];
/// How much of that nodes sliding along the boundary may add.
const AREA_SLACK: f64 = 1.04;
/// How far the number of edges may be from the asked one where no mesh has it exactly.
const COUNT_FRACTION: f64 = 0.03;
/// Number of spacings tried where the boundary alone has too many edges at those, and the factor from one to the next.
const COARSER: i32 = 12;
const COARSENING: f64 = 1.25;

/// The polygons of an outline by arc length.
pub(super) struct Pool<'a>(Vec<Curve<'a>>);

impl<'a> Pool<'a> {
    pub fn of(outline: &'a Outline) -> Self {
        Self(outline.polygons().map(Curve::new).collect())
    }
}

/// What is to be meshed: an outline, or one half of it.
pub(super) struct Subject<'a> {
    /// The whole, for its size and its fit.
    whole: &'a Outline,
    rim: Rim<'a>,
    tracks: &'a [Vec<Point>],
    /// Their nodes at the spacing that was tried last.
    sampled: RefCell<Option<(f64, Option<Sampled>)>>,
    axis: Option<Axis>,
    height: f64,
    /// What is lost of the closeness by taking the image of one half for the other, mm.
    off: f64,
    /// Vertices of the outline.
    vertices: usize,
    /// Work done for the mesh that is sought.
    spent: Cell<usize>,
    budget: Budget,
    has_fine_features: OnceCell<bool>,
    /// Whether an outline may be followed less closely than it should.
    lenient: Cell<bool>,
}

/// Work done altogether, and the most of it, in the units of [`WORK`].
pub(super) struct Budget {
    done: Cell<usize>,
    most: usize,
    /// Whether something was given up for it.
    missed: Cell<bool>,
}

impl Budget {
    pub fn spend(&self, work: usize) {
        self.done.set(self.done.get().saturating_add(work));
    }

    /// Whether no more work is allowed.
    pub fn is_exhausted(&self) -> bool {
        let exhausted = self.done.get() > self.most;
        self.missed.set(self.missed.get() || exhausted);
        exhausted
    }
}

/// How much work a search may take.
#[derive(Clone, Copy, Debug)]
pub(super) enum Effort {
    Full,
    /// A quarter: for one of several counts. What is found with it is found with all of it too.
    Little,
}

struct Candidate {
    mesh: Mesh,
    quality: Quality,
    /// Whether it follows the outline closely, once somebody asked.
    follows: OnceCell<bool>,
}

impl Candidate {
    /// Whether every angle below 20 degrees is one of the outline's own.
    fn is_good(&self) -> bool {
        self.quality.below_20_deg == self.quality.corners_below_20_deg
    }

    /// Whether no more than one in a thousand triangles is poor for no fault of the outline.
    fn is_nearly_good(&self) -> bool {
        (self.quality.below_20_deg - self.quality.corners_below_20_deg) * 1000 <= self.quality.triangles
    }

    /// Whether its boundary and its area are close to those of the outline.
    fn follows(&self, outline: &Outline) -> bool {
        *self.follows.get_or_init(|| {
            let fit = Fit::of(&self.mesh, outline);
            fit.boundary_fraction <= CLOSE && fit.area_error.abs() <= CLOSE_AREA
        })
    }

    /// Whether no better one need be sought.
    fn is_fine(&self, fibers: usize) -> bool {
        let q = &self.quality;
        q.edges == fibers && q.bridges == 0 && q.min_angle_deg > FINE_DEG
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
            budget: Budget { done: Cell::new(0), most: WORK + WORK_PER_FIBER * fibers, missed: Cell::new(false) },
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
        self.budget.missed.get()
    }

    /// The spacing at which boundary and interior are equally dense.
    pub fn even(&self, fibers: usize) -> f64 {
        even_spacing(self.whole, fibers)
    }

    /// The best mesh found with `fibers` edges, or nearly.
    pub fn mesh(&self, even: f64, fibers: usize, effort: Effort) -> Option<(Mesh, Quality)> {
        let mut found = Vec::new();
        let effort = match effort {
            Effort::Full => EFFORT.max(LEAST_SAMPLINGS * (self.vertices + fibers)),
            Effort::Little => (EFFORT / 4).max(LEAST_SAMPLINGS / 3 * (self.vertices + fibers)),
        };
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
                && !*self.has_fine_features.get_or_init(|| self.whole.narrow_parts(FINE * self.height) > 0);
        should && !self.lenient.get()
    }

    /// The fewest edges that good angles need, of those at a few spacings; at most `most`. Once some are found, no more
    /// than [`EFFORT`] is spent on fewer, and no more than a part of all work on any.
    pub fn least_edges(&self, asked: usize, most: usize) -> Option<usize> {
        let mut least = None;
        self.spent.set(0);
        let enough = self.budget.done.get() + (LEAST_SHARE * self.budget.most as f64) as usize;
        // From a coarse following of the outline, which needs the fewest, to a close one.
        for (stray, area) in STRAYS.into_iter().zip(AREAS).rev() {
            let close = Closeness { stray: stray * self.height, area };
            // From a spacing that is far too coarse for the count to the even one of many times as many.
            for k in (-7..4).rev() {
                if self.budget.done.get() > enough {
                    self.budget.missed.set(true);
                    return least;
                }
                if least.is_some() && self.spent.get() > EFFORT {
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

    /// Tries boundary spacings about the even one, and coarser ones where the boundary's own features ask for many nodes;
    /// whether a mesh without poor triangles was among them. Once there is one, no more than [`PATIENCE`] are tried, and
    /// none once `effort` is spent.
    fn search(&self, even: f64, fibers: usize, close: Closeness, effort: usize, found: &mut Vec<Candidate>) -> bool {
        let mut patience = (PATIENCE / fibers.max(1)).clamp(LEAST_TRIES, MOST_TRIES);
        let good = |found: &[Candidate]| found.iter().any(Candidate::is_good);
        let before = found.len();
        let over = || self.spent.get() > effort || self.is_exhausted();
        'tried: for factor in SPACINGS {
            let mut bends = None;
            for fill in FILLS {
                if over() || (patience == 0 && good(found)) {
                    return good(found);
                }
                patience = patience.saturating_sub(1);
                let bends = bends.get_or_insert_with(|| self.bends(factor * even));
                let candidate = self.attempt(bends, fill, fibers, close);
                if candidate.is_none() && found.len() == before {
                    // Not even at the spacing meant for it: there is no need to look closely.
                    break 'tried;
                }
                found.extend(candidate);
                if found.last().is_some_and(|c| c.is_fine(fibers)) {
                    found.drain(..found.len() - 1);
                    return true;
                }
            }
        }
        for k in 1..=COARSER {
            if over() || good(found) {
                break;
            }
            found.extend(self.attempt(&self.bends(even * COARSENING.powi(k)), FILLS[0], fibers, close));
        }
        for k in 0..SPARING_TRIES {
            if over() || good(found) {
                break;
            }
            found.extend(self.attempt(&self.bends(even * COARSENING.powi(k)), SPARING, fibers, close));
        }
        good(found)
    }

    /// A mesh at a boundary spacing, if there is one with the asked count, or nearly.
    fn attempt(&self, bends: &Bends, fill: Fill, fibers: usize, close: Closeness) -> Option<Candidate> {
        let mut near: Option<Refiner> = None;
        let own = if self.axis.is_some() { fibers / 2 + fibers / 4 } else { fibers };
        let most = most_nodes(self.rim.outline, own)?;
        let extras = (0..6)
            .map(|k| if self.axis.is_some() { Extra { rim: k / 2, axis: k % 2 } } else { Extra { rim: k, axis: 0 } });
        for extra in extras {
            self.spend(self.vertices);
            let boundary = self.sample(bends, extra, close, most)?;
            let mut refiner = self.refiner(&boundary, bends.h, fill)?;
            let room = refiner.run(fibers);
            self.spend(refiner.tri.edges());
            self.budget.spend(REFINE_WORK * refiner.tri.edges());
            if room.is_none() {
                near.as_ref()?;
                continue;
            }
            if refiner.edges() == fibers {
                return self.finish(refiner, close);
            }
            near = near.or(Some(refiner));
        }
        near.filter(|r| within(r.edges(), fibers)).and_then(|r| self.finish(r, close))
    }

    fn spend(&self, work: usize) {
        self.spent.set(self.spent.get().saturating_add(work));
    }

    fn bends(&self, h: f64) -> Bends<'a> {
        let bends = Bends::new(self.rim, h);
        self.budget.spend(VERTEX_WORK * self.vertices + bends.size());
        bends
    }

    fn sample(&self, bends: &Bends, extra: Extra, close: Closeness, most: usize) -> Option<Boundary> {
        sample(bends, extra, close, most, &self.budget)
    }

    fn refiner(&self, boundary: &Boundary, h: f64, fill: Fill) -> Option<Refiner<'a>> {
        // The next attempts mostly have the same spacing.
        let mut sampled = self.sampled.borrow_mut();
        let known = sampled.take().filter(|(spacing, _)| *spacing == h);
        let (_, tracks) = sampled.insert(known.unwrap_or_else(|| (h, tracks::sample(self.tracks, self.whole, h))));
        let tracks = tracks.as_mut()?;
        self.budget.spend(std::mem::take(&mut tracks.work));
        Refiner::new(boundary, tracks, self.rim.curves, self.axis.is_some(), h, fill)
    }

    /// Smooths, and checks what came out.
    fn finish(&self, refiner: Refiner, close: Closeness) -> Option<Candidate> {
        let Refiner { mut tri, places, .. } = refiner;
        self.spend(SMOOTHING * tri.edges());
        self.budget.spend(SMOOTH_WORK * tri.edges());
        let mirror = self.axis.is_some();
        let mut rim = Sliding { places, curves: self.rim.curves, stray: close.stray, mirror };
        smooth::smooth(&mut tri, &mut rim);
        let mut mesh = Mesh { nodes: tri.points, triangles: tri.corners };
        generate::order(&mut mesh.triangles);
        if let Some(axis) = self.axis {
            let (low, high) = self.whole.bounding_box();
            mesh = unfold(&mesh, axis, (high[0] - low[0]).max(high[1] - low[1]));
        }
        let quality = Quality::of(&mesh);
        let lost = (mesh.area() / self.whole.area() - 1.0).abs();
        let sound = quality.below_5_deg == 0 && lost < AREA_SLACK * close.area && mesh.validate().is_ok();
        sound.then(|| Candidate { mesh, quality, follows: OnceCell::new() })
    }
}

fn vertices(outline: &Outline) -> usize {
    outline.polygons().map(<[Point]>::len).sum()
}

fn height(outline: &Outline) -> f64 {
    let (low, high) = outline.bounding_box();
    high[1] - low[1]
}

/// Boundary nodes of a mesh with `edges` edges: those without an interior node. `None` where the rings cannot have so few.
fn most_nodes(outline: &Outline, edges: usize) -> Option<usize> {
    let rings = outline.holes.len() + 1;
    let most = (edges + 3).checked_sub(3 * outline.holes.len())? / 2;
    (most >= 3 * rings).then_some(most)
}

/// Whether a count is as good as the asked one.
fn within(count: usize, asked: usize) -> bool {
    count.abs_diff(asked) as f64 <= COUNT_FRACTION * asked as f64
}

/// The edge length at which equilateral triangles fill the area and the boundary with `fibers` edges in all:
/// `2 E = 3 T + B` with `T = A / (sqrt(3)/4 h^2)` and `B = P / h`, solved for `h`.
pub(super) fn even_spacing(outline: &Outline, fibers: usize) -> f64 {
    let a = 4.0 * 3.0_f64.sqrt() * outline.area();
    let p = outline.perimeter();
    let e2 = 2.0 * fibers.max(1) as f64;
    (p + (p * p + 4.0 * a * e2).sqrt()) / (2.0 * e2)
}

/// The candidate with the fewest poor triangles, then of the asked count, and among those the one with the least of what
/// else is unwanted: an inner edge across a limb weighs as much as four degrees that the least angle is below a fine one,
/// as ten degrees above, or as edges that differ by a factor of two more.
fn take_best(candidates: &mut Vec<Candidate>, fibers: usize) -> Option<Candidate> {
    let unwanted = |q: &Quality| {
        let angle = 0.1 * q.min_angle_deg - 0.25 * (FINE_DEG - q.min_angle_deg).max(0.0);
        q.bridges as f64 - angle + 0.5 * q.max_edge / q.min_edge
    };
    let order = |a: &Quality, b: &Quality| {
        let other = |q: &Quality| q.edges != fibers;
        let poor = |q: &Quality| q.below_20_deg - q.corners_below_20_deg;
        poor(a).cmp(&poor(b)).then(other(a).cmp(&other(b))).then(unwanted(a).total_cmp(&unwanted(b)))
    };
    let best = (0..candidates.len()).min_by(|&a, &b| order(&candidates[a].quality, &candidates[b].quality))?;
    Some(candidates.remove(best))
}
