//! What a problem file must fulfil beyond its JSON: every figure is named by its key and index.

use super::error::{ProblemError, content, finite};
use super::file::Problem;
use super::limits;
use crate::physics::Parameter;
use std::fmt::Display;

impl Problem {
    /// Refuses what is contradictory or beyond the limits of what can be computed.
    pub(super) fn check(&self) -> Result<(), ProblemError> {
        let n = self.mesh.nodes.len();
        for (i, p) in self.mesh.nodes.iter().enumerate() {
            finite_point(format_args!("mesh.nodes[{i}]"), p)?;
        }
        if self.mesh.triangles.is_empty() {
            return Err(content("mesh.triangles", "is empty"));
        }
        for (i, t) in self.mesh.triangles.iter().enumerate() {
            let key = format_args!("mesh.triangles[{i}]");
            for node in t {
                in_range(key, *node, n)?;
            }
        }
        for (parameter, values) in self.material.each() {
            finite(format_args!("material.{}", parameter.name), values[0])?;
        }
        limits::size(self)?;
        for (i, t) in self.mesh.triangles.iter().enumerate() {
            let key = format_args!("mesh.triangles[{i}]");
            let area = self.mesh.area(t);
            if area < 0.0 {
                return Err(content(key, "is clockwise"));
            }
            if area.is_nan() || area <= 0.0 || !area.is_finite() {
                return Err(content(key, "has no area"));
            }
        }
        for (parameter, values) in self.material.each() {
            allowed(format_args!("material.{}", parameter.name), parameter, values)?;
        }
        self.check_elements(n)?;
        for (i, pin) in self.pins.iter().enumerate() {
            let key = format_args!("pins[{i}]");
            in_range(format_args!("{key}.node"), pin.node, n)?;
            finite_point(format_args!("{key}.target"), &pin.target)?;
            not_negative(format_args!("{key}.K"), pin.stiffness)?;
        }
        length("contractions", self.contractions.as_ref().map(Vec::len), self.elements.len(), "elements")?;
        for (i, c) in self.contractions.iter().flatten().enumerate() {
            finite(format_args!("contractions[{i}]"), *c)?;
        }
        if let Some(objective) = &self.objective {
            not_negative("objective.default_weight", objective.default_weight)?;
            not_negative("objective.regulariser", objective.regulariser)?;
            for (i, t) in objective.targets.iter().enumerate() {
                let key = format_args!("objective.targets[{i}]");
                in_range(format_args!("{key}.node"), t.node, n)?;
                finite_point(format_args!("{key}.xy"), &t.xy)?;
                not_negative(format_args!("{key}.weight"), t.weight)?;
            }
        }
        self.check_soft_ik()?;
        length("start", self.start.as_ref().map(Vec::len), n, "nodes")?;
        for (i, p) in self.start.iter().flatten().enumerate() {
            finite_point(format_args!("start[{i}]"), p)?;
        }
        if let Some(g) = &self.gravity {
            finite_point("gravity", g)?;
            if self.surface_density.is_none() {
                return Err(content("surface_density", "missing, gravity needs it"));
            }
        }
        if let Some(density) = self.surface_density {
            not_negative("surface_density", density)?;
        }
        for (i, term) in self.terms.iter().enumerate() {
            for (parameter, values) in term.each() {
                allowed(format_args!("terms[{i}].{}", parameter.name), parameter, values)?;
            }
        }
        self.check_drag()?;
        limits::check(self)
    }

    fn check_elements(&self, nodes: usize) -> Result<(), ProblemError> {
        for (i, e) in self.elements.iter().enumerate() {
            let key = format_args!("elements[{i}]");
            if e.routing.len() < 2 {
                return Err(content(format_args!("{key}.routing"), "needs at least two nodes"));
            }
            for (k, node) in e.routing.iter().enumerate() {
                in_range(format_args!("{key}.routing[{k}]"), *node, nodes)?;
                if k > 0 && e.routing[k - 1] == *node {
                    return Err(content(format_args!("{key}.routing[{k}]"), format!("node {node} twice in a row")));
                }
            }
            not_negative(format_args!("{key}.K"), e.stiffness)?;
            for (name, value) in [("epsilon", e.epsilon), ("alpha0", e.alpha0)] {
                finite(format_args!("{key}.{name}"), value)?;
                if value <= 0.0 {
                    return Err(content(format_args!("{key}.{name}"), format!("must be positive, is {value}")));
                }
            }
        }
        Ok(())
    }

