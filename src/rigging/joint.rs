//! All winches together: islands of layouts, changed at random, each improved by its exact sensitivities.
//!
//! Random layouts, each annealed for the body linearised where its poses should take it ([`Linear::at_goals`]), are tried first. The best
//! found islands: on each, the best few live, and in every round have children, by a random change of points or by winches of one another.
//! The children are improved ([`Task::improve`]), wound from rest ([`Task::wound`]), and the best that differ live on. Islands do not see each
//! other, so that the first good valley is not everybody's; from time to time the worst one is given up, and peopled anew by the best. Half
//! of the children are annealed for the body linearised around their parent ([`Linear::at`]). Islands that gain nothing any more are left for
//! new ones, and several heats, each on islands of its own, go before ([`super::schedule`]). The work is counted in rounds, and the same seed
//! gives the same bits for any number of threads.

use super::annealing::{Annealing, Cooling};
use super::kinds::{self, APART};
use super::layout::Layout;
use super::linear_score::Linear;
use super::moves::{Sampler, Topology};
use super::refine::{Fit, Start, Task};
use crate::random::Random;
use crate::threads::in_order;
use std::sync::{Arc, OnceLock};

/// Random layouts at the beginning, annealed in the linear model, and those of them that are looked at closely.
const FIRST: Cooling = Cooling { steps: 1000, hot: 0.1, cold: 0.02 };
/// A few before them all, so that there is something to show, and to keep, in a second or two.
const QUICKLY: usize = 8;
const QUICK: Cooling = Cooling { steps: 200, ..FIRST };
const CLOSELY: usize = 16;
/// Layouts that a start begins with: at most, and of a search of few rounds for each of these.
const LAYOUTS: usize = 48;
const LAYOUTS_A_ROUND: usize = 4;
/// Islands, and children of a round on each.
const ISLANDS: usize = 2;
const CHILDREN: usize = 8;
/// Layouts that live on an island.
const ALIVE: usize = 4;
/// Rounds after which the worst island is given up.
const ERA: usize = 25;
/// One child in so many has winches of two parents.
const CROSSED: usize = 6;
/// Most random changes of a child; one more has half the chance of one less.
const MOST_CHANGES: usize = 5;
/// Steps of improvement: of a first look, of a child, of the last one.
const LOOK: usize = 4;
const STEPS: usize = 12;
const LAST_STEPS: usize = 60;
/// A child whose cost is more than so many times that of the worst that lives on its island after the first look is given up: one in
/// ten of those that would have lived, two thirds of the others.
const BEHIND: f64 = 2.0;
/// Two layouts whose costs differ by less than this part are the same valley.
const SAME: f64 = 1e-3;

/// A layout that lives on an island.
#[derive(Clone)]
struct Living<'a> {
    fit: Fit,
    /// The body around what it reaches, once somebody asks.
    around: Arc<OnceLock<Option<Linear<'a>>>>,
}

impl Living<'_> {
    fn new(fit: Fit) -> Self {
        Self { fit, around: Arc::default() }
    }
}

/// The search; the best so far is there at any moment.
pub struct Joint<'a> {
    task: &'a Task<'a>,
    sampler: &'a Sampler<'a>,
    topology: Topology,
    /// Layouts that a start begins with.
    layouts: usize,
    seed: u64,
    round: u64,
    /// In which layouts are annealed before they are tried for the first time.
    model: Option<Linear<'a>>,
    islands: Vec<Vec<Living<'a>>>,
    /// Islands were peopled so often before.
    peopled: u64,
    /// The best of the islands of earlier heats.
    heats: Vec<Fit>,
    /// The best of islands that were left for good, and of all heats.
    remembered: Vec<Fit>,
}

impl<'a> Joint<'a> {
    /// Tries the first layouts, annealed in the model.
    pub fn new(
        task: &'a Task<'a>,
        sampler: &'a Sampler<'a>,
        topology: Topology,
        (rounds, seed): (usize, u64),
        model: Option<Linear<'a>>,
        stop: &(dyn Fn() -> bool + Sync),
    ) -> Self {
        let mut joint = Self {
            task,
            sampler,
            topology,
            layouts: LAYOUTS.min(LAYOUTS_A_ROUND * rounds),
            seed,
            round: 0,
            model,
            islands: Vec::new(),
            peopled: 0,
            heats: Vec::new(),
            remembered: Vec::new(),
        };
        joint.people(QUICKLY, QUICK, stop);
        joint.heat(stop);
        joint
    }

