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
    Ok(settle(problem, &inner, &frame, &mut model, stop).0)
}

/// [`equilibrium`] in a model that is built already, and the coordinates in the frame.
pub(super) fn settle(
    problem: &Problem,
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
        energy: state.energy * frame.energy() + potential_of_origin(problem, frame),
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

/// What terms that depend on where the body is have lost with the move into the frame, J: the energy in gravity of the whole mass at
/// the frame's origin.
fn potential_of_origin(problem: &Problem, frame: &Frame) -> f64 {
    let (Some(g), Some(density)) = (problem.gravity, problem.surface_density) else { return 0.0 };
    let area: f64 = problem.mesh.triangles.iter().map(|t| problem.mesh.area(t)).sum();
    -density * area * (g[0] * frame.origin[0] + g[1] * frame.origin[1])
}
