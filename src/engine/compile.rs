//! A design becomes a physics model: the idealized plushie (networks and fibres) or the realizable one (networks alone).

use super::patch;
use crate::defaults;
use crate::design::Target;
use crate::design::{Design, Material, Network};
use crate::physics::material;
use crate::physics::{
    Body, Contractile, Element, Energy, Gravity, Model, ModelError, NeoHookean, Pin, Pins, StVenantKirchhoff,
};
use crate::soft_ik::{Objective, PointTarget, Winch};
use std::ops::Range;

/// Which of the two plushies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    Idealized,
    Realizable,
}

/// A compiled plushie. Elements: the tendons, network by network, then the fibres.
pub struct Plushie {
    pub model: Model,
    /// One winch per network.
    pub winches: Vec<Winch>,
    /// One winch per fibre; empty for the realizable plushie.
    pub fibers: Vec<Winch>,
    pub tendons: Range<usize>,
    pub fiber_elements: Range<usize>,
    /// Rest area of each node as a part of the body's.
    pub area_parts: Vec<f64>,
}

/// Compiles a view of a (valid) design.
///
/// The initial rest length of an element is its length in the rest mesh plus its slack plus `epsilon`: contraction zero is the
/// just-slack state, in which nothing pulls at rest.
pub fn compile(design: &Design, view: View) -> Result<Plushie, ModelError> {
    let mesh = &design.mesh;
    let law: Box<dyn material::Material> = match design.material {
        Material::NeoHookean { mu, kappa } => Box::new(NeoHookean { mu, kappa }),
        Material::StVenantKirchhoff { mu, lambda } => Box::new(StVenantKirchhoff { mu, lambda }),
    };
    let body =
        Body::new(&mesh.nodes, &mesh.triangles, law, design.stiffness_map.as_deref()).map_err(ModelError::Triangle)?;
    let rest_length =
        |routing: &[usize]| -> f64 { routing.windows(2).map(|s| distance(mesh.nodes[s[0]], mesh.nodes[s[1]])).sum() };
    let mut elements = Vec::new();
    let winches = design.networks.iter().map(|n| winch(design, n, &mut elements, &rest_length)).collect();
    let tendons = 0..elements.len();
    let mut fibers = Vec::new();
    if view == View::Idealized {
        let routings = design.fiber_routings();
        let lengths: Vec<f64> = routings.iter().map(|r| rest_length(r)).collect();
        let mean = lengths.iter().sum::<f64>() / lengths.len().max(1) as f64;
        let epsilon = design.fibers.epsilon_fraction * mean;
        for (routing, length) in routings.into_iter().zip(lengths) {
            let limit = design.fibers.max_contraction * length;
            fibers.push(Winch { members: vec![(elements.len(), 1.0)], lower: -limit, upper: limit });
            elements.push(Element { routing, stiffness: design.fibers.stiffness, epsilon, alpha0: length + epsilon });
        }
    }
    let fiber_elements = tendons.end..elements.len();
    let pins = design.pins.iter().map(|pin| {
        let (nodes, weights) = patch::point(mesh, &pin.at);
        let anchor = pin.position.unwrap_or_else(|| mesh.position(&pin.at, &mesh.nodes));
        Pin { nodes, weights, anchor, stiffness: pin.stiffness }
    });
    let pins = Pins { pins: pins.collect() };
    let areas = body.nodal_areas(mesh.nodes.len());
    let mut terms: Vec<Box<dyn Energy>> = Vec::new();
    if let Some(gravity) = &design.gravity {
        terms.push(Box::new(Gravity::new(&areas, gravity.surface_density, gravity.acceleration)));
    }
    let total: f64 = areas.iter().sum();
    let area_parts = areas.into_iter().map(|a| a / total).collect();
    let model = Model::new(&mesh.nodes, body, Contractile::new(elements), pins, terms)?;
    Ok(Plushie { model, winches, fibers, tendons, fiber_elements, area_parts })
}

/// One network: its tendons become elements, its winch may turn as far as every tendon allows (eq. 27). Cable beyond the
/// rest length is wound on the spool at assembly, so a winch may also pay out as much as it may take in.
fn winch(
    design: &Design,
    network: &Network,
    elements: &mut Vec<Element>,
    rest_length: &dyn Fn(&[usize]) -> f64,
) -> Winch {
    let epsilon = design.tendons.epsilon_mm;
    let mut out = Winch { members: Vec::new(), lower: 0.0, upper: f64::INFINITY };
    for tendon in &network.tendons {
        let length = rest_length(&tendon.routing);
        out.upper = out.upper.min((design.tendons.max_contraction * length + tendon.slack_mm) / tendon.ratio);
        out.members.push((elements.len(), tendon.ratio));
        elements.push(Element {
            routing: tendon.routing.clone(),
            stiffness: design.tendons.stiffness,
            epsilon,
            alpha0: length + tendon.slack_mm + epsilon,
        });
    }
    if !out.upper.is_finite() {
        out.upper = 0.0;
    }
    out.lower = -out.upper;
    out
}

/// What `targets` ask of a compiled plushie.
pub fn objective(design: &Design, plushie: &Plushie, targets: &[Target]) -> Objective {
    let mu = plushie.model.body.material().shear_modulus();
    Objective {
        targets: targets
            .iter()
            .map(|t| {
                let (nodes, weights) = patch::patch(&design.mesh, &t.at);
                PointTarget { nodes, weights, goal: t.to, weight: t.weight }
            })
            .collect(),
        rest_weights: plushie.area_parts.iter().map(|a| defaults::REST_WEIGHT * a).collect(),
        rest: plushie.model.rest.clone(),
        contraction_weight: 0.0,
        tension_weight: defaults::TENSION_WEIGHT / (mu * mu),
    }
}

fn distance(p: [f64; 2], q: [f64; 2]) -> f64 {
    (q[0] - p[0]).hypot(q[1] - p[1])
}
