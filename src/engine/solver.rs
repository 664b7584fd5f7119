//! Poses both plushies of a design, warm-started from the request before.

use super::compiled::{Compiled, Effort, Work};
use super::idealized::idealize;
use super::realizable::realize;
use super::request::{Outcome, Request, Setpoint};
use crate::design::{Design, Network};
use crate::soft_ik::Quality;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// Both plushies of a design once, from rest and with all effort: the same whoever asks. `shown`: whether the idealized and the realizable
/// one are wanted.
pub fn solve_once(design: &Design, setpoint: Setpoint, shown: [bool; 2], cancel: &AtomicBool) -> Outcome {
    let [show_idealized, show_realizable] = shown;
    let design = Arc::new(design.clone());
    let request = Request { id: 0, design, setpoint, quality: Quality::Accurate, show_idealized, show_realizable };
    Solver::default().solve_with(&request, Effort::Thorough, cancel)
}

/// Keeps compiled models and the last postures between requests.
#[derive(Default)]
pub struct Solver {
    idealized: Option<Compiled>,
    realizable: Option<Compiled>,
    /// The design that was asked about last, and the same without the networks that are switched off.
    acting: Option<(Arc<Design>, Arc<Design>)>,
}

impl Solver {
    /// Answers a request; `cancel` is checked at every Newton step and leaves the best state reached so far.
    pub fn solve(&mut self, request: &Request, cancel: &AtomicBool) -> Outcome {
        self.solve_with(request, Effort::Interactive, cancel)
    }

    /// [`Self::solve`] with a stated effort. The realizable plushie comes first; its activations are held in the idealized one.
    pub fn solve_with(&mut self, request: &Request, effort: Effort, cancel: &AtomicBool) -> Outcome {
        if request.design.networks.iter().any(|network| network.muted) {
            return self.solve_acting(request, effort, cancel);
        }
        let design = &request.design;
        let work = Work { effort, quality: request.quality, cancel };
        let [_, needed] = request.solves();
        let realizable = needed.then(|| realize(&mut self.realizable, design, &request.setpoint, &work));
        let idealized = request.show_idealized.then(|| {
            let activations = match (&realizable, &request.setpoint) {
                (Some(shape), _) => shape.activations_mm.clone(),
                (None, Setpoint::Activations(given)) => given.clone(),
                (None, Setpoint::Targets(_)) => vec![0.0; design.networks.len()],
            };
            let beside = realizable.as_ref().map(|shape| shape.nodes.as_flattened());
            idealize(&mut self.idealized, design, &request.setpoint, &activations, beside, &work)
        });
        let realizable = realizable.filter(|_| request.show_realizable);
        Outcome { id: request.id, idealized, realizable, refined: effort == Effort::Thorough }
    }

    /// Without the networks that are switched off: nothing of theirs is wound, and their tendons pull nothing.
    fn solve_acting(&mut self, request: &Request, effort: Effort, cancel: &AtomicBool) -> Outcome {
        let all = &request.design;
        let acting = match self.acting.take() {
            Some((of, acting)) if Arc::ptr_eq(&of, all) => acting,
            _ => Arc::new(all.acting().into_owned()),
        };
        self.acting = Some((all.clone(), acting.clone()));
        let setpoint = match &request.setpoint {
            Setpoint::Targets(targets) => Setpoint::Targets(targets.clone()),
            Setpoint::Activations(given) => Setpoint::Activations(all.of_acting(given)),
        };
        let mut outcome = self.solve_with(&Request { design: acting, setpoint, ..request.clone() }, effort, cancel);
        for shape in [&mut outcome.idealized, &mut outcome.realizable].into_iter().flatten() {
            shape.activations_mm = all.of_all(&shape.activations_mm);
            let mut tensions = std::mem::take(&mut shape.tendon_tensions).into_iter();
            let of = |network: &Network| network.tendons.iter().map(|_| !network.muted).collect::<Vec<_>>();
            let pulls = all.networks.iter().flat_map(of);
            shape.tendon_tensions =
                pulls.map(|pulls| if pulls { tensions.next().unwrap_or_default() } else { 0.0 }).collect();
        }
        outcome
    }
}

#[cfg(test)]
mod tests {
    use super::super::{EQUILIBRIUM, Quality, Shape};
    use super::*;
    use crate::design::{Design, Target, testing};
    use std::sync::Arc;

    fn ask(solver: &mut Solver, design: &Design, setpoint: Setpoint, shown: [bool; 2]) -> Outcome {
        let design = Arc::new(design.clone());
        let [show_idealized, show_realizable] = shown;
        let request = Request { id: 0, design, setpoint, quality: Quality::Balanced, show_idealized, show_realizable };
        solver.solve(&request, &AtomicBool::new(false))
    }

    /// Whether the idealized and the realizable plushie were worked on.
    fn worked(solver: &Solver) -> [bool; 2] {
        [solver.idealized.is_some(), solver.realizable.is_some()]
    }

