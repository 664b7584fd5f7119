//! The statics of a problem: where the body rests at the given contractions, and which forces hold it there.

use super::error::ProblemError;
use super::failure::{Failure, Part};
use super::file::Problem;
use super::frame::Frame;
use super::model::take_model;
use crate::physics::{Model, StaticsSettings, precise, statics};

/// An equilibrium, or the best state on the way to one, in the units of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Statics {
    pub x: Vec<[f64; 2]>,
    /// J.
    pub energy: f64,
    /// N.
    pub tensions: Vec<f64>,
    /// Force by each pin on the body, N.
    pub pin_forces: Vec<[f64; 2]>,
    /// `max |dE/dx|`, N, with rounding of the coordinates taken out.
    pub residual: f64,
    /// The forces at work, N: the largest sum of magnitudes of the forces that meet in a node.
    pub force_scale: f64,
    pub iterations: usize,
    pub factorizations: usize,
    /// Iterations in which the Hessian had to be projected.
    pub projections: usize,
    pub smallest_determinant: f64,
    pub failure: Option<Failure>,
}

/// Solves the statics of a problem. `stop` is asked before every factorisation.
///
/// # Errors
/// [`ProblemError`] where no model can be made.
pub fn equilibrium(problem: &Problem, stop: &dyn Fn() -> bool) -> Result<Statics, ProblemError> {
    let frame = Frame::of(problem);
    let mut inner = frame.inside(problem);
    let mut model = take_model(&mut inner)?;
    Ok(settle(&inner, &frame, &mut model, stop).0)
}

/// [`equilibrium`] in a model that is built already, and the coordinates in the frame.
pub(super) fn settle(
    inner: &Problem,
    frame: &Frame,
    model: &mut Model,
    stop: &dyn Fn() -> bool,
) -> (Statics, Vec<f64>) {
    let start: Vec<f64> = inner.start.as_ref().unwrap_or(&inner.mesh.nodes).iter().flatten().copied().collect();
    let (mut state, cause) = match statics::minimum(model, &start, &StaticsSettings::default(), stop) {
        Ok(state) => (state, None),
        Err(error) => (error.best, Some(error.cause)),
    };
    let mut residual = state.residual;
    let mut force_scale = model.force_scale(&state.x);
    let mut tensions = model.contractile.tensions(&state.x);
    let mut pins: Vec<[f64; 2]> = model.pins.pins.iter().map(|p| p.force(&state.x)).collect();
    if cause.is_none() && !stop() {
        let forces = precise::refine(model, &mut state.x, stop);
        state.energy = model.energy(&state.x);
        state.factorizations += forces.factorizations;
        (residual, force_scale, tensions, pins) = (forces.residual, forces.scale, forces.tensions, forces.pins);
    }
    let unit = frame.force();
    let answer = Statics {
        x: frame.points(&state.x),
        energy: (state.energy + potential_of_origin(model, frame)) * frame.energy(),
        tensions: tensions.iter().map(|t| t * unit).collect(),
        pin_forces: pins.iter().map(|f| f.map(|v| v * unit)).collect(),
        residual: residual * unit,
        force_scale: force_scale * unit,
        iterations: state.iterations,
        factorizations: state.factorizations,
        projections: state.projections,
        smallest_determinant: model.body.smallest_determinant(&state.x),
        failure: cause.map(|cause| Failure::of(Part::Statics, cause, model)),
    };
    (answer, state.x)
}

/// The energy that optional terms have lost with the move into the frame, in its units: that of the shift of the body to the frame's origin.
fn potential_of_origin(model: &Model, frame: &Frame) -> f64 {
    let origin = frame.origin.map(|o| o / frame.length);
    model.terms.iter().map(|term| term.of_shift(origin)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, json};

    const ORIGIN: [f64; 2] = [7.0, -3.0];
    const GRAVITY: [f64; 2] = [0.4, -9.81];
    const DENSITY: f64 = 0.06;

    /// Statics of a square of 0.1 m at [`ORIGIN`] that hangs from two corners, with more in the file.
    fn hanging(more: &Value) -> Statics {
        let [x, y] = ORIGIN;
        let nodes = json!([[x, y], [x + 0.1, y], [x + 0.1, y + 0.1], [x, y + 0.1]]);
        let pins = [2, 3].map(|node| json!({ "node": node, "target": nodes[node], "K": 1e6 }));
        let mut file = json!({
            "format": "plushwright-problem/1",
            "mesh": { "nodes": nodes, "triangles": [[0, 1, 2], [0, 2, 3]] },
            "material": { "mu": 1e3, "kappa": 1e3 },
            "pins": pins,
        });
        for (key, value) in more.as_object().unwrap() {
            file[key] = value.clone();
        }
        let (problem, _) = crate::problem::read(&file.to_string()).unwrap();
        equilibrium(&problem, &|| false).unwrap()
    }

    #[test]
    fn gravity_has_the_same_energy_as_a_field_and_among_the_terms() {
        let field = hanging(&json!({ "gravity": GRAVITY, "surface_density": DENSITY }));
        let term =
            hanging(&json!({ "terms": [{ "Gravity": { "acceleration": GRAVITY, "surface_density": DENSITY } }] }));
        assert_eq!(field, term);
        // The body hardly gives: its weight at the middle of the square.
        let closed = -DENSITY * 0.01 * (GRAVITY[0] * (ORIGIN[0] + 0.05) + GRAVITY[1] * (ORIGIN[1] + 0.05));
        assert!((field.energy - closed).abs() < 1e-3 * closed.abs(), "{:e} and {closed:e}", field.energy);
    }
}
