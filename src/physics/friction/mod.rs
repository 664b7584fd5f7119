//! Friction of cables at the holes they pass (capstan equation, Euler and Eytelwein).
//!
//! Along a cable wound from its winch, the first point of its routing, the tension falls at every hole by the angle that the cable
//! turns there, in the *present* shape. With the tension `tau` at the winch, piece `k` carries `tau w_k`:
//!
//! ```text
//! w_k = exp(-s mu sum_{j <= k} theta_j)     theta_j the turn at hole j, between the pieces j-1 and j;  w_0 = 1
//! tau = U'(Gamma)                           Gamma = sum_k l_k - alpha: what the winch takes in is true length
//! r(x) = dE/dx + sum tau (g_w - g) = 0      g = sum_k grad l_k,  g_w = sum_k w_k grad l_k
//! ```
//!
//! `s = 1` where every cable is being pulled and `s = -1` where it is being let out: the two ends of a band within which the body
//! stays where it was ([`Direction`]). All cables slide the same way; a cable that another one drags back through its holes is
//! not told apart. The law has no energy and its Jacobian no symmetry. It is the symmetric matrix `H` that statics factorises, with
//! the curvature of each piece weighted, and a border of few columns ([`Bordered`]): with `a_j = -s mu tau sum_{k >= j} w_k grad l_k`,
//!
//! ```text
//! dr/dx = H + sum U'' (g_w - g) g^T + sum_j a_j (dtheta_j/dx)^T
//! ```
//!
//! which is solved by the Woodbury identity. Weights are differentiated like all else, so that Newton's method converges
//! quadratically and sensitivities are exact. Elements without a coefficient cost nothing.

mod bordered;
mod cable;
mod settle;

pub use bordered::Bordered;
pub use settle::{Fault, FrictionError, SlidingState, follow, settle};

use super::Model;
use super::pattern::Slots;
use cable::{Cable, Piece};

/// Which way cables slide through their holes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Towards their winches: far pieces carry less than the winch pulls.
    Pulling,
    /// Away from them: far pieces carry more than the winch holds.
    LettingOut,
}

/// The cables of a model that rub, ready to be worked with.
pub struct Friction {
    cables: Vec<Cable>,
    /// Where the Hessians of all their pieces go.
    slots: Slots,
}

impl Friction {
    /// `coefficients`: `mu` of every element of the model, dimensionless; zero, or an element without holes, is one without friction.
    pub fn new(model: &Model, coefficients: &[f64]) -> Self {
        let elements = model.contractile.elements.iter().zip(coefficients).enumerate();
        let rubbing = elements.filter(|(_, (element, mu))| **mu > 0.0 && element.routing.len() > 2);
        let cables: Vec<Cable> = rubbing.map(|(k, (element, &mu))| Cable::new(k, element, mu)).collect();
        let slots = model.pattern().slots(cables.iter().flat_map(|c| &c.pieces).map(Piece::nodes));
        Self { cables, slots }
    }

    /// Whether nothing rubs.
    pub fn is_absent(&self) -> bool {
        self.cables.is_empty()
    }

    /// Tension of every piece of every element at `x`, from the winch outward.
    pub fn piece_tensions(&self, model: &Model, x: &[f64], direction: Direction) -> Vec<Vec<f64>> {
        let contractile = &model.contractile;
        let taus = contractile.tensions(x);
        let mut out: Vec<Vec<f64>> = taus
            .iter()
            .zip(&contractile.elements)
            .map(|(tau, e)| vec![*tau; e.routing.len().saturating_sub(1)])
            .collect();
        for cable in &self.cables {
            let weights = cable.weights(x, direction.sign());
            out[cable.element].iter_mut().zip(weights).for_each(|(tension, weight)| *tension *= weight);
        }
        out
    }

    /// Adds `factor * g_w` of an element, pulling, to `out`: the force of a unit tension at its winch.
    pub fn add_weighted_gradient(&self, model: &Model, element: usize, x: &[f64], factor: f64, out: &mut [f64]) {
        model.contractile.elements[element].add_length_gradient(x, factor, out);
        if let Some(cable) = self.cables.iter().find(|cable| cable.element == element) {
            cable.add_friction(x, Direction::Pulling.sign(), factor, out);
        }
    }

    /// `r(x)`, the unbalanced force, with `part` (from -1, letting out, to 1, pulling) of every coefficient.
    pub fn residual(&self, model: &Model, x: &[f64], part: f64, out: &mut [f64]) {
        model.gradient(x, out);
        for cable in &self.cables {
            let (tau, _) = cable.law(model, x);
            if tau > 0.0 {
                cable.add_friction(x, part, tau, out);
            }
        }
    }
}

impl Direction {
    /// `s`.
    fn sign(self) -> f64 {
        match self {
            Self::Pulling => 1.0,
            Self::LettingOut => -1.0,
        }
    }
}