    #[test]
    fn a_hidden_view_is_not_solved() {
        let rigged = testing::sample();
        let plain = Design { networks: Vec::new(), keyframes: Vec::new(), ..rigged.clone() };
        let pose = || Setpoint::Targets(rigged.poses[0].targets.clone());
        for (design, setpoint, shown) in [
            (&plain, pose(), [true, false]),
            (&plain, pose(), [false, true]),
            (&rigged, pose(), [false, true]),
            (&rigged, Setpoint::Targets(Vec::new()), [true, false]),
            (&rigged, Setpoint::Activations(vec![3.0, 1.0]), [true, false]),
        ] {
            let mut solver = Solver::default();
            let outcome = ask(&mut solver, design, setpoint, shown);
            assert_eq!([outcome.idealized.is_some(), outcome.realizable.is_some()], shown);
            assert_eq!(worked(&solver), shown, "{} networks", design.networks.len());
        }
        // The fibres add to what the winches reach, so these are searched for, seen or not.
        let mut solver = Solver::default();
        let outcome = ask(&mut solver, &rigged, pose(), [true, false]);
        assert!(outcome.realizable.is_none());
        assert_eq!(worked(&solver), [true, true]);
    }

    #[test]
    fn a_view_looks_the_same_alone() {
        let design = testing::sample();
        for setpoint in [Setpoint::Targets(Vec::new()), Setpoint::Activations(vec![3.0, 1.0])] {
            let together = ask(&mut Solver::default(), &design, setpoint.clone(), [true, true]);
            let alone = ask(&mut Solver::default(), &design, setpoint, [true, false]);
            let [together, alone] = [together, alone].map(|outcome| outcome.idealized.unwrap());
            for (p, q) in together.nodes.iter().flatten().zip(alone.nodes.iter().flatten()) {
                assert!((p - q).abs() < 1e-6, "{p} {q}");
            }
        }
    }

    #[test]
    fn all_effort_makes_neither_view_worse() {
        // Held by one pin the body turns freely: the winches alone leave it turned as the hand did.
        let mut design = testing::sample();
        design.pins.truncate(1);
        let home = design.poses[0].targets.clone();
        let design = Arc::new(design);
        let mut solver = Solver::default();
        let mut ask = |targets: &[Target], effort| {
            let setpoint = Setpoint::Targets(targets.to_vec());
            let quality = Quality::Balanced;
            let request = Request {
                id: 0,
                design: design.clone(),
                setpoint,
                quality,
                show_idealized: true,
                show_realizable: true,
            };
            let outcome = solver.solve_with(&request, effort, &AtomicBool::new(false));
            [outcome.idealized.unwrap(), outcome.realizable.unwrap()].map(|shape| shape.target_error)
        };
        let size = design.body_length_mm();
        for turn in 0..8 {
            let (sin, cos) = (0.8 * f64::from(turn)).sin_cos();
            let mut away = home.clone();
            away[0].to = [3.0 * size * cos, 3.0 * size * sin];
            ask(&away, Effort::Interactive);
            let hand = ask(&home, Effort::Interactive);
            let all = ask(&home, Effort::Thorough);
            assert!(all[0] <= hand[0] + 1e-6 && all[1] <= hand[1] + 1e-6, "turn {turn}: {all:?} after {hand:?}");
        }
    }

    #[test]
    fn a_dragged_hole_goes_on_from_the_last_posture() {
        let mut design = testing::sample();
        design.pins.truncate(1);
        let pose = || Setpoint::Targets(testing::sample().poses[0].targets.clone());
        let mut solver = Solver::default();
        for step in 0..6 {
            let at = 0.05 * f64::from(step);
            let hole = crate::physics::MaterialPoint::of_triangle([2, 3, 4], [at, 0.0, 1.0 - at]);
            design.networks[1].tendons[0].routing[1] = hole;
            let followed = ask(&mut solver, &design, pose(), [false, true]).realizable.unwrap();
            let fresh = ask(&mut Solver::default(), &design, pose(), [false, true]).realizable.unwrap();
            assert!(followed.target_error <= fresh.target_error + 1e-3, "{step}");
            assert!(followed.distance_from_equilibrium() < super::super::NEAR_EQUILIBRIUM, "{step}");
        }
    }

    #[test]
    fn a_shape_says_how_far_from_equilibrium_it_is() {
        let design = testing::sample();
        let outcome = ask(&mut Solver::default(), &design, Setpoint::Activations(vec![3.0, 1.0]), [true, true]);
        for shape in [outcome.idealized.unwrap(), outcome.realizable.unwrap()] {
            assert!(shape.converged && shape.factorizations > 0 && shape.force_scale > 0.0);
            assert!(shape.distance_from_equilibrium() < EQUILIBRIUM, "{}", shape.distance_from_equilibrium());
        }
        assert_eq!(Shape::default().distance_from_equilibrium(), 0.0);
    }
}
