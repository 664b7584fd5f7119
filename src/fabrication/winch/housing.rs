//! The housing: a cup around the spool, screwed to the motor, with outlets for the cables of both faces and ears to sew it in by.

use crate::fabrication::catalogue::Motor;
use crate::fabrication::prisms::{Slab, bar, circle, slices, stacked};
use crate::fabrication::solid::Solid;
use crate::outline::Point;
use std::f64::consts::{PI, TAU};

/// Thickness of the end that the motor is screwed to, mm.
pub const FLOOR_MM: f64 = 2.0;
/// Ears: how far they stand out of the wall, their thickness, and the holes in them for a needle, mm.
pub const EAR_MM: f64 = 6.0;
pub const EAR_THICKNESS_MM: f64 = 2.4;
pub const EAR_HOLE_MM: f64 = 2.0;
/// Distance of holes along an ear, at least, mm.
const EAR_PITCH_MM: f64 = 5.0;
/// Width of the outlets on both sides, mm, and the rings of wall that are left at their ends.
pub const OUTLET_MM: f64 = 4.0;
const RING_MM: f64 = 1.5;
/// How much wider than the motor's boss its hole in the floor is, mm.
const LOOSE_MM: f64 = 0.4;

/// A housing by its measures. Its axis is z, the motor at z = 0; the ears stand along x, the outlets along y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Housing {
    pub inner_radius_mm: f64,
    pub outer_radius_mm: f64,
    /// Length of the room for the spool.
    pub room_mm: f64,
}

impl Housing {
    pub fn length_mm(&self) -> f64 {
        FLOOR_MM + self.room_mm
    }

    /// Width over the ears.
    pub fn span_mm(&self) -> f64 {
        2.0 * (self.outer_radius_mm + EAR_MM)
    }

    /// Half the length of a string around the cross-section: what a flat opening or a flat body must have so that it gets through.
    pub fn flat_mm(&self) -> f64 {
        let (r, far) = (self.outer_radius_mm, self.outer_radius_mm + EAR_MM);
        // Tangents from the ends of the ears to the circle, the ears taken for points; their thickness is added.
        let angle = (r / far).acos();
        let tangent = (far * far - r * r).sqrt();
        let around = 4.0 * tangent + r * (TAU - 4.0 * angle) + 2.0 * EAR_THICKNESS_MM;
        0.5 * around
    }

    /// Heights of the holes in an ear.
    pub fn ear_holes_mm(&self) -> Vec<f64> {
        let count = (self.length_mm() / EAR_PITCH_MM - 0.5).floor().clamp(1.0, 4.0);
        (0..count as usize).map(|i| self.length_mm() * (i as f64 + 0.5) / count).collect()
    }
}

/// The solid of a housing for a motor.
pub fn housing_solid(housing: &Housing, motor: &Motor) -> Solid {
    let (inner, outer, length) = (housing.inner_radius_mm, housing.outer_radius_mm, housing.length_mm());
    let mut levels = vec![0.0, FLOOR_MM, FLOOR_MM + RING_MM, length - RING_MM, length];
    let holes: Vec<(f64, f64, f64)> =
        housing.ear_holes_mm().into_iter().flat_map(|z| slices(z, 0.5 * EAR_HOLE_MM)).collect();
    levels.extend(holes.iter().flat_map(|h| [h.0, h.1]));
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let ear = |side: f64| {
        let x = [side * 0.5 * (inner + outer), side * (outer + EAR_MM)];
        let y = 0.5 * EAR_THICKNESS_MM;
        bar([x[0].min(x[1]), -y], [x[0].max(x[1]), y])
    };
    let floor = |z: f64| z < FLOOR_MM;
    let slab = |ends: &[f64]| {
        let (from, to) = (ends[0], ends[1]);
        let z = 0.5 * (from + to);
        let mut hollow: Vec<Vec<Point>> = Vec::new();
        if floor(z) {
            hollow.push(circle([0.0, 0.0], 0.5 * motor.boss_mm + LOOSE_MM));
            hollow.extend(screws(motor, inner).into_iter().map(|p| circle(p, 0.5 * motor.screw_mm + 0.5 * LOOSE_MM)));
        } else {
            hollow.push(circle([0.0, 0.0], inner));
        }
        if (FLOOR_MM + RING_MM..length - RING_MM).contains(&z) {
            let half = 0.5 * OUTLET_MM;
            hollow.extend([
                bar([-half, 0.5 * inner], [half, outer + 1.0]),
                bar([-half, -outer - 1.0], [half, -0.5 * inner]),
            ]);
        }
        let middle = outer + 0.5 * EAR_MM;
        for (_, _, half) in holes.iter().filter(|h| h.0 <= z && z <= h.1) {
            for side in [-middle, middle] {
                hollow.push(bar([side - half, -EAR_THICKNESS_MM], [side + half, EAR_THICKNESS_MM]));
            }
        }
        Slab { from, to, solid: vec![circle([0.0, 0.0], outer), ear(1.0), ear(-1.0)], hollow }
    };
    let slabs: Vec<Slab> = levels.windows(2).filter(|ends| ends[1] - ends[0] > 1e-6).map(slab).collect();
    stacked(&slabs)
}

/// Holes for the motor's screws that the floor has room for; a motor that is held by its body has none.
fn screws(motor: &Motor, inner: f64) -> Vec<Point> {
    let fits = 0.5 * motor.screw_circle_mm + 0.5 * motor.screw_mm < inner - 1.0;
    let clear = 0.5 * motor.screw_circle_mm - 0.5 * motor.screw_mm > 0.5 * motor.boss_mm + 1.0;
    let count = if fits && clear { motor.screws } else { 0 };
    let angle = |i: usize| 0.25 * PI + TAU * i as f64 / count as f64;
    let r = 0.5 * motor.screw_circle_mm;
    (0..count).map(|i| [r * angle(i).cos(), r * angle(i).sin()]).collect()
}