    /// Peoples the islands.
    fn people(&mut self, layouts: usize, cooling: Cooling, stop: &(dyn Fn() -> bool + Sync)) {
        let (task, sampler, topology) = (self.task, self.sampler, &self.topology);
        let numbers: Vec<u64> = (0..layouts as u64).map(|k| (self.peopled << 32) + k).collect();
        let looked = in_order(&numbers, |&number| {
            if stop() {
                return None;
            }
            let random = &mut Random::of(self.seed, "layout", number);
            let layout = sampler.layout(topology, random);
            let begin = |layout| task.begin(layout, stop);
            let begun = match &self.model {
                None => begin(layout),
                Some(linear) => {
                    Annealing { task, sampler, topology, linear, stop: &stop }.fit(layout, cooling, random, begin)
                }
            };
            Some(task.improve(begun?, LOOK, false, stop))
        });
        let mut looked: Vec<Fit> = looked.into_iter().flatten().collect();
        looked.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        looked.truncate(CLOSELY);
        let closely = in_order(&looked, |fit| task.wound(task.improve(fit.clone(), STEPS, false, stop), STEPS, stop));
        let mut closely: Vec<Fit> = closely.into_iter().flatten().collect();
        closely.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        self.spread(closely);
        self.peopled += 1;
    }

    /// Peoples the islands by these, best first, one after the other.
    fn spread(&mut self, sorted: Vec<Fit>) {
        let count = ISLANDS.min(sorted.len());
        self.islands = vec![Vec::new(); count];
        for (k, fit) in sorted.into_iter().enumerate() {
            self.islands[k % count].push(Living::new(fit));
        }
        self.islands.iter_mut().for_each(keep);
    }

    /// Leaves the islands for new ones, with another task and sampler where the rules are others there. The best are remembered.
    pub fn leave(
        &mut self,
        task: &'a Task<'a>,
        sampler: &'a Sampler<'a>,
        topology: Topology,
        stop: &(dyn Fn() -> bool + Sync),
    ) {
        self.end_heat();
        self.remembered.append(&mut self.heats);
        (self.task, self.sampler, self.topology) = (task, sampler, topology);
        self.people(self.layouts, FIRST, stop);
    }

    /// Leaves the islands for new ones until [`Self::gather`].
    pub fn heat(&mut self, stop: &(dyn Fn() -> bool + Sync)) {
        self.end_heat();
        self.people(self.layouts, FIRST, stop);
    }

    /// The islands are peopled by the best of all heats and of the present ones.
    pub fn gather(&mut self) {
        self.end_heat();
        let mut all = std::mem::take(&mut self.heats);
        all.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        all.dedup_by(|a, b| is_same(a, b));
        self.remembered.extend(all.iter().cloned());
        self.spread(all);
    }

    fn end_heat(&mut self) {
        self.heats.extend(self.islands.iter().filter_map(|island| Some(island.first()?.fit.clone())));
    }

    /// One more round. Does nothing where no layout was found.
    pub fn advance(&mut self, stop: &(dyn Fn() -> bool + Sync)) {
        self.round += 1;
        if (self.round as usize).is_multiple_of(ERA) {
            self.give_up();
        }
        let places: Vec<(usize, usize)> =
            (0..self.islands.len()).flat_map(|island| (0..CHILDREN).map(move |k| (island, k))).collect();
        let tried = in_order(&places, |&(island, k)| Some((island, self.child(island, k, stop)?)));
        if stop() {
            return;
        }
        for (island, fit) in tried.into_iter().flatten() {
            self.islands[island].push(Living::new(fit));
        }
        self.islands.iter_mut().for_each(keep);
    }

    /// The child number `k` of a round on an island; `None` where it is far behind those that live there.
    fn child(&self, island: usize, k: usize, stop: &dyn Fn() -> bool) -> Option<Fit> {
        let (task, living) = (self.task, &self.islands[island]);
        let number = (self.round * ISLANDS as u64 + island as u64) * CHILDREN as u64 + k as u64;
        let random = &mut Random::of(self.seed, "child", number);
        // Each parent has one child that is annealed and one that is not.
        let parent = &living[k / 2 % living.len()];
        let resume = |layout| task.resume(layout, &parent.fit, stop);
        let around = || parent.around.get_or_init(|| Linear::at(task, &parent.fit)).as_ref();
        let begun = match k.is_multiple_of(2).then(around).flatten() {
            None => resume(self.varied(&parent.fit.layout, living, random)),
            Some(linear) => {
                let layout = self.crossed(&parent.fit.layout, living, random);
                let (sampler, topology) = (self.sampler, &self.topology);
                Annealing { task, sampler, topology, linear, stop }.fit(layout, Cooling::AROUND, random, resume)
            }
        }?;
        let looked = task.improve(begun, LOOK, false, stop);
        // Most children are far behind by now, and would stay there.
        let behind = living.last().is_some_and(|last| looked.cost > BEHIND * last.fit.cost);
        task.wound((!behind).then(|| task.improve(looked, STEPS, false, stop))?, STEPS, stop)
    }

