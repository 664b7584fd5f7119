//! Sparsity: points, tendons and winches that a rig can do without are left out.

use super::layout::Layout;
use super::moves::Topology;
use super::refine::{Fit, KEPT, Task};

/// All poses served to this part of their rest errors need no better rig.
pub(super) const SERVED: f64 = 0.005;
/// What is left out may make a pose worse by this part; and one that is better than the worst, by what nobody sees.
pub(super) const PRICE: f64 = 0.03;
/// Steps of improvement after something was left out.
const STEPS: usize = 25;

/// The fit without what costs little: whole winches first, then tendons as far as the topology allows, then points. A winch is a motor to buy, to
/// house and to wire: where a rig is to be sewn, none is kept for what nobody sees.
pub(super) fn pruned(task: &Task, topology: &Topology, fit: Fit, stop: &dyn Fn() -> bool) -> Fit {
    let mut now = fit;
    let unseen = if task.sewable.is_some() { task.unseen() } else { vec![0.0; task.poses.len()] };
    let hardly = unseen.iter().copied().fold(f64::INFINITY, f64::min);
    let kinds: [(Kind, f64); 3] =
        [(without_a_winch, SERVED.max(hardly)), (without_a_tendon, SERVED), (without_a_point, SERVED)];
    for (fewer, served) in kinds {
        loop {
            let worst = now.worst();
            let most: Vec<f64> = now
                .parts()
                .zip(&unseen)
                .map(|(part, unseen)| ((1.0 + PRICE) * part).max(served).max(unseen.min((1.0 + PRICE) * worst)))
                .collect();
            let tried = fewer(&now.layout, topology).into_iter().filter_map(|(layout, kept)| {
                let begun = task.resume(layout, &kept.map_or_else(|| now.clone(), |winch| now.without(winch)), stop)?;
                let improved = task.wound(task.improve(begun, STEPS, false, stop), STEPS, stop)?;
                let allowed = now.violation.max(KEPT);
                let is_cheap = improved.parts().zip(&most).all(|(part, most)| part <= *most);
                (is_cheap && improved.violation <= allowed).then_some(improved)
            });
            let Some(next) = tried.min_by(|a, b| a.cost.total_cmp(&b.cost)) else { break };
            if stop() {
                return now;
            }
            now = next;
        }
    }
    now
}

/// A layout, and the winch that it lacks.
type Fewer = Vec<(Layout, Option<usize>)>;
/// Ways to leave one thing of a kind out.
type Kind = fn(&Layout, &Topology) -> Fewer;

fn without_a_winch(layout: &Layout, topology: &Topology) -> Fewer {
    let optional = layout.winches.len() > 1 && topology.tendons.iter().any(|[fewest, most]| fewest < most);
    let without = |winch: usize| {
        let mut new = layout.clone();
        new.winches.remove(winch);
        (new, Some(winch))
    };
    if optional { (0..layout.winches.len()).map(without).collect() } else { Vec::new() }
}

pub(super) fn without_a_tendon(layout: &Layout, topology: &Topology) -> Fewer {
    let fewest = |winch: usize| topology.tendons.get(winch).map_or(1, |[fewest, _]| *fewest);
    let mut out = Vec::new();
    for (winch, placed) in layout.winches.iter().enumerate().filter(|(k, w)| w.cables.len() > fewest(*k)) {
        for cable in 0..placed.cables.len() {
            let mut new = layout.clone();
            new.winches[winch].cables.remove(cable);
            out.push((new, None));
        }
    }
    out
}

pub(super) fn without_a_point(layout: &Layout, _: &Topology) -> Fewer {
    let mut out = Vec::new();
    for (winch, placed) in layout.winches.iter().enumerate() {
        for (cable, points) in placed.cables.iter().enumerate() {
            for k in 0..points.len().saturating_sub(1) {
                let mut new = layout.clone();
                new.winches[winch].cables[cable].remove(k);
                out.push((new, None));
            }
        }
    }
    out
}
