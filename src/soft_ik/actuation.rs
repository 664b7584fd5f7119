//! From winch activations to contractions: `alpha_c = Z beta` (eqs. 21 to 27), with true bounds.

/// A winch that the solver may turn.
#[derive(Clone, Debug, PartialEq)]
pub struct Winch {
    /// Elements it winds and their entries of `Z`.
    pub members: Vec<(usize, f64)>,
    /// Bounds of its activation; infinite where there is none.
    pub lower: f64,
    pub upper: f64,
}

/// Free winches, and contractions that stay as they are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Actuation {
    pub winches: Vec<Winch>,
    /// Contraction of every element that belongs to no free winch (entries of others are ignored).
    pub fixed: Vec<f64>,
}

impl Actuation {
    /// `alpha_c` of every element.
    pub fn contractions(&self, beta: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; self.fixed.len()];
        self.contractions_into(beta, &mut out);
        out
    }

    /// [`Self::contractions`] into `out`.
    pub fn contractions_into(&self, beta: &[f64], out: &mut [f64]) {
        out.copy_from_slice(&self.fixed);
        for (winch, b) in self.winches.iter().zip(beta) {
            for &(element, ratio) in &winch.members {
                out[element] = ratio * b;
            }
        }
    }

    /// `Z^T v`: collects a derivative by contraction into one by activation.
    pub fn collect(&self, by_contraction: &[f64]) -> Vec<f64> {
        self.winches.iter().map(|w| w.members.iter().map(|&(e, ratio)| ratio * by_contraction[e]).sum()).collect()
    }

    /// `beta` moved to the nearest admissible value.
    pub fn clamp(&self, beta: &mut [f64]) {
        for (b, w) in beta.iter_mut().zip(&self.winches) {
            *b = b.max(w.lower).min(w.upper);
        }
    }

    /// Whether every free winch winds exactly one element (muscle fibres): tension can be the unknown.
    pub fn is_fibers_only(&self) -> bool {
        self.winches.iter().all(|w| w.members.len() == 1)
    }
}
