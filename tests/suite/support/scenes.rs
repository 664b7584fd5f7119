//! Designs under the hand: what the tests of the tracker drag about.

use plushwright::design::{Design, Gravity, Target, bundled, file};
use plushwright::engine::compile::{Plushie, View, compile, objective};
use plushwright::soft_ik::{Actuation, Frame, Objective, Quality, Question, Tracker};

/// A compiled design, two of its points under the hand; the fibres are free.
pub struct Scene {
    pub plushie: Plushie,
    pub actuation: Actuation,
    pub objective: Objective,
    /// Where the targets are at rest, mm.
    pub home: Vec<[f64; 2]>,
    pub body_length: f64,
    /// Winches of the networks, whose contractions are held.
    winches: Actuation,
}

/// What pulls beside the free fibres.
#[derive(Clone, Copy, Debug, Default)]
pub struct Parts {
    /// The networks' tendons, at contractions that [`Scene::turn`] sets.
    pub tendons: bool,
    pub gravity: bool,
    /// Fibres a hundred times stiffer than those of the design: their tensions are the unknowns, and not their rest lengths.
    pub stiff: bool,
}

pub fn design(name: &str) -> Design {
    let example = bundled::ALL.iter().find(|b| b.name == name).expect("the example exists");
    example.design().expect("the example is sound")
}

/// The E with an earlier routing of three tendons, which stays as it is when the bundled designs are made anew.
pub fn steady_e() -> Design {
    file::parse(include_str!("../../data/designs/e.plush")).expect("the design is sound")
}

impl Scene {
    pub fn new(name: &str, parts: Parts) -> Self {
        Self::of(design(name), parts)
    }

    pub fn of(mut design: Design, parts: Parts) -> Self {
        if !parts.tendons {
            design.networks.clear();
        }
        // Felt and stuffing of a kilogram a square metre.
        design.gravity = parts.gravity.then_some(Gravity { acceleration: [0.0, -9.81], surface_density: 1e-6 });
        if parts.stiff {
            design.fibers.stiffness *= 100.0;
        }
        let plushie = compile(&design, View::Idealized).expect("the example compiles");
        let targets: Vec<Target> = design.poses[0].targets.iter().take(2).copied().collect();
        let objective = objective(&design, &plushie, &targets);
        let home = targets.iter().map(|t| design.mesh.position(&t.at, &design.mesh.nodes)).collect();
        let zero = vec![0.0; plushie.fiber_elements.end];
        let winches = Actuation { winches: plushie.winches.clone(), fixed: zero.clone() };
        let actuation = Actuation { winches: plushie.fibers.clone(), fixed: zero };
        let body_length = design.body_length_mm();
        let mut scene = Self { plushie, actuation, objective, home, body_length, winches };
        scene.aim([0.0; 2]);
        scene
    }

    /// Starts at the equilibrium of zero activations.
    pub fn tracker(&mut self) -> Tracker {
        let zero = vec![0.0; self.actuation.winches.len()];
        let rest = self.plushie.model.rest.clone();
        let mut question =
            Question { model: &mut self.plushie.model, actuation: &self.actuation, objective: &self.objective };
        let (start, _) = question.settle(&zero, &rest, &|| false);
        Tracker::new(&mut question, &start)
    }

    /// The targets at this offset from rest, in body lengths; the second one at half of it, the other way up.
    pub fn aim(&mut self, offset: [f64; 2]) {
        for (k, (target, home)) in self.objective.targets.iter_mut().zip(&self.home).enumerate() {
            let [x, y] = if k == 0 { offset } else { [0.5 * offset[0], -0.5 * offset[1]] };
            target.goal = [home[0] + self.body_length * x, home[1] + self.body_length * y];
        }
    }

    /// Winds the networks to this part of what they can take.
    pub fn turn(&mut self, part: f64) {
        for winch in &self.winches.winches {
            for &(element, ratio) in &winch.members {
                self.actuation.fixed[element] = ratio * part * winch.upper;
            }
        }
    }

    pub fn frame(&mut self, tracker: &mut Tracker, quality: Quality) -> Frame {
        let mut question =
            Question { model: &mut self.plushie.model, actuation: &self.actuation, objective: &self.objective };
        tracker.frame(&mut question, quality, &|| false)
    }

    /// Frame `k` of a drag: an arc out and on, at rest from `still` on. The networks turn as long as the targets move.
    pub fn drag(&mut self, k: usize, still: usize) {
        let t = k.min(still) as f64;
        self.aim([0.15 * (0.21 * t).sin(), 0.1 * (1.0 - (0.17 * t).cos())]);
        self.turn(0.3 * (0.5 - 0.5 * (0.13 * t).cos()));
    }
}
