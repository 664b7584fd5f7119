//! Networks for one pose, for somebody to choose from.
//!
//! One more winch is searched for beside those that are there: random layouts annealed in the linear model, improved by exact
//! sensitivities ([`Task::improve`]), changed at random, thinned out; and the networks of Algorithm 2, moved until they can be sewn. What is
//! proposed differs in kind ([`super::kinds`]), and every figure of it is what a check says of the design with this network ([`figures`]).
//!
//! | file | holds |
//! | --- | --- |
//! | `mod` | the course of the search |
//! | `proposal` | a proposal and the options of the search |
//! | `figures` | a network becomes a proposal |
//! | `list` | the list of proposals as it grows |
//! | `pool` | the layouts that are alive, and how they come about |
//! | `paper` | networks of Algorithm 2 as layouts |

mod figures;
mod list;
mod paper;
mod pool;
mod proposal;

pub use proposal::{PoseServed, Proposal, ProposeOptions};

use super::candidate::unused_name;
use super::moves::{Sampler, Topology};
use super::refine::Task;
use super::search::{FREE_HOLES, coarser, rim, sewable};
use crate::design::{Design, Pose, Target};
use figures::Subject;
use list::List;
use pool::{ALIVE, Pool};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Batches of new layouts; after the first one something is shown.
const BATCHES: usize = 4;
/// Batches that are shown at once where that takes longer than a batch: on a finer mesh than that of the search.
const EARLY: usize = 2;
/// Rounds in which all layouts that are alive have children.
const ROUNDS: usize = 3;
/// Layouts of which what costs little is left out in the end; the others that are alive are shown as they are.
const THINNED: usize = 4;

/// Networks of one winch for a pose of `targets`, in addition to those that act in the design; the best first, by the error that is left when
/// a hand has sewn them. `found` hears of the list whenever it has changed. Empty where nothing helps, and without what was not found yet when
/// cancelled. The same options give the same list, for any number of threads.
pub fn propose(
    design: &Design,
    targets: &[Target],
    options: &ProposeOptions,
    found: &mut dyn FnMut(&[Arc<Proposal>]),
    cancel: &AtomicBool,
) -> Vec<Arc<Proposal>> {
    let acting = design.acting();
    let Some(subject) = Subject::new(&acting, unused_name(design), targets, cancel) else { return Vec::new() };
    let mut posed = Design::clone(&acting);
    posed.keyframes.clear();
    posed.poses = vec![Pose { name: String::new(), targets: targets.to_vec() }];
    let coarse = coarser(&posed);
    let searched = coarse.as_ref().unwrap_or(&posed);
    let coarser = coarse.is_some();
    let mut list = List { subject: &subject, posed: &posed, coarser, rules: options.rules, cancel, all: Vec::new() };
    let stop = || cancel.load(Ordering::Relaxed);

    let edge = rim(&searched.mesh);
    let sewable = options.rules.then(|| sewable(searched, &edge));
    let task = Task::new(searched, sewable.as_ref(), &searched.networks);
    if task.poses.is_empty() {
        return Vec::new();
    }
    let sampler = Sampler::new(&searched.mesh, sewable.as_ref());
    let most = options.parameters.tendon_num.max(1);
    let most_holes = if options.rules { design.sewing.most_holes } else { FREE_HOLES };
    let topology = Topology { tendons: vec![[if options.fewer { 1 } else { most }, most]], most_holes };
    let mut pool = Pool::new(&task, &sampler, topology, options.seed, cancel);
    for batch in 0..BATCHES {
        pool.begin(batch, &stop);
        if !coarser || batch < EARLY {
            list.show(&pool.best(1), found);
        }
        if stop() {
            return list.best();
        }
    }
    for fit in paper::layouts(searched, coarser, options, most_holes, cancel) {
        pool.take(fit, &stop);
        if stop() {
            return list.best();
        }
    }
    for round in 0..ROUNDS {
        pool.advance(round, &stop);
        if !coarser {
            list.show(&pool.best(2), found);
        }
        if stop() {
            return list.best();
        }
    }
    for few in 0..THINNED.div_ceil(2) {
        pool.thin(2 * few..2 * few + 2, &stop);
        if stop() {
            return list.best();
        }
        list.show(&pool.some(2 * few..2 * few + 2), found);
    }
    list.show(&pool.some(THINNED..ALIVE), found);
    list.best()
}

#[cfg(test)]
mod tests;