    fn check_soft_ik(&self) -> Result<(), ProblemError> {
        let free = self.free_winches()?;
        let Some(ik) = &self.soft_ik else { return Ok(()) };
        let count = free.len();
        length("soft_ik.beta_upper", ik.beta_upper.as_ref().map(Vec::len), count, "winches")?;
        length("soft_ik.beta_lower", ik.beta_lower.as_ref().map(Vec::len), count, "winches")?;
        length("soft_ik.beta_start", ik.beta_start.as_ref().map(Vec::len), count, "winches")?;
        for j in 0..count {
            let upper = ik.beta_upper.as_ref().and_then(|u| u[j]);
            let lower = ik.beta_lower.as_ref().and_then(|l| l[j]);
            for (name, value) in [("beta_upper", upper), ("beta_lower", lower)] {
                finite(format_args!("soft_ik.{name}[{j}]"), value.unwrap_or(0.0))?;
            }
            if let (Some(lower), Some(upper)) = (lower, upper)
                && lower > upper
            {
                return Err(content(
                    format_args!("soft_ik.beta_lower[{j}]"),
                    format!("{lower} is above the upper {upper}"),
                ));
            }
            finite(format_args!("soft_ik.beta_start[{j}]"), ik.beta_start.as_ref().map_or(0.0, |b| b[j]))?;
        }
        Ok(())
    }

    fn check_drag(&self) -> Result<(), ProblemError> {
        let Some(drag) = &self.drag else { return Ok(()) };
        let Some(objective) = &self.objective else {
            return Err(content("objective", "missing, drag needs its targets"));
        };
        not_negative("drag.tension_regulariser", drag.tension_regulariser)?;
        for (k, frame) in drag.frames.iter().enumerate() {
            length(format_args!("drag.frames[{k}]"), Some(frame.len()), objective.targets.len(), "targets")?;
            for (t, p) in frame.iter().enumerate() {
                finite_point(format_args!("drag.frames[{k}][{t}]"), p)?;
            }
        }
        for (i, k) in drag.report.iter().enumerate() {
            if *k >= drag.frames.len() {
                let what = format!("frame {k} is out of range, there are {}", drag.frames.len());
                return Err(content(format_args!("drag.report[{i}]"), what));
            }
        }
        Ok(())
    }
}

/// Whether the values of a parameter have the sign that the catalogue asks for, and, where they are plain numbers, are in its range.
/// Other sizes are those of the body, see [`limits`].
fn allowed(key: impl Display, parameter: &Parameter, values: &[f64]) -> Result<(), ProblemError> {
    let [low, high] = parameter.range;
    for &value in values {
        finite(&key, value)?;
        if low > 0.0 && value <= 0.0 {
            return Err(content(key, format!("must be positive, is {value}")));
        }
        if low == 0.0 && value < 0.0 {
            return Err(content(key, format!("must not be negative, is {value}")));
        }
        if parameter.unit.is_empty() && !(low..=high).contains(&value) {
            return Err(content(key, format!("must be from {low} to {high}, is {value}")));
        }
    }
    Ok(())
}

fn in_range(key: impl Display, node: usize, nodes: usize) -> Result<(), ProblemError> {
    if node < nodes { Ok(()) } else { Err(content(key, format!("node {node} is out of range, the mesh has {nodes}"))) }
}

fn finite_point(key: impl Display, p: &[f64; 2]) -> Result<(), ProblemError> {
    finite(&key, p[0]).and_then(|()| finite(&key, p[1]))
}

fn not_negative(key: impl Display, value: f64) -> Result<(), ProblemError> {
    finite(&key, value)?;
    if value < 0.0 { Err(content(key, format!("must not be negative, is {value}"))) } else { Ok(()) }
}

fn length(key: impl Display, actual: Option<usize>, expected: usize, of: &str) -> Result<(), ProblemError> {
    match actual {
        Some(n) if n != expected => Err(content(key, format!("has {n} entries, there are {expected} {of}"))),
        _ => Ok(()),
    }
}
