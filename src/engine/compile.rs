//! A design becomes a physics model: the idealized plushie (networks and fibres) or the realizable one (networks alone).

use super::body_spec::BodySpec;
use super::patch;
use crate::defaults;
use crate::design::Target;
use crate::design::{Design, Hold, Network, Pin, Tendon, TendonSettings};
use crate::mesh::Mesh;
use crate::physics::{Body, Contractile, Element, Energy, Ground, MaterialPoint, Model, ModelError, PinSpring, Pins};
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
///
/// # Errors
/// [`ModelError`] where a triangle has no area, or the matrix would not fit into memory.
pub fn compile(design: &Design, view: View) -> Result<Plushie, ModelError> {
    compile_body(&BodySpec::of(design), view)
}

/// The realizable plushie of a design with other networks than its own.
///
/// # Errors
/// As [`compile`].
pub fn compile_with(design: &Design, networks: &[Network]) -> Result<Plushie, ModelError> {
    compile_body(&BodySpec { networks, ..BodySpec::of(design) }, View::Realizable)
}

fn compile_body(spec: &BodySpec, view: View) -> Result<Plushie, ModelError> {
    let mesh = spec.mesh;
    let law = spec.material.build();
    let body = Body::new(&mesh.nodes, &mesh.triangles, law, spec.stiffness_map).map_err(ModelError::Triangle)?;
    let rest_length = |routing: &[MaterialPoint]| -> f64 {
        routing.windows(2).map(|s| distance(s[0].place(&mesh.nodes), s[1].place(&mesh.nodes))).sum()
    };
    let mut elements = Vec::new();
    let winches = spec.networks.iter().map(|n| winch(spec, n, &mut elements, &rest_length)).collect();
    let tendons = 0..elements.len();
    let mut fibers = Vec::new();
    if view == View::Idealized {
        let routings: Vec<_> = spec.fibers.routings(mesh).into_iter().map(MaterialPoint::through).collect();
        let lengths: Vec<f64> = routings.iter().map(|r| rest_length(r)).collect();
        let mean = lengths.iter().sum::<f64>() / lengths.len().max(1) as f64;
        let epsilon = spec.fibers.epsilon_fraction * mean;
        for (routing, length) in routings.into_iter().zip(lengths) {
            let limit = spec.fibers.max_contraction * length;
            fibers.push(Winch { members: vec![(elements.len(), 1.0)], lower: -limit, upper: limit });
            elements.push(Element { routing, stiffness: spec.fibers.stiffness, epsilon, alpha0: length + epsilon });
        }
    }
    let fiber_elements = tendons.end..elements.len();
    let pins = Pins { pins: spec.pins.iter().flat_map(|pin| springs(mesh, pin)).collect() };
    let areas = body.nodal_areas(mesh.nodes.len());
    let ground = Ground { nodes: &mesh.nodes, triangles: &mesh.triangles, nodal_areas: &areas };
    let terms: Vec<Box<dyn Energy>> = spec.terms.iter().map(|term| term.build(&ground)).collect();
    let total: f64 = areas.iter().sum();
    let area_parts = areas.into_iter().map(|a| a / total).collect();
    let model = Model::new(&mesh.nodes, body, Contractile::new(elements), pins, terms)?;
    Ok(Plushie { model, winches, fibers, tendons, fiber_elements, area_parts })
}

/// The springs of a pin. A region is held by one at each of its nodes, which share the stiffness; their anchors are where the nodes would
/// be if the region were moved and turned as a whole.
fn springs(mesh: &Mesh, pin: &Pin) -> Vec<PinSpring> {
    let (nodes, weights) = patch::point(mesh, &pin.at);
    let anchor = pin.anchor(mesh);
    let point =
        |slide| PinSpring { nodes: nodes.clone(), weights: weights.clone(), anchor, stiffness: pin.stiffness, slide };
    match pin.hold {
        Hold::Point => vec![point(None)],
        Hold::Line { degrees } => vec![point(Some([cos_degrees(degrees), sin_degrees(degrees)]))],
        Hold::Region { radius_mm, degrees } => {
            let center = mesh.position(&pin.at, &mesh.nodes);
            let held = patch::region(mesh, &pin.at, radius_mm);
            let (c, s) = (cos_degrees(degrees), sin_degrees(degrees));
            let place = |node: usize| {
                let [dx, dy] = [0, 1].map(|axis| mesh.nodes[node][axis] - center[axis]);
                [anchor[0] + c * dx - s * dy, anchor[1] + s * dx + c * dy]
            };
            let stiffness = pin.stiffness / held.len() as f64;
            held.into_iter().map(|node| PinSpring::node(node, place(node), stiffness)).collect()
        }
    }
}

/// Exact at the quarters of a turn, where a maker means the axes.
fn cos_degrees(degrees: f64) -> f64 {
    sin_degrees(degrees + 90.0)
}

fn sin_degrees(degrees: f64) -> f64 {
    match degrees.rem_euclid(360.0) {
        0.0 | 180.0 => 0.0,
        90.0 => 1.0,
        270.0 => -1.0,
        other => other.to_radians().sin(),
    }
}

/// One network: its tendons become elements, its winch may turn as far as every tendon allows (eq. 27). Cable beyond the
/// rest length is wound on the spool at assembly, so a winch may also pay out as much as it may take in.
fn winch(
    spec: &BodySpec,
    network: &Network,
    elements: &mut Vec<Element>,
    rest_length: &dyn Fn(&[MaterialPoint]) -> f64,
) -> Winch {
    let epsilon = spec.tendons.epsilon_mm;
    let mut out = Winch { members: Vec::new(), lower: 0.0, upper: f64::INFINITY };
    for tendon in &network.tendons {
        let length = rest_length(&tendon.routing);
        out.upper = out.upper.min(limit(spec.tendons, tendon, length));
        out.members.push((elements.len(), tendon.ratio));
        elements.push(Element {
            routing: tendon.routing.clone(),
            stiffness: spec.tendons.stiffness,
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

/// Cable that a winch can wind before the first of its tendons is as short as it may be, mm; it can pay out as much.
pub fn winch_reach_mm(design: &Design, network: &Network) -> f64 {
    let length = |tendon: &Tendon| -> f64 {
        let places = tendon.routing.iter().map(|point| point.place(&design.mesh.nodes));
        places.clone().zip(places.skip(1)).map(|(p, q)| distance(p, q)).sum()
    };
    let limits = network.tendons.iter().map(|tendon| limit(&design.tendons, tendon, length(tendon)));
    let least = limits.fold(f64::INFINITY, f64::min);
    if least.is_finite() { least } else { 0.0 }
}

/// Winding at which a tendon of this length is as short as it may be, mm.
fn limit(settings: &TendonSettings, tendon: &Tendon, length: f64) -> f64 {
    limit_of(settings, length, tendon.slack_mm, tendon.ratio)
}

/// Winding at which a cable of this length, slack at assembly and ratio of spools is as short as it may be, mm.
pub fn limit_of(settings: &TendonSettings, length: f64, slack_mm: f64, ratio: f64) -> f64 {
    (settings.max_contraction * length + slack_mm) / ratio
}

/// The objective that `targets` are for a compiled plushie.
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
