//! How much work a search may take, counted and not timed, so that the same outline gives the same bits on every machine.

use std::cell::Cell;

/// Most work for one mesh, in vertices, nodes and edges handled: some tenths of a second. Then the best mesh so far is
/// taken, good or not.
pub(super) const EFFORT: usize = 300_000;
/// Most work in samplings of large meshes, of which one alone may take as much.
const LEAST_SAMPLINGS: usize = 12;
/// Most work for all that is tried of an outline, the search for a possible count included, in units of about 0.1 us: some
/// seconds, which only outlines with hundreds of holes need. Then what was found is taken, or the outline is refused.
/// [`EFFORT`] weighs neither how finely the boundary is sampled nor how often a count is tried; this does.
const WORK: usize = 100_000_000;
/// Such units for each fibre asked for.
const WORK_PER_FIBER: usize = 1000;
/// Units for a vertex of the outline when bends are looked for, for an edge that is refined, and one that is smoothed.
pub(super) const VERTEX_WORK: usize = 4;
pub(super) const REFINE_WORK: usize = 20;
pub(super) const SMOOTH_WORK: usize = 40;

/// Work done altogether, and the most of it, in the units of [`WORK`].
pub(in crate::mesh) struct WorkBudget {
    done: Cell<usize>,
    most: usize,
    /// Whether something was given up for it.
    missed: Cell<bool>,
}

impl WorkBudget {
    /// Where so many fibres are asked for.
    pub fn new(fibers: usize) -> Self {
        Self { done: Cell::new(0), most: WORK + WORK_PER_FIBER * fibers, missed: Cell::new(false) }
    }

    pub fn spend(&self, work: usize) {
        self.done.set(self.done.get().saturating_add(work));
    }

    /// The work that is done when, from now on, this part of all work is spent.
    pub fn after_share(&self, part: f64) -> usize {
        self.done.get() + (part * self.most as f64) as usize
    }

    /// Whether more than `share` is done; what is given up for it counts as missed.
    pub fn exceeds(&self, share: usize) -> bool {
        let exceeds = self.done.get() > share;
        self.missed.set(self.missed.get() || exceeds);
        exceeds
    }

    /// Whether no more work is allowed.
    pub fn is_exhausted(&self) -> bool {
        self.exceeds(self.most)
    }

    /// Whether something was given up for it.
    pub fn was_short(&self) -> bool {
        self.missed.get()
    }
}

/// How much work a search may take.
#[derive(Clone, Copy, Debug)]
pub(in crate::mesh) enum Thoroughness {
    Full,
    /// A quarter: for one of several counts. What is found with it is found with all of it too.
    Little,
}

impl Thoroughness {
    /// The most work for one mesh of an outline and fibres of this size together.
    pub fn most(self, size: usize) -> usize {
        match self {
            Self::Full => EFFORT.max(LEAST_SAMPLINGS * size),
            Self::Little => (EFFORT / 4).max(LEAST_SAMPLINGS / 3 * size),
        }
    }
}
