//! Layouts annealed in a linear model: many random changes, each judged in a fraction of a millisecond, before one is simulated.

use super::layout::Layout;
use super::linear_score::Linear;
use super::moves::{Sampler, Topology};
use super::refine::{Fit, Task};
use crate::random::Random;

/// How long, and from how hot to how cold. A change that costs `r` times as much is taken with a chance of `r^(-1/T)`: costs run over orders of
/// magnitude, so what counts is by which part they change.
#[derive(Clone, Copy, Debug)]
pub struct Cooling {
    pub steps: usize,
    /// First and last `T`.
    pub hot: f64,
    pub cold: f64,
}

impl Cooling {
    /// Around what a parent reaches: from hotter than a first layout, as a child should leave its parent's valley.
    pub const AROUND: Self = Self { steps: 100, hot: 0.5, cold: 0.05 };
}

/// No cost is less than this: what is below nobody sees.
const LEAST: f64 = 1e-7;

/// What layouts are judged by: what a linear model leaves, cables outside of the body in its states, and broken rules.
pub struct Annealing<'s, 'a> {
    pub task: &'s Task<'a>,
    pub sampler: &'s Sampler<'a>,
    pub topology: &'s Topology,
    pub linear: &'s Linear<'a>,
    pub stop: &'s dyn Fn() -> bool,
}

impl Annealing<'_, '_> {
    /// The best layout that random changes lead to, the first one excepted.
    pub fn run(&self, layout: Layout, cooling: Cooling, random: &mut Random) -> Layout {
        let mut least = f64::INFINITY;
        let mut here = self.cost(&layout, f64::INFINITY);
        let (mut now, mut best) = (layout, None);
        for k in 0..cooling.steps {
            if (self.stop)() {
                break;
            }
            let t = cooling.hot * (cooling.cold / cooling.hot).powf(k as f64 / cooling.steps as f64);
            let changed = self.sampler.changed(&now, self.topology, random);
            let limit = here * (1.0 - random.unit()).powf(-t);
            let there = self.cost(&changed, limit);
            if there < limit {
                (now, here) = (changed, there);
                if here < least {
                    (least, best) = (here, Some(now.clone()));
                }
            }
        }
        best.unwrap_or(now)
    }

    /// What the best layout that random changes lead to reaches: from the model's states and the windings that serve best there, or as `otherwise`
    /// begins it.
    pub fn fit(
        &self,
        layout: Layout,
        cooling: Cooling,
        random: &mut Random,
        otherwise: impl FnOnce(Layout) -> Option<Fit>,
    ) -> Option<Fit> {
        let layout = self.run(layout, cooling, random);
        let starts = self.linear.starts(&layout);
        let there = starts.and_then(|starts| self.task.taken(layout.clone(), &starts, self.stop));
        there.or_else(|| otherwise(layout))
    }

    /// A cost, or a part of one that is more than the limit.
    pub fn cost(&self, layout: &Layout, limit: f64) -> f64 {
        // The cheapest first: most changes are refused for it alone.
        let broken = LEAST + self.task.broken(layout, limit);
        if broken > limit { broken } else { broken + self.linear.cost(layout, limit - broken) }
    }
}
