//! The meshes that are tried for one closeness: boundary spacings about the even one, each finished and checked.

use super::budget::{REFINE_WORK, SMOOTH_WORK, VERTEX_WORK};
use super::found_mesh::FoundMesh;
use super::subject::{Subject, most_nodes};
use crate::mesh::boundary::Boundary;
use crate::mesh::order::order;
use crate::mesh::quality::MeshQuality;
use crate::mesh::refine::{Fill, Refiner};
use crate::mesh::sample::{Bends, Closeness, Extra, sample};
use crate::mesh::smooth::Sliding;
use crate::mesh::symmetry::unfold;
use crate::mesh::{Mesh, smooth, tracks};

/// Boundary spacings tried, relative to the evenly dense one.
const SPACINGS: [f64; 18] =
    [1.0, 1.08, 0.94, 1.16, 1.24, 1.04, 1.12, 1.2, 0.97, 1.02, 1.06, 1.1, 1.14, 1.18, 0.91, 1.3, 1.37, 1.5];
/// How the nodes inside are shared out, tried in turn while the body is one triangle across somewhere: a coarser trunk leaves
/// more nodes for the limbs.
pub(super) const FILLS: [Fill; 3] = [
    Fill { coarsest: 1.25, limbs: 1.35, narrow: 1.0, poor_deg: 23.0 },
    Fill { coarsest: 1.25, limbs: 1.35, narrow: 1.5, poor_deg: 23.0 },
    Fill { coarsest: 1.6, limbs: 1.8, narrow: 1.25, poor_deg: 23.0 },
];
/// How they are shared out where the boundary takes so many that none are left for better angles than must be.
const SPARING: Fill = Fill { poor_deg: 20.3, ..FILLS[0] };
/// Number of spacings tried with it, from the even one to coarser ones.
const SPARING_TRIES: i32 = 5;
/// Attempts times fibres after which the best mesh so far is taken if it is good, and the fewest and most attempts: some
/// tens of milliseconds.
const PATIENCE: usize = 24_000;
const LEAST_TRIES: usize = 1;
const MOST_TRIES: usize = 54;
/// Edges that smoothing and measuring a mesh weigh, for each that it has.
const SMOOTHING: usize = 3;
/// Times the area that the closeness allows to be lost or won: what nodes sliding along the boundary may add to it.
const AREA_SLACK: f64 = 1.04;
/// How far the number of edges may be from the asked one where no mesh has it exactly.
const COUNT_FRACTION: f64 = 0.03;
/// Number of spacings tried where the boundary alone has too many edges at those, and the factor from one to the next.
const COARSER: i32 = 12;
const COARSENING: f64 = 1.25;

impl<'a> Subject<'a> {
    /// Tries boundary spacings about the even one, and coarser ones where the boundary's own features ask for many nodes;
    /// whether a mesh without poor triangles was among them. Once there is one, no more than [`PATIENCE`] are tried, and
    /// none once `effort` is spent.
    pub(super) fn search(
        &self,
        even: f64,
        fibers: usize,
        close: Closeness,
        effort: usize,
        found: &mut Vec<FoundMesh>,
    ) -> bool {
        let mut patience = (PATIENCE / fibers.max(1)).clamp(LEAST_TRIES, MOST_TRIES);
        let good = |found: &[FoundMesh]| found.iter().any(FoundMesh::is_good);
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
    fn attempt(&self, bends: &Bends, fill: Fill, fibers: usize, close: Closeness) -> Option<FoundMesh> {
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

    pub(super) fn spend(&self, work: usize) {
        self.spent.set(self.spent.get().saturating_add(work));
    }

    pub(super) fn bends(&self, h: f64) -> Bends<'a> {
        let bends = Bends::new(self.rim, h);
        self.budget.spend(VERTEX_WORK * self.vertices + bends.size());
        bends
    }

    pub(super) fn sample(&self, bends: &Bends, extra: Extra, close: Closeness, most: usize) -> Option<Boundary> {
        sample(bends, extra, close, most, &self.budget)
    }

    pub(super) fn refiner(&self, boundary: &Boundary, h: f64, fill: Fill) -> Option<Refiner<'a>> {
        // The next attempts mostly have the same spacing.
        let mut sampled = self.sampled.borrow_mut();
        let known = sampled.take().filter(|(spacing, _)| *spacing == h);
        let (_, tracks) =
            sampled.insert(known.unwrap_or_else(|| (h, tracks::sample(self.tracks, self.whole, h, &self.budget))));
        let tracks = tracks.as_ref()?;
        Refiner::new(boundary, tracks, self.rim.curves, self.axis.is_some(), h, fill)
    }

    /// Smooths, and checks what came out.
    fn finish(&self, refiner: Refiner, close: Closeness) -> Option<FoundMesh> {
        let Refiner { mut tri, places, .. } = refiner;
        self.spend(SMOOTHING * tri.edges());
        self.budget.spend(SMOOTH_WORK * tri.edges());
        let mirror = self.axis.is_some();
        let mut rim = Sliding { places, curves: self.rim.curves, stray: close.stray, mirror };
        smooth::smooth(&mut tri, &mut rim);
        let mut mesh = Mesh { nodes: tri.points, triangles: tri.corners };
        order(&mut mesh.triangles);
        if let Some(axis) = self.axis {
            let (low, high) = self.whole.bounding_box();
            mesh = unfold(&mesh, axis, (high[0] - low[0]).max(high[1] - low[1]));
        }
        let quality = MeshQuality::of(&mesh);
        let lost = (mesh.area() / self.whole.area() - 1.0).abs();
        let sound = quality.below_5_deg == 0 && lost < AREA_SLACK * close.area && mesh.validate().is_ok();
        sound.then(|| FoundMesh::new(mesh, quality))
    }
}

/// Whether a count is as good as the asked one.
fn within(count: usize, asked: usize) -> bool {
    count.abs_diff(asked) as f64 <= COUNT_FRACTION * asked as f64
}
