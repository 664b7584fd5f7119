//! All winches together: a population of layouts, changed at random, each improved by its exact sensitivities.
//!
//! Random layouts are tried first and the best few kept. In every round each of them has children, by a random change of its own
//! points or by winches of another one; the children are improved ([`Task::improve`]), wound from rest ([`Task::wound`]), and the
//! best of all that differ live on. The work is counted in children, and the same seed gives the same bits for any number of
//! threads.

use super::layout::Layout;
use super::moves::{Ground, Shape};
use super::refine::{Fit, Task};
use super::threads::in_order;
use crate::random::Random;

/// Random layouts at the beginning, and those of them that are looked at closely.
const FIRST: usize = 96;
const CLOSELY: usize = 12;
/// Layouts that live on.
const POPULATION: usize = 5;
/// Children of a round.
const CHILDREN: usize = 10;
/// Steps of improvement: of a first look, of a child, of the last one.
const LOOK: usize = 4;
const STEPS: usize = 12;
const LAST_STEPS: usize = 60;
/// Two layouts whose costs differ by less than this part are the same valley.
const SAME: f64 = 1e-3;

/// The search; the best so far is there at any moment.
pub struct Joint<'a> {
    task: &'a Task<'a>,
    ground: &'a Ground<'a>,
    shape: Shape,
    seed: u64,
    round: u64,
    alive: Vec<Fit>,
}

impl<'a> Joint<'a> {
    /// Tries the first layouts: those given, and random ones.
    pub fn new(
        task: &'a Task<'a>,
        ground: &'a Ground<'a>,
        shape: Shape,
        given: Vec<Layout>,
        seed: u64,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Self {
        let mut joint = Self { task, ground, shape, seed, round: 0, alive: Vec::new() };
        let random = |k: usize| joint.ground.layout(&joint.shape, &mut Random::of(seed, "layout", k as u64));
        let layouts: Vec<Layout> = given.into_iter().chain((0..FIRST).map(random)).collect();
        let looked = in_order(&layouts, |layout| {
            let begun = task.begin(layout.clone(), stop)?;
            Some(task.improve(begun, LOOK, false, stop))
        });
        let mut looked: Vec<Fit> = looked.into_iter().flatten().collect();
        looked.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        looked.truncate(CLOSELY);
        let closely = in_order(&looked, |fit| task.wound(task.improve(fit.clone(), STEPS, false, stop), STEPS, stop));
        joint.keep(closely.into_iter().flatten().collect());
        joint
    }

    /// One more round. Does nothing where no layout was found.
    pub fn advance(&mut self, stop: &(dyn Fn() -> bool + Sync)) {
        self.round += 1;
        let count = self.alive.len();
        if count == 0 {
            return;
        }
        let children: Vec<(usize, Layout)> = (0..CHILDREN)
            .map(|k| {
                let random = &mut Random::of(self.seed, "child", self.round * CHILDREN as u64 + k as u64);
                let parent = k % count;
                let mut layout = self.alive[parent].layout.clone();
                if random.index(6) == 0 {
                    layout = self.ground.crossed(&layout, &self.alive[random.index(count)].layout, random);
                }
                for _ in 0..=random.index(2) {
                    layout = self.ground.changed(&layout, &self.shape, random);
                }
                (parent, layout)
            })
            .collect();
        let (task, alive) = (self.task, &self.alive);
        let tried = in_order(&children, |(parent, layout)| {
            let begun = task.resume(layout.clone(), &alive[*parent], stop)?;
            task.wound(task.improve(begun, STEPS, false, stop), STEPS, stop)
        });
        if !stop() {
            self.keep(tried.into_iter().flatten().collect());
        }
    }

    fn keep(&mut self, new: Vec<Fit>) {
        self.alive.extend(new);
        self.alive.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        self.alive.dedup_by(|a, b| (a.cost - b.cost).abs() <= SAME * b.cost);
        self.alive.truncate(POPULATION);
    }

    /// The best layouts so far, the best first; every pose wound from rest.
    pub fn alive(&self) -> &[Fit] {
        &self.alive
    }

    /// The best so far, improved as far as it goes.
    pub fn finished(&self, stop: &dyn Fn() -> bool) -> Option<Fit> {
        let best = self.alive.first()?;
        let last = self.task.improve(best.clone(), LAST_STEPS, false, stop);
        let wound = self.task.wound(last, LAST_STEPS, stop);
        wound.filter(|fit| fit.cost < best.cost).or_else(|| Some(best.clone()))
    }
}
