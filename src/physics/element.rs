//! A contractile element: a muscle fibre or a tendon (sections 4.2 and 4.3).
//!
//! An element through the points `r_0 ... r_n` of the body has the length `l(x) = sum |r_i(x) - r_{i+1}(x)|` (eq. 6) and, as a spring of rest
//! length `alpha`, the unilateral energy `U(Gamma)`, `Gamma = l - alpha` (eq. 8, whose cubic is a perfect cube):
//!
//! ```text
//! U = 0                                    Gamma <= -eps
//! U = K/(6 eps) (Gamma + eps)^3     -eps < Gamma <= eps
//! U = K Gamma^2 + K eps^2/3                Gamma > eps      (taut stiffness 2K)
//! ```
//!
//! An element may instead carry a prescribed tension `tau`, with the energy `tau l`: the unknown of the fast posing method.
//! Segments are convex in `x` and `tau >= 0`, so the Hessian `U'' G^T G + tau d2l` is always positive semi-definite.

use super::energy::{ROUNDING, Scales};
use super::material_point::MaterialPoint;

/// Width of a point, as a fraction of the element's initial rest length: a segment of coordinate difference `d` counts as
/// `sqrt(d^2 + w^2)` long. Where its ends meet, it has no direction and the plain length has a kink, at which no Newton method
/// comes to rest; this one is smooth. From `1e-8` of the rest length on, the two differ by less than rounding.
const POINT: f64 = 1e-9;

/// An element: its routing and its spring. Continuation in stiffness changes the spring while it lasts, nothing else does.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// Attachment point, via points, attachment point.
    pub routing: Vec<MaterialPoint>,
    /// `K` of eq. 8, force per length.
    pub stiffness: f64,
    /// `epsilon` of eq. 8, length.
    pub epsilon: f64,
    /// Initial rest length `alpha_0`.
    pub alpha0: f64,
}

/// How an element pulls at present.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// A unilateral spring of rest length `alpha`.
    Spring { alpha: f64 },
    /// A cable under constant tension, whatever its length.
    Tension(f64),
    /// A cable that is under `tension` at `length` and has the given stiffness there; slack where that leads below zero. It
    /// stands for a stiff spring in whose place a softer one steadies the body.
    Elastic { tension: f64, length: f64, stiffness: f64 },
}

impl Element {
    /// The largest contraction at which it does not pull yet at `x`: `alpha_0 - l - epsilon`.
    pub fn just_slack(&self, x: &[f64]) -> f64 {
        self.alpha0 - self.length(x) - self.epsilon
    }

    /// The smallest contraction at which it is taut at `x`: `alpha_0 - l + epsilon`.
    pub fn just_taut(&self, x: &[f64]) -> f64 {
        self.alpha0 - self.length(x) + self.epsilon
    }

    /// `U(Gamma)`.
    pub fn energy(&self, gamma: f64) -> f64 {
        let (k, eps) = (self.stiffness, self.epsilon);
        if gamma <= -eps {
            0.0
        } else if gamma <= eps {
            k / (6.0 * eps) * (gamma + eps).powi(3)
        } else {
            k * gamma * gamma + k * eps * eps / 3.0
        }
    }

    /// Tension `U'(Gamma)`.
    pub fn tension(&self, gamma: f64) -> f64 {
        let (k, eps) = (self.stiffness, self.epsilon);
        if gamma <= -eps {
            0.0
        } else if gamma <= eps {
            k / (2.0 * eps) * (gamma + eps).powi(2)
        } else {
            2.0 * k * gamma
        }
    }

    /// Stiffness `U''(Gamma)`.
    pub fn tangent(&self, gamma: f64) -> f64 {
        let (k, eps) = (self.stiffness, self.epsilon);
        if gamma <= -eps {
            0.0
        } else if gamma <= eps {
            k / eps * (gamma + eps)
        } else {
            2.0 * k
        }
    }

    /// The deformation `Gamma = U'^-1(tau)`; at zero tension the just-slack one, `-eps`.
    pub fn deformation(&self, tension: f64) -> f64 {
        let (k, eps) = (self.stiffness, self.epsilon);
        if tension <= 2.0 * k * eps { (2.0 * eps * tension.max(0.0) / k).sqrt() - eps } else { tension / (2.0 * k) }
    }

    /// Length of the element at coordinates `x`.
    pub fn length(&self, x: &[f64]) -> f64 {
        let point = self.point();
        self.routing.windows(2).map(|s| segment(x, s, point).2).sum()
    }

    /// Width below which two points are one, length.
    pub(crate) fn point(&self) -> f64 {
        POINT * self.alpha0
    }

    /// What a residual at its nodes is compared with, where it has this length, tension and tangent.
    pub(super) fn add_scales(&self, x: &[f64], length: f64, (tau, tangent): (f64, f64), scales: &mut Scales) {
        if tau == 0.0 && tangent == 0.0 {
            return;
        }
        for (n, w) in self.routing.iter().flat_map(MaterialPoint::parts) {
            scales.add_force(n, [w * tau; 2]);
        }
        // The tension changes with the length, and the direction of a segment the more, the shorter it is.
        let along = tangent * length;
        for s in self.routing.windows(2) {
            let nodes = || s.iter().flat_map(MaterialPoint::parts);
            let size = nodes().fold(0.0, |m: f64, (n, _)| m.max(x[2 * n].abs()).max(x[2 * n + 1].abs()));
            let force = ROUNDING * (along + tau / segment(x, s, self.point()).2 * size);
            for (n, w) in nodes() {
                scales.add_rounding(n, [w * force; 2]);
            }
        }
    }

