//! How extreme a problem may be: beyond these limits `f64` cannot hold the answer, and a file is refused with the key that
//! goes beyond.
//!
//! Sizes and moduli may be nearly anything, since a problem is solved in the frame of its own body ([`super::frame`]). What counts
//! is how far the figures of one problem lie apart.

use super::error::ProblemError;
use super::file::Problem;
use super::frame::box_of;
use crate::physics::catalogue::Dimension;
use std::fmt::Arguments;

/// Size of the body, m, and shear modulus, N/m: from its inverse to this. Energies and objectives stay within `f64`.
const LARGEST_UNIT: f64 = 1e90;
/// Largest distance of anything from the body's centre, in body lengths. At this distance a position still has four digits
/// of the body's size.
const FARTHEST: f64 = 1e12;
/// Largest distance of the body from the origin, in body lengths: farther away its own nodes have less than four digits.
const FARTHEST_ORIGIN: f64 = 1e12;
/// Largest rest length and contraction of an element, in body lengths.
const LONGEST: f64 = 1e4;
/// Largest stiffness or force, in shear moduli (times body lengths): forces and energies still have digits beside each other.
const STIFFEST: f64 = 1e18;
/// Smallest epsilon and rest length of an element, in body lengths: far below the rounding of any length.
const SHORTEST: f64 = 1e-30;

/// Checks size and place of a body whose node ids are in range and whose coordinates are finite.
pub(super) fn size(problem: &Problem) -> Result<(), ProblemError> {
    let (size, centre) = measure(problem);
    if size <= 0.0 {
        return Ok(()); // All triangles are flat, which is said better elsewhere.
    }
    if !(1.0 / LARGEST_UNIT..=LARGEST_UNIT).contains(&size) {
        let what = format!("the body is {size:e} m across, beyond {:e} to {LARGEST_UNIT:e}", 1.0 / LARGEST_UNIT);
        return Err(ProblemError::Content { key: "mesh.nodes".into(), what });
    }
    let distance = centre[0].abs().max(centre[1].abs()) / size;
    if distance > FARTHEST_ORIGIN {
        let what = format!("the body is {distance:.1e} body lengths from the origin, beyond {FARTHEST_ORIGIN:e}");
        return Err(ProblemError::Content { key: "mesh.nodes".into(), what });
    }
    Ok(())
}

/// Checks everything else of a problem that is sound in itself.
pub(super) fn check(problem: &Problem) -> Result<(), ProblemError> {
    let (size, centre) = measure(problem);
    let mu = problem.material.shear_modulus();
    if !(1.0 / LARGEST_UNIT..=LARGEST_UNIT).contains(&mu) {
        let what = format!("{mu:e} is beyond {:e} to {LARGEST_UNIT:e}", 1.0 / LARGEST_UNIT);
        return Err(ProblemError::Content { key: "material.mu".into(), what });
    }
    let near = |key: Arguments, p: &[f64; 2]| {
        let distance = (p[0] - centre[0]).abs().max((p[1] - centre[1]).abs()) / size;
        within(key, distance, FARTHEST, "body lengths away")
    };
    let stiff = |key: Arguments, value: f64| within(key, value.abs() / mu, STIFFEST, "shear moduli");
    let long = |key: Arguments, value: f64| within(key, value.abs() / size, LONGEST, "body lengths");
    for (i, p) in problem.mesh.nodes.iter().enumerate() {
        near(format_args!("mesh.nodes[{i}]"), p)?;
    }
    for (i, p) in problem.start.iter().flatten().enumerate() {
        near(format_args!("start[{i}]"), p)?;
    }
    let moduli = problem.material.each().skip(1).filter(|(parameter, _)| parameter.dimension == Dimension::MODULUS);
    for (parameter, values) in moduli {
        stiff(format_args!("material.{}", parameter.name), values[0])?;
    }
    for (i, e) in problem.elements.iter().enumerate() {
        stiff(format_args!("elements[{i}].K"), e.stiffness)?;
        for (name, value) in [("epsilon", e.epsilon), ("alpha0", e.alpha0)] {
            let key = format_args!("elements[{i}].{name}");
            long(key, value)?;
            within(key, size / value, 1.0 / SHORTEST, "times below the body length")?;
        }
    }
    for (i, c) in problem.contractions.iter().flatten().enumerate() {
        long(format_args!("contractions[{i}]"), *c)?;
    }
    for (i, pin) in problem.pins.iter().enumerate() {
        near(format_args!("pins[{i}].target"), &pin.target)?;
        stiff(format_args!("pins[{i}].K"), pin.stiffness)?;
    }
    if let (Some(g), Some(density)) = (problem.gravity, problem.surface_density) {
        for component in g {
            within(format_args!("gravity"), component.abs() * density * size / mu, STIFFEST, "shear moduli")?;
        }
    }
    for (i, term) in problem.terms.iter().enumerate() {
        for (parameter, values) in term.each() {
            let unit = parameter.dimension.unit(mu, size);
            for value in values {
                within(
                    format_args!("terms[{i}].{}", parameter.name),
                    value.abs() / unit,
                    STIFFEST,
                    "units of the body",
                )?;
            }
        }
    }
    if let Some(objective) = &problem.objective {
        for (i, t) in objective.targets.iter().enumerate() {
            near(format_args!("objective.targets[{i}].xy"), &t.xy)?;
        }
    }
    activations(problem, size)?;
    for (k, frame) in problem.drag.iter().flat_map(|d| d.frames.iter().enumerate()) {
        for (t, p) in frame.iter().enumerate() {
            near(format_args!("drag.frames[{k}][{t}]"), p)?;
        }
    }
    Ok(())
}

/// Checks bounds, start and fixed activations of the winches.
fn activations(problem: &Problem, size: f64) -> Result<(), ProblemError> {
    let Some(ik) = &problem.soft_ik else { return Ok(()) };
    let long = |key: Arguments, value: f64| within(key, value.abs() / size, LONGEST, "body lengths");
    for (name, list) in [("beta_upper", &ik.beta_upper), ("beta_lower", &ik.beta_lower)] {
        for (j, v) in list.iter().flatten().enumerate() {
            long(format_args!("soft_ik.{name}[{j}]"), v.unwrap_or(0.0))?;
        }
    }
    for (j, v) in ik.beta_start.iter().flatten().enumerate() {
        long(format_args!("soft_ik.beta_start[{j}]"), *v)?;
    }
    for (id, v) in ik.fixed_winches.iter().flatten() {
        long(format_args!("soft_ik.fixed_winches.{id}"), *v)?;
    }
    Ok(())
}

/// Longer side and centre of the rest shape's box.
fn measure(problem: &Problem) -> (f64, [f64; 2]) {
    let [low, high] = box_of(problem);
    let centre = [0, 1].map(|axis| 0.5 * low[axis] + 0.5 * high[axis]);
    ((high[0] - low[0]).max(high[1] - low[1]), centre)
}

fn within(key: Arguments, value: f64, limit: f64, of: &str) -> Result<(), ProblemError> {
    // A quotient that overflowed is as far beyond as one that did not.
    if value <= limit {
        return Ok(());
    }
    let value = if value.is_finite() { format!("{value:.1e}") } else { "too many".into() };
    Err(ProblemError::Content {
        key: key.to_string(),
        what: format!("is {value} {of}, at most {limit:e} can be computed"),
    })
}