    /// A layout after random changes, perhaps with winches of another one.
    fn varied(&self, layout: &Layout, living: &[Living], random: &mut Random) -> Layout {
        let mut layout = self.crossed(layout, living, random);
        for _ in 0..MOST_CHANGES {
            layout = self.sampler.changed(&layout, &self.topology, random);
            if random.index(2) == 0 {
                break;
            }
        }
        layout
    }

    /// A layout, now and then with winches of another one.
    fn crossed(&self, layout: &Layout, living: &[Living], random: &mut Random) -> Layout {
        if random.index(CROSSED) > 0 {
            return layout.clone();
        }
        self.sampler.crossed(layout, &living[random.index(living.len())].fit.layout, random)
    }

    /// Goes on with another task and its sampler: the same poses by other rules. Layouts that it does not take are dropped.
    pub fn turn_to(
        &mut self,
        task: &'a Task<'a>,
        sampler: &'a Sampler<'a>,
        topology: Topology,
        stop: &(dyn Fn() -> bool + Sync),
    ) {
        (self.task, self.sampler, self.topology) = (task, sampler, topology);
        let anew = |island: &Vec<Living>| {
            let again = in_order(island, |Living { fit, .. }| {
                let begun = task.resume(fit.layout.clone(), fit, stop)?;
                task.wound(task.improve(begun, STEPS, false, stop), STEPS, stop)
            });
            let mut island = again.into_iter().flatten().map(Living::new).collect();
            keep(&mut island);
            island
        };
        let islands: Vec<Vec<Living>> = self.islands.iter().map(anew).filter(|island| !island.is_empty()).collect();
        // Told to stop, they come to nothing, and what lives is the best that there is.
        if !stop() {
            self.islands = islands;
        }
    }

    /// One more layout lives on the first island: one from elsewhere, with activations and positions of every pose.
    pub fn take(&mut self, layout: Layout, from: &[Start], stop: &dyn Fn() -> bool) {
        let taken = self.task.taken(layout, from, stop);
        let improved = taken.and_then(|fit| self.task.wound(self.task.improve(fit, STEPS, false, stop), STEPS, stop));
        if let (Some(fit), Some(island)) = (improved, self.islands.first_mut()) {
            island.push(Living::new(fit));
            keep(island);
        }
    }

    /// The worst island is given up for the best.
    fn give_up(&mut self) {
        let cost = |island: &Vec<Living>| island.first().map_or(f64::INFINITY, |living| living.fit.cost);
        self.islands.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
        if self.islands.len() > 1 {
            self.islands.pop();
            self.islands.push(self.islands[0].clone());
        }
    }

    fn living(&self) -> impl Iterator<Item = &Fit> {
        self.islands.iter().flatten().map(|living| &living.fit)
    }

    fn all(&self) -> impl Iterator<Item = &Fit> {
        self.living().chain(&self.heats).chain(&self.remembered)
    }

    /// The best so far; its poses are wound from rest.
    pub fn best(&self) -> Option<&Fit> {
        self.all().min_by(|a, b| a.cost.total_cmp(&b.cost))
    }

    /// The best of the present islands.
    pub fn best_here(&self) -> Option<&Fit> {
        self.living().min_by(|a, b| a.cost.total_cmp(&b.cost))
    }

    /// The best few, by their worst pose, and as many as asked for that differ in kind from them and from each other.
    pub fn finalists(&self, count: usize, others: usize) -> Vec<Fit> {
        let mut all: Vec<Fit> = self.all().cloned().collect();
        all.sort_by(Fit::compare);
        all.dedup_by(|a, b| is_same(a, b));
        let rest = all.split_off(count.min(all.len()));
        let apart_mm = APART * self.task.design.body_length_mm();
        let most = all.len() + others;
        for fit in rest {
            let new = all.iter().all(|taken| kinds::distance(&taken.layout, &fit.layout) > apart_mm);
            if new && all.len() < most {
                all.push(fit);
            }
        }
        all
    }

    /// A fit improved as far as it goes.
    pub fn finished(&self, fit: &Fit, stop: &dyn Fn() -> bool) -> Fit {
        let last = self.task.improve(fit.clone(), LAST_STEPS, false, stop);
        let wound = self.task.wound(last, LAST_STEPS, stop);
        wound.filter(|wound| wound.cost < fit.cost).unwrap_or_else(|| fit.clone())
    }
}

/// The best few that differ.
fn keep(island: &mut Vec<Living>) {
    island.sort_by(|a, b| a.fit.cost.total_cmp(&b.fit.cost));
    island.dedup_by(|a, b| is_same(&a.fit, &b.fit));
    island.truncate(ALIVE);
}

/// Whether the worse of two is in the valley of the better one.
fn is_same(worse: &Fit, better: &Fit) -> bool {
    (worse.cost - better.cost).abs() <= SAME * better.cost
}
