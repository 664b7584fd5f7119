//! The free elements: tension as the unknown, or a spring at a bound of its rest length.

use crate::physics::{Element, Law};
use crate::soft_ik::Winch;

/// A held element is freed once its rest length is off its bound by this part of `alpha_0` for every time it was freed
/// before, so that none comes and goes for ever.
const RELEASE_DISTANCE: f64 = 0.01;
/// Tangent, as a part of `K`, below which an element counts as slack.
const SLACK_TANGENT: f64 = 1e-6;

/// A free fibre: a winch with one element.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fiber {
    pub element: usize,
    pub ratio: f64,
    /// Rest lengths at the bounds of its activation.
    pub shortest: f64,
    pub longest: f64,
    /// Tension; of a held one that of its spring.
    pub tension: f64,
    /// The length at which it has that tension.
    pub length: f64,
    /// Soft enough to be a spring wherever it is taut.
    pub soft: bool,
    /// The rest length of the spring that the element is at present; `None` where its tension is the unknown.
    pub held: Option<f64>,
    /// How often it was freed since the targets moved.
    pub releases: u16,
}

impl Fiber {
    /// A fibre at activation `beta` and coordinates `x`.
    pub fn new(winch: &Winch, beta: f64, elements: &[Element], x: &[f64], softness: f64) -> Self {
        let (element, ratio) = winch.members[0];
        let e = &elements[element];
        let (shortest, longest) = (e.alpha0 - ratio * winch.upper, e.alpha0 - ratio * winch.lower);
        let rest = e.alpha0 - ratio * beta;
        let length = e.length(x);
        let tension = e.tension(length - rest);
        let slop = 1e-9 * e.alpha0;
        let soft = 2.0 * e.stiffness <= softness;
        let held = if tension <= 0.0 {
            None
        } else if soft && length > rest {
            Some(rest.max(shortest).min(longest))
        } else if rest <= shortest + slop {
            Some(shortest)
        } else if rest >= longest - slop {
            Some(longest)
        } else {
            None
        };
        Self { element, ratio, shortest, longest, tension, length, soft, held, releases: 0 }
    }

    /// The tensions `[lowest, highest]` between which a step may choose, at length `length`.
    ///
    /// A free element's are those at its bounds, the length as it is. A held one's move its rest length to its bounds, with
    /// the tangent as it is.
    pub fn limits(&self, element: &Element, length: f64) -> [f64; 2] {
        match self.held {
            None => [element.tension(length - self.longest), element.tension(length - self.shortest)],
            Some(rest) => {
                let (tau, tangent) = (element.tension(length - rest), element.tangent(length - rest));
                [(tau + tangent * (rest - self.longest)).max(0.0), tau + tangent * (rest - self.shortest)]
            }
        }
    }

    /// Takes the tension that a step chose at length `length`.
    pub fn take(&mut self, element: &Element, length: f64, tension: f64, [lowest, highest]: [f64; 2]) {
        let Some(rest) = &mut self.held else {
            self.tension = tension;
            self.length = length;
            return;
        };
        let tangent = element.tangent(length - *rest);
        // Exactly on the bound where the step ends there.
        *rest = if tension == highest {
            self.shortest
        } else if tension == lowest && self.longest.is_finite() && tension > 0.0 {
            self.longest
        } else {
            (*rest - (tension - self.tension) / tangent).max(self.shortest).min(self.longest)
        };
    }

    /// A held element that has gone slack has no stiffness left to be held by: its tension is the unknown again.
    pub fn release_slack(&mut self, element: &Element, length: f64) {
        if let Some(rest) = self.held {
            self.tension = element.tension(length - rest);
            let least = if self.soft { 0.5 } else { SLACK_TANGENT };
            if element.tangent(length - rest) <= least * element.stiffness {
                self.held = None;
                self.length = length;
            }
        }
    }

    /// How it pulls. `steady` is the stiffness that stands for a taut one's own where its tension is the unknown.
    pub fn law(&self, steady: f64) -> Law {
        match self.held {
            Some(rest) => Law::Spring { alpha: rest },
            None if self.tension > 0.0 => {
                let stiffness = if self.soft { 0.0 } else { steady };
                Law::Elastic { tension: self.tension, length: self.length, stiffness }
            }
            None => Law::Tension(0.0),
        }
    }

    /// Moves to a new length under its law.
    pub fn follow(&mut self, element: &Element, length: f64, steady: f64) {
        self.tension = self.law(steady).tension_and_tangent(element, length).0;
        self.length = length;
    }

    /// Holds an element that left its bounds and frees a held one that the step moved off its bound, at the new length.
    /// Whether anything changed.
    pub fn update(&mut self, element: &Element, length: f64) -> bool {
        let slop = 1e-10 * element.alpha0;
        match self.held {
            None => {
                let rest = length - element.deformation(self.tension);
                let bound = if self.tension > 0.0 && rest < self.shortest - slop {
                    self.shortest
                } else if rest > self.longest + slop && element.tension(length - self.longest) > self.tension {
                    self.longest
                } else if self.soft && length > rest {
                    self.held = Some(rest);
                    return false;
                } else {
                    return false;
                };
                self.held = Some(bound);
                self.tension = element.tension(length - bound);
                true
            }
            Some(rest) => {
                self.tension = element.tension(length - rest);
                if self.soft {
                    return false;
                }
                let inside = (rest - self.shortest).min(self.longest - rest);
                let free = inside > self.releases as f64 * RELEASE_DISTANCE * element.alpha0 + slop;
                if free {
                    self.held = None;
                    self.releases = self.releases.saturating_add(1);
                }
                free
            }
        }
    }

    /// The activation that holds the present tension at length `length`: just slack where there is none.
    pub fn activation(&self, element: &Element, length: f64) -> f64 {
        (element.alpha0 - length + element.deformation(self.tension)) / self.ratio
    }
}
