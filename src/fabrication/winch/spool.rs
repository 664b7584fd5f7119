//! The spool: a groove a thread between flanges, a hub with a shaft's bore and a set screw.

use crate::fabrication::prisms::{Slab, bar, circle, slices, stacked};
use crate::fabrication::solid::Solid;
use crate::outline::Point;

/// Hole for a set screw that cuts its own thread, mm: M3.
pub const SCREW_HOLE_MM: f64 = 2.5;
/// Slit in the flanges that a thread's knot is held in, mm wide.
const SLIT_MM: f64 = 0.8;
/// Step of a flange's slope, which a printer makes without support, mm.
const SLOPE_MM: f64 = 0.6;

/// A groove for one thread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Groove {
    /// The tendon of the network, counted from 0, and the face of the body.
    pub tendon: usize,
    pub back: bool,
    /// Of its ground, mm.
    pub radius_mm: f64,
    pub width_mm: f64,
}

/// A spool by its measures. Its axis is z, the hub at z = 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Spool {
    pub grooves: Vec<Groove>,
    pub flange_radius_mm: f64,
    pub flange_width_mm: f64,
    pub hub_radius_mm: f64,
    pub hub_mm: f64,
    pub shaft_mm: f64,
}

impl Spool {
    pub fn length_mm(&self) -> f64 {
        let grooves: f64 = self.grooves.iter().map(|g| g.width_mm + self.flange_width_mm).sum();
        self.hub_mm + self.flange_width_mm + grooves
    }

    /// Volume without screw and slits, mm^3.
    pub fn volume_mm3(&self) -> f64 {
        let bore = 0.5 * self.shaft_mm;
        self.profile().iter().map(|(from, to, r)| std::f64::consts::PI * (r * r - bore * bore) * (to - from)).sum()
    }

    /// Radius along the axis: (from, to, radius) of every step, mm. The side of a flange towards the hub slopes.
    pub fn profile(&self) -> Vec<(f64, f64, f64)> {
        let mut z = self.hub_mm;
        let mut steps = vec![(0.0, z, self.hub_radius_mm)];
        let mut ground = self.hub_radius_mm;
        for groove in self.grooves.iter().map(Some).chain([None]) {
            let top = z + self.flange_width_mm;
            let slopes = ((self.flange_radius_mm - ground) / SLOPE_MM).ceil().max(1.0);
            let rise = (0.5 * self.flange_width_mm).min(self.flange_radius_mm - ground).max(0.0);
            for k in 0..slopes as usize {
                let part = |k: f64| z + rise * k / slopes;
                let radius = ground + (self.flange_radius_mm - ground) * (k as f64 + 1.0) / (slopes + 1.0);
                if rise > 0.0 {
                    steps.push((part(k as f64), part(k as f64 + 1.0), radius));
                }
            }
            steps.push((z + rise, top, self.flange_radius_mm));
            z = top;
            if let Some(groove) = groove {
                steps.push((z, z + groove.width_mm, groove.radius_mm));
                (z, ground) = (z + groove.width_mm, groove.radius_mm);
            }
        }
        steps
    }
}

/// The solid of a spool.
pub fn spool_solid(spool: &Spool) -> Solid {
    let bore = || circle([0.0, 0.0], 0.5 * spool.shaft_mm);
    let middle = 0.5 * spool.hub_mm;
    let mut slabs = Vec::new();
    let mut from = 0.0;
    // The hub with its screw: slices of a round hole along x.
    for (low, high, half) in slices(middle, 0.5 * SCREW_HOLE_MM) {
        slabs.push(Slab { from, to: low, solid: vec![circle([0.0, 0.0], spool.hub_radius_mm)], hollow: vec![bore()] });
        let screw = bar([0.0, -half], [spool.hub_radius_mm + 1.0, half]);
        let hub = vec![circle([0.0, 0.0], spool.hub_radius_mm)];
        slabs.push(Slab { from: low, to: high, solid: hub, hollow: vec![bore(), screw] });
        from = high;
    }
    slabs.push(Slab {
        from,
        to: spool.hub_mm,
        solid: vec![circle([0.0, 0.0], spool.hub_radius_mm)],
        hollow: vec![bore()],
    });
    let ground = spool.grooves.iter().map(|g| g.radius_mm).fold(f64::INFINITY, f64::min);
    for (from, to, radius) in spool.profile().into_iter().skip(1) {
        let mut hollow = vec![bore()];
        let beyond: Point = [spool.flange_radius_mm + 1.0, 0.5 * SLIT_MM];
        if spool.grooves.iter().all(|g| g.radius_mm < radius) {
            hollow.push(bar([ground, -0.5 * SLIT_MM], beyond));
        }
        slabs.push(Slab { from, to, solid: vec![circle([0.0, 0.0], radius)], hollow });
    }
    slabs.retain(|slab| slab.to > slab.from);
    stacked(&slabs)
}
