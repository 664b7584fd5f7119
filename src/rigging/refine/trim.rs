//! Radii of grooves and slack of cables as unknowns of the refinement.
//!
//! A cable `e` of a winch with activation `beta` has the rest length `length at rest + slack - ratio beta`; its tension pulls with
//! `-tau grad l`. With the tangent `k` of its law, the force changes by `-k beta grad l` with the ratio, and by `+k grad l` with the slack.

use super::task::{Built, STRIDE, Task};
use crate::rigging::layout::Layout;
use crate::rigging::options::Trims;

/// Radii of the grooves of one spool lie within these parts of its own: a drum that a housing holds, a groove that a thread does not cut.
const RATIOS: [f64; 2] = [0.4, 1.6];
/// Most slack of a cable as a part of the body: more is a loop that catches.
const MOST_SLACK: f64 = 0.15;
/// A step of a ratio counts as so many mm: about what a winch winds.
const RATIO_MM: f64 = 50.0;

/// What of which cable is an unknown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Trim {
    winch: usize,
    cable: usize,
    /// Its contractile element, and its winch among all.
    pub element: usize,
    of_all: usize,
    is_ratio: bool,
}

/// The unknowns of a layout beside its points, cable by cable. A winch with one cable needs no ratio.
pub(super) fn trims(task: &Task, layout: &Layout) -> Vec<Trim> {
    let Trims { ratios, slack } = task.trims;
    let mut element: usize = task.fixed.iter().map(|network| network.tendons.len()).sum();
    let mut out = Vec::new();
    for (winch, placed) in layout.winches.iter().enumerate() {
        for cable in 0..placed.cables.len() {
            let trim = |is_ratio| Trim { winch, cable, element, of_all: task.fixed.len() + winch, is_ratio };
            out.extend((ratios && placed.cables.len() > 1).then(|| trim(true)));
            out.extend(slack.then(|| trim(false)));
            element += 1;
        }
    }
    out
}

impl Trim {
    /// Right-hand side of `H dx` by this unknown; `tangent`: that of its cable.
    pub fn column(&self, built: &Built, x: &[f64], beta: &[f64], tangent: f64) -> Vec<f64> {
        let by = if self.is_ratio { -tangent * beta[self.of_all] / RATIO_MM } else { tangent };
        let mut column = vec![0.0; x.len()];
        built.plushie.model.contractile.elements[self.element].add_length_gradient(x, by, &mut column);
        column
    }

    /// Bounds of a step, mm.
    pub fn bounds(&self, task: &Task, layout: &Layout) -> [f64; 2] {
        let body = task.design.body_length_mm();
        let (now, [low, high]) = if self.is_ratio {
            (RATIO_MM * self.value(layout), RATIOS.map(|ratio| RATIO_MM * ratio))
        } else {
            (self.value(layout), [0.0, MOST_SLACK * body])
        };
        let stride = STRIDE * body;
        [(low - now).clamp(-stride, 0.0), (high - now).clamp(0.0, stride)]
    }

    fn value(&self, layout: &Layout) -> f64 {
        let cable = &layout.winches[self.winch].cables[self.cable];
        if self.is_ratio { cable.ratio } else { cable.slack_mm }
    }

    /// Takes a step of so many mm.
    pub fn step(&self, layout: &mut Layout, by: f64) {
        let cable = &mut layout.winches[self.winch].cables[self.cable];
        match self.is_ratio {
            true => cable.ratio = (cable.ratio + by / RATIO_MM).clamp(RATIOS[0], RATIOS[1]),
            false => cable.slack_mm = (cable.slack_mm + by).max(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rigging::layout::{Layout, Placed};
    use crate::rigging::refine::local::{Local, Sample};
    use crate::rigging::tests::bar;

    const GO: &dyn Fn() -> bool = &|| false;

    /// A winch on the left with a cable above the middle and one below, the second of which pulls less.
    fn one_winch() -> Layout {
        let mut cables: Vec<crate::rigging::layout::Cable> =
            vec![vec![[120.0, 48.0], [210.0, 46.0]].into(), vec![[120.0, 38.0], [180.0, 40.0]].into()];
        (cables[0].slack_mm, cables[1].ratio, cables[1].slack_mm) = (0.3, 0.8, 0.5);
        Layout { winches: vec![Placed { at: [40.0, 30.0], cables }] }
    }

    #[test]
    fn slopes_by_ratio_and_slack_are_those_of_differences() {
        let design = bar(80);
        let trims = Trims { ratios: true, slack: true };
        let task = Task::new(&design, None, &[]).trimming(trims);
        let fit = task.improve(task.begin(one_winch(), GO).unwrap(), 20, true, GO);
        let from: Vec<_> = fit.poses.iter().map(|posture| (posture.beta.clone(), posture.x.clone())).collect();
        let built = task.build(&fit.layout).unwrap();
        let unknowns = super::trims(&task, &fit.layout);
        assert_eq!(unknowns.len(), 4);
        let local = Local::new(&mut [Sample { task: &task, fit: fit.clone(), built, weight: 1.0 }], false).unwrap();
        let points = 2 * fit.layout.spots().len();
        for (k, trim) in unknowns.iter().enumerate() {
            let at = |by: f64| {
                let mut layout = fit.layout.clone();
                trim.step(&mut layout, by);
                let mut built = task.build(&layout).unwrap();
                task.fit(layout, &mut built, &from, GO).unwrap().cost
            };
            let (told, found) = (local.model.gradient[points + k], (at(1e-3) - at(-1e-3)) / 2e-3);
            assert!((told - found).abs() <= 1e-4 * found.abs().max(1e-6), "{trim:?}: {told} {found}");
        }
    }

    #[test]
    fn what_may_be_trimmed_serves_no_worse_and_stays_within_its_bounds() {
        let design = bar(80);
        let plain = Task::new(&design, None, &[]);
        let begun = plain.begin(one_winch(), GO).unwrap();
        let without = plain.improve(begun.clone(), 30, false, GO);
        let trimmed = Task::new(&design, None, &[]).trimming(Trims { ratios: true, slack: true });
        let again = trimmed.resume(without.layout.clone(), &without, GO).unwrap();
        let with = trimmed.improve(again, 30, false, GO);
        assert!(with.cost < without.cost, "{} {}", with.cost, without.cost);
        let cables =
            |layout: &Layout| layout.winches[0].cables.iter().map(|c| (c.ratio, c.slack_mm)).collect::<Vec<_>>();
        assert_eq!(cables(&without.layout), cables(&begun.layout));
        assert_ne!(cables(&with.layout), cables(&begun.layout));
        for (ratio, slack_mm) in cables(&with.layout) {
            assert!((RATIOS[0]..=RATIOS[1]).contains(&ratio) && (0.0..=0.15 * 250.0).contains(&slack_mm));
        }
    }
}
