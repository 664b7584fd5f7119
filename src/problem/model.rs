//! The physics model of a problem.

use super::error::ProblemError;
use super::file::Problem;
use crate::physics::{
    Body, Contractile, Element, Energy, Gravity, Ground, MaterialPoint, Model, ModelError, PinSpring, Pins,
};

/// The physics model of a problem, at its `contractions` (zero if absent).
///
/// # Errors
/// [`ProblemError`]: a triangle without area, or a mesh beyond the memory.
pub fn model(problem: &Problem) -> Result<Model, ProblemError> {
    take_model(&mut problem.clone())
}

/// [`model`]; takes the routings out of the problem, which has no further use for them.
pub(super) fn take_model(problem: &mut Problem) -> Result<Model, ProblemError> {
    let content = |key: String, what: &str| ProblemError::Content { key, what: what.into() };
    let body = Body::new(&problem.mesh.nodes, &problem.mesh.triangles, problem.material.build(), None)
        .map_err(|k| content(format!("mesh.triangles[{k}]"), "has no area"))?;
    let elements = problem.elements.iter_mut().map(|e| Element {
        routing: MaterialPoint::through(std::mem::take(&mut e.routing)),
        stiffness: e.stiffness,
        epsilon: e.epsilon,
        alpha0: e.alpha0,
    });
    let contractile = Contractile::new(elements.collect());
    let pins = Pins { pins: problem.pins.iter().map(|p| PinSpring::node(p.node, p.target, p.stiffness)).collect() };
    let terms = terms(problem, &body.nodal_areas(problem.mesh.nodes.len()));
    let mut model = Model::new(&problem.mesh.nodes, body, contractile, pins, terms).map_err(|e| match e {
        ModelError::Triangle(k) => content(format!("mesh.triangles[{k}]"), "has no area"),
        ModelError::Memory => content("mesh".into(), "is too large for the memory of this machine"),
    })?;
    model.contractile.set_contractions(&contractions(problem));
    Ok(model)
}

/// The optional energy terms of a problem.
fn terms(problem: &Problem, nodal_areas: &[f64]) -> Vec<Box<dyn Energy>> {
    let ground = Ground { nodes: &problem.mesh.nodes, triangles: &problem.mesh.triangles, nodal_areas };
    let mut terms: Vec<Box<dyn Energy>> = Vec::new();
    if let (Some(acceleration), Some(density)) = (problem.gravity, problem.surface_density) {
        terms.push(Box::new(Gravity::new(nodal_areas, density, acceleration)));
    }
    terms.extend(problem.terms.iter().map(|term| term.build(&ground)));
    terms
}

pub(super) fn contractions(problem: &Problem) -> Vec<f64> {
    problem.contractions.clone().unwrap_or_else(|| vec![0.0; problem.elements.len()])
}
