//! The layouts that are alive: how they begin, what becomes of them.

use super::proposal::Paper;
use crate::random::Random;
use crate::rigging::annealing::{Annealing, Cooling};
use crate::rigging::kinds;
use crate::rigging::layout::Layout;
use crate::rigging::linear_score::Linear;
use crate::rigging::moves::{Sampler, Topology};
use crate::rigging::prune::{PRICE, without_a_point, without_a_tendon};
use crate::rigging::refine::{Fit, KEPT, Task};
use crate::threads::in_order;
use std::ops::Range;
use std::sync::atomic::AtomicBool;

/// Layouts that are alive, all of different kind.
pub(super) const ALIVE: usize = 8;
/// Layouts begun in a batch, each annealed in the linear model.
const BEGUN: usize = 4;
/// In the first few, after each of which something is shown.
const FIRST: usize = 2;
const SMALL: usize = 3;
const COOLING: Cooling = Cooling { steps: 400, hot: 0.1, cold: 0.02 };
/// Children of each layout in a round.
const CHILDREN: usize = 2;
/// Steps of improvement: of a new layout, of a child.
const STEPS: usize = 20;
const CHILD_STEPS: usize = 10;

/// Improvements at most until a layout from elsewhere can be sewn.
const MOVES: usize = 3;
/// What may be left out of a layout is tried so often.
const TRIES: usize = 5;

/// Where a layout came from.
pub(super) type Origin = Paper;
type Stop<'s> = &'s (dyn Fn() -> bool + Sync);

pub(super) struct Pool<'a> {
    task: &'a Task<'a>,
    sampler: &'a Sampler<'a>,
    /// In which layouts are annealed before they are tried for the first time.
    model: Option<Linear<'a>>,
    topology: Topology,
    seed: u64,
    alive: Vec<(Fit, Origin)>,
}

impl<'a> Pool<'a> {
    pub fn new(
        task: &'a Task<'a>,
        sampler: &'a Sampler<'a>,
        topology: Topology,
        seed: u64,
        cancel: &AtomicBool,
    ) -> Self {
        let model = Linear::at_goals(task, cancel).or_else(|| Linear::at_rest(task));
        Self { task, sampler, model, topology, seed, alive: Vec::new() }
    }

    /// Begins new layouts.
    pub fn begin(&mut self, batch: usize, stop: Stop) {
        let numbers: Vec<usize> = (0..if batch < SMALL { FIRST } else { BEGUN }).map(|k| batch * BEGUN + k).collect();
        let begun = in_order(&numbers, |&number| self.begun(number, stop));
        begun.into_iter().flatten().for_each(|fit| self.offer(fit, None));
    }

    fn begun(&self, number: usize, stop: Stop) -> Option<Fit> {
        let random = &mut Random::of(self.seed, "proposal", number as u64);
        // Every number of tendons has its turn.
        let [fewest, most] = self.topology.tendons[0];
        let count = most - number % (most - fewest + 1);
        let topology = Topology { tendons: vec![[count; 2]], ..self.topology.clone() };
        let (task, sampler) = (self.task, self.sampler);
        let layout = sampler.layout(&topology, random);
        let begin = |layout| task.begin(layout, stop);
        let begun = match &self.model {
            None => begin(layout),
            Some(linear) => {
                Annealing { task, sampler, topology: &topology, linear, stop }.fit(layout, COOLING, random, begin)
            }
        };
        self.improved(begun?, STEPS, stop)
    }

    fn improved(&self, fit: Fit, steps: usize, stop: Stop) -> Option<Fit> {
        self.task.wound(self.task.improve(fit, steps, false, stop), steps, stop)
    }

    /// A layout from elsewhere, moved until it can be sewn.
    pub fn take(&mut self, (layout, origin): (Layout, Origin), stop: Stop) {
        let Some(mut fit) = self.task.begin(layout, stop) else { return };
        for _ in 0..MOVES {
            let Some(moved) = self.improved(fit, STEPS, stop) else { return };
            fit = moved;
            if fit.violation <= KEPT {
                break;
            }
        }
        self.offer(fit, origin);
    }