    /// Adds `factor * dl/dx` to `out`.
    pub fn add_length_gradient(&self, x: &[f64], factor: f64, out: &mut [f64]) {
        let point = self.point();
        for s in self.routing.windows(2) {
            add_direction([&s[0], &s[1]], segment(x, s, point), factor, out);
        }
    }

    /// `dl/dx . v`.
    pub fn length_rate(&self, x: &[f64], v: &[f64]) -> f64 {
        let (mut rate, point) = (0.0, self.point());
        for s in self.routing.windows(2) {
            let (dx, dy, length) = segment(x, s, point);
            let (vx, vy) = difference(v, s);
            rate += (dx * vx + dy * vy) / length;
        }
        rate
    }
}

/// Adds `factor` times the unit vector of a segment (`dx`, `dy`, length) at its second end, and the opposite at its first.
fn add_direction([a, b]: [&MaterialPoint; 2], (dx, dy, length): (f64, f64, f64), factor: f64, out: &mut [f64]) {
    let (fx, fy) = (factor * dx / length, factor * dy / length);
    a.add([-fx, -fy], out);
    b.add([fx, fy], out);
}

/// Coordinate differences of a segment, and its length between points of this width.
#[inline]
pub(super) fn segment(x: &[f64], s: &[MaterialPoint], point: f64) -> (f64, f64, f64) {
    let (dx, dy) = difference(x, s);
    (dx, dy, (dx * dx + dy * dy + point * point).sqrt())
}

/// Difference of a field between the two ends of a segment.
#[inline]
pub(super) fn difference(field: &[f64], s: &[MaterialPoint]) -> (f64, f64) {
    let (a, b) = (s[0].at(field), s[1].at(field));
    (b[0] - a[0], b[1] - a[1])
}

impl Law {
    /// `(tau, dtau/dl)` at length `l`.
    pub fn tension_and_tangent(&self, element: &Element, length: f64) -> (f64, f64) {
        match *self {
            Law::Spring { alpha } => (element.tension(length - alpha), element.tangent(length - alpha)),
            Law::Tension(tau) => (tau, 0.0),
            Law::Elastic { tension, length: at, stiffness } => {
                let tau = tension + stiffness * (length - at);
                if tau > 0.0 { (tau, stiffness) } else { (0.0, 0.0) }
            }
        }
    }

    /// The energy at length `l`, whose derivative the tension is.
    pub(super) fn energy(&self, element: &Element, length: f64) -> f64 {
        match *self {
            Law::Spring { alpha } => element.energy(length - alpha),
            Law::Tension(tau) => tau * length,
            Law::Elastic { tension, length: at, stiffness } => {
                let stretch = if stiffness > 0.0 { (length - at).max(-tension / stiffness) } else { length - at };
                (tension + 0.5 * stiffness * stretch) * stretch
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn element() -> Element {
        Element { routing: vec![0.into(), 1.into()], stiffness: 3.0, epsilon: 0.02, alpha0: 1.0 }
    }

    #[test]
    fn the_unilateral_energy_is_twice_continuously_differentiable() {
        let e = element();
        for at in [-e.epsilon, e.epsilon] {
            let (low, high) = (at - 1e-12, at + 1e-12);
            assert!((e.energy(low) - e.energy(high)).abs() < 1e-11);
            assert!((e.tension(low) - e.tension(high)).abs() < 1e-9);
            assert!((e.tangent(low) - e.tangent(high)).abs() < 1e-7);
        }
        assert_eq!(e.energy(-0.03), 0.0);
        assert_eq!(e.tangent(0.5), 6.0);
        assert!((e.tension(0.0) - 3.0 * 0.02 / 2.0).abs() < 1e-16);
    }

    #[test]
    fn derivatives_decay_with_second_order_in_every_zone() {
        let e = element();
        for gamma in [-0.05, -0.01, 0.011, 0.3] {
            let error = |h: f64| ((e.energy(gamma + h) - e.energy(gamma - h)) / (2.0 * h) - e.tension(gamma)).abs();
            assert!(error(5e-4) < 1e-10 || error(1e-3) / error(5e-4) > 3.5);
            let error = |h: f64| ((e.tension(gamma + h) - e.tension(gamma - h)) / (2.0 * h) - e.tangent(gamma)).abs();
            assert!(error(5e-4) < 1e-10);
        }
    }

    #[test]
    fn every_law_has_the_derivatives_that_it_says() {
        let e = element();
        let laws = [
            Law::Spring { alpha: 0.9 },
            Law::Tension(0.7),
            Law::Elastic { tension: 0.4, length: 1.0, stiffness: 2.0 },
            Law::Elastic { tension: 0.4, length: 1.4, stiffness: 2.0 },
        ];
        for law in laws {
            for length in [0.7, 0.95, 1.3] {
                let h = 1e-5;
                let by_energy = (law.energy(&e, length + h) - law.energy(&e, length - h)) / (2.0 * h);
                let (tau, tangent) = law.tension_and_tangent(&e, length);
                assert!((by_energy - tau).abs() < 1e-9, "{law:?} at {length}");
                let [up, down] = [h, -h].map(|h| law.tension_and_tangent(&e, length + h).0);
                assert!(((up - down) / (2.0 * h) - tangent).abs() < 1e-8, "{law:?} at {length}");
            }
        }
    }

    #[test]
    fn deformation_inverts_tension() {
        let e = element();
        assert_eq!(e.deformation(0.0), -e.epsilon);
        for tension in [1e-6, 0.05, 0.12, 0.5, 40.0] {
            assert!((e.tension(e.deformation(tension)) - tension).abs() < 1e-12 * (1.0 + tension));
        }
    }
}
