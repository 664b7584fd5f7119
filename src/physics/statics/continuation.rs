//! Continuation in stiffness: very stiff springs are first taken as soft ones.
//!
//! A cable `K` times stiffer than the body, contracted at once, starts with a tension of `K` times its stretch. Newton's method
//! then creeps along the curved valley in which the length of the cable is right: a step that is right to first order
//! misses that length to second order, `K` times magnified. With the stiffness limited to ten shear moduli the way is short;
//! from there on each stage a hundred times stiffer only has to take away the rest of the stretch, and starts next to its answer.
//! Pins are springs like any other, and so is a nearly incompressible material against changes of its area; that one shows only
//! when Newton's method has been slow for a while.

use super::state::StaticsSettings;
use crate::physics::Law;
use crate::physics::hyperelastic::Hyperelastic;
use crate::physics::model::Model;

/// Stiffness of the first stage, in shear moduli.
const FIRST: f64 = 10.0;
/// From one stage to the next.
const GROWTH: f64 = 100.0;
/// Springs up to this many shear moduli need none of this.
const STIFF: f64 = 300.0;
/// Forces, in shear moduli times the length of the spring (of the body, for pins), from which on a start counts as far from balance:
/// no body lives under them.
const OVERSTRAINED: f64 = 30.0;
/// Half-width of an element's smooth zone in a stage of stiffness `K`: its rest length times this many `mu/K`, what it stretches by
/// under moderate forces.
const SMOOTHING: f64 = 0.1;

/// How far each stage is settled: enough to start the next one.
pub(super) const SETTINGS: StaticsSettings =
    StaticsSettings { tolerance: 1e-5, stagnation_tolerance: 1e-5, max_iterations: 25 };

/// Whether a stiff spring is strained beyond measure at `x`.
pub(super) fn is_wanted(model: &Model, x: &[f64]) -> bool {
    let mu = model.body.material().shear_modulus();
    let contractile = &model.contractile;
    let by_elements = contractile.elements.iter().zip(&contractile.laws).any(|(e, law)| {
        let far = || law.tension_and_tangent(e, e.length(x)).0 > OVERSTRAINED * mu * e.alpha0;
        matches!(law, Law::Spring { .. }) && e.stiffness > STIFF * mu && far()
    });
    let length = model.body.area().sqrt();
    by_elements
        || model.pins.pins.iter().any(|pin| {
            let [fx, fy] = pin.force(x);
            pin.stiffness > STIFF * mu && fx.hypot(fy) > OVERSTRAINED * mu * length
        })
}

/// Whether the material is far stiffer against changes of area than of shape.
pub(super) fn is_bulky(model: &Model) -> bool {
    let material = model.body.material();
    material.largest_modulus() > STIFF * material.shear_modulus()
}

/// The limits on stiffness, one a stage, ascending; the last stage is the model itself.
pub(super) fn stages(model: &Model) -> Vec<f64> {
    let mu = model.body.material().shear_modulus();
    let elements = model.contractile.elements.iter().map(|e| e.stiffness);
    let bulk = model.body.material().largest_modulus();
    let stiffest = elements.chain(model.pins.pins.iter().map(|p| p.stiffness)).fold(bulk, f64::max);
    let mut stages = Vec::new();
    let mut limit = FIRST * mu;
    while limit < stiffest {
        stages.push(limit);
        limit *= GROWTH;
    }
    stages
}

/// Newton steps that a nearly incompressible body gets before it is taken step by step.
pub(super) const FIRST_TRY: usize = 30;

/// What a stage changed: the material, stiffness and half-width of every element, stiffness of every pin.
pub(super) struct Kept {
    material: Option<Box<dyn Hyperelastic>>,
    elements: Vec<(f64, f64)>,
    pins: Vec<f64>,
}

/// Limits the stiffness of all springs.
pub(super) fn enter(model: &mut Model, limit: f64) -> Kept {
    let mu = model.body.material().shear_modulus();
    let elements = model.contractile.elements.iter_mut().map(|e| {
        let kept = (e.stiffness, e.epsilon);
        if e.stiffness > limit {
            e.stiffness = limit;
            e.epsilon = e.epsilon.max(SMOOTHING * e.alpha0 * mu / limit);
        }
        kept
    });
    let elements = elements.collect();
    let pins = model.pins.pins.iter_mut().map(|p| {
        let kept = p.stiffness;
        p.stiffness = kept.min(limit);
        kept
    });
    let pins = pins.collect();
    Kept { material: model.body.soften(limit), elements, pins }
}

/// Puts everything back.
pub(super) fn leave(model: &mut Model, kept: Kept) {
    if let Some(material) = kept.material {
        model.body.set_material(material);
    }
    for (e, (stiffness, epsilon)) in model.contractile.elements.iter_mut().zip(kept.elements) {
        (e.stiffness, e.epsilon) = (stiffness, epsilon);
    }
    for (pin, stiffness) in model.pins.pins.iter_mut().zip(kept.pins) {
        pin.stiffness = stiffness;
    }
}