    /// Every layout has children.
    pub fn advance(&mut self, round: usize, stop: Stop) {
        let numbers: Vec<usize> = (0..self.alive.len() * CHILDREN).collect();
        let children = in_order(&numbers, |&k| {
            let parent = &self.alive[k / CHILDREN].0;
            let number = round * ALIVE * CHILDREN + k;
            let random = &mut Random::of(self.seed, "proposal's child", number as u64);
            let (task, sampler, topology) = (self.task, self.sampler, &self.topology);
            let resume = |layout| task.resume(layout, parent, stop);
            let mut layout = parent.layout.clone();
            // One child is annealed around what its parent reaches, the others are as they come.
            let begun = match k.is_multiple_of(CHILDREN).then(|| Linear::at(task, parent)).flatten() {
                Some(linear) => Annealing { task, sampler, topology, linear: &linear, stop }.fit(
                    layout,
                    Cooling::AROUND,
                    random,
                    resume,
                ),
                None => {
                    for _ in 0..=random.index(2) {
                        layout = sampler.changed(&layout, topology, random);
                    }
                    resume(layout)
                }
            };
            self.improved(begun?, CHILD_STEPS, stop)
        });
        if stop() {
            return;
        }
        let parents: Vec<Origin> = self.alive.iter().map(|(_, origin)| origin.clone()).collect();
        for (k, child) in children.into_iter().enumerate() {
            if let Some(child) = child {
                self.offer(child, parents[k / CHILDREN].clone());
            }
        }
    }

    /// Points and tendons that cost little are left out of some.
    pub fn thin(&mut self, some: Range<usize>, stop: Stop) {
        let some = some.start.min(self.alive.len())..some.end.min(self.alive.len());
        let fits: Vec<Fit> = self.alive[some.clone()].iter().map(|(fit, _)| fit.clone()).collect();
        let thinned = in_order(&fits, |fit| self.thinned(fit.clone(), stop));
        for (k, fit) in some.zip(thinned) {
            self.alive[k].0 = fit;
        }
    }

    /// A tendon, then points are left out, one after the other, each as far as that costs little.
    fn thinned(&self, mut now: Fit, stop: Stop) -> Fit {
        let mut place = 0;
        for _ in 0..TRIES {
            let fewer = [without_a_tendon, without_a_point].iter().flat_map(|fewer| fewer(&now.layout, &self.topology));
            let Some((layout, _)) = fewer.into_iter().nth(place) else { break };
            let begun = self.task.resume(layout, &now, stop);
            let new = begun.and_then(|fit| self.improved(fit, CHILD_STEPS, stop));
            let allowed = now.violation.max(KEPT);
            match new.filter(|new| new.worst() <= (1.0 + PRICE) * now.worst() && new.violation <= allowed) {
                Some(new) => (now, place) = (new, 0),
                None => place += 1,
            }
        }
        now
    }

    /// One of its kind, where it is the best, is alive.
    fn offer(&mut self, fit: Fit, origin: Origin) {
        let apart = kinds::APART * self.task.design.body_length_mm();
        let alike = |known: &Fit| kinds::distance(&known.layout, &fit.layout) < apart;
        if !fit.cost.is_finite() || self.alive.iter().any(|(known, _)| alike(known) && known.cost <= fit.cost) {
            return;
        }
        self.alive.retain(|(known, _)| !alike(known));
        self.alive.push((fit, origin));
        self.alive.sort_by(|a, b| a.0.cost.total_cmp(&b.0.cost));
        self.alive.truncate(ALIVE);
    }

    /// The best that can be sewn.
    pub fn best(&self, count: usize) -> Vec<(Fit, Origin)> {
        self.alive.iter().filter(|(fit, _)| fit.violation <= KEPT).take(count).cloned().collect()
    }

    /// Some of those that can be sewn.
    pub fn some(&self, some: Range<usize>) -> Vec<(Fit, Origin)> {
        let chosen = self.alive.iter().skip(some.start).take(some.len());
        chosen.filter(|(fit, _)| fit.violation <= KEPT).cloned().collect()
    }
}
