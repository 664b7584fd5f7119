//! What each winch asks of its motor: torque from simulated tensions with friction, speed and turn from its trajectory.

use super::cables::points;
use crate::defaults;
use crate::design::Design;
use crate::engine::{Setpoint, solve_once};
use crate::motion::{MotionError, Trajectory, spool_degrees, winch_loads};
use crate::sewing::turning;
use std::f64::consts::PI;
use std::sync::atomic::AtomicBool;

/// Most different keyframes that are simulated, those that wind the most, and most triangles of all of them together, of one at least: what bounds
/// the time of an export.
const MOST_KEYFRAMES: usize = 8;
const MOST_TRIANGLES: usize = 6000;
/// Bodies of more triangles than this are not simulated at all.
pub const TOO_FINE: usize = 60_000;

/// The demand of one winch.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Demand {
    /// Largest pull of its cables at the spool, N, and the torque of that, N mm.
    pub pull_n: f64,
    pub torque_nmm: f64,
    /// Largest speed of the spool, rpm.
    pub speed_rpm: f64,
    /// Largest turn of the spool, degrees, and the cable wound by that, mm.
    pub turn_degrees: f64,
    pub wound_mm: f64,
}

/// The demands of all winches over their motion, friction at the holes included: `e^(mu theta)` times the tension behind a cable's turns theta
/// (capstan equation), with the design's mu, or that of new designs where it has none. Cancelled, those of some keyframes are left out.
pub fn demands(design: &Design, trajectory: &Trajectory, cancel: &AtomicBool) -> Vec<Demand> {
    let mu = if design.tendons.friction > 0.0 { design.tendons.friction } else { defaults::NEW_FRICTION };
    let tendons = || design.networks.iter().flat_map(|network| &network.tendons);
    let rub: Vec<f64> = tendons().map(|t| (mu * turning(&points(design, t)).to_radians()).exp()).collect();
    let mut all = vec![Demand::default(); design.networks.len()];
    for activations in wound(design) {
        let outcome = solve_once(design, Setpoint::Activations(activations), [false, true], cancel);
        let Some(shape) = outcome.realizable else { continue };
        let pulled: Vec<f64> = shape.tendon_tensions.iter().zip(&rub).map(|(t, r)| t * r).collect();
        for (demand, load) in all.iter_mut().zip(winch_loads(design, &pulled)) {
            demand.pull_n = demand.pull_n.max(load.force_n);
            demand.torque_nmm = demand.torque_nmm.max(load.torque_nmm);
        }
    }
    let around = 2.0 * PI * design.fabrication.spool_radius_mm;
    for (k, demand) in all.iter_mut().enumerate() {
        let steps = trajectory.times_s.windows(2).zip(trajectory.lengths_mm.windows(2));
        let speed = steps
            .filter(|(t, _)| t[1] > t[0])
            .map(|(t, l)| (l[1][k] - l[0][k]).abs() / (t[1] - t[0]))
            .fold(0.0, f64::max);
        demand.speed_rpm = 60.0 * speed / around;
        demand.wound_mm = trajectory.lengths_mm.iter().map(|row| row[k]).fold(0.0, f64::max);
        demand.turn_degrees = spool_degrees(design, demand.wound_mm);
    }
    all
}

/// The winch that asks for most beyond the torque of its motor, where that torque is only assumed; `None` where all are strong enough.
///
/// # Errors
/// [`MotionError::TooWeak`] where the maker has set the torque.
pub fn strong_enough(
    design: &Design,
    trajectory: &Trajectory,
    demands: &[Demand],
) -> Result<Option<MotionError>, MotionError> {
    let has_nmm = design.controller.torque_nmm;
    let most = trajectory.winches.iter().zip(demands).max_by(|a, b| a.1.torque_nmm.total_cmp(&b.1.torque_nmm));
    let Some((winch, demand)) = most.filter(|(_, demand)| demand.torque_nmm > has_nmm) else { return Ok(None) };
    let error = MotionError::TooWeak { winch: winch.clone(), needs_nmm: demand.torque_nmm, has_nmm };
    if has_nmm == defaults::MOTOR_TORQUE_NMM { Ok(Some(error)) } else { Err(error) }
}

/// The activations of the keyframes that wind the most, each once.
fn wound(design: &Design) -> Vec<Vec<f64>> {
    let sum = |a: &Vec<f64>| a.iter().sum::<f64>();
    let mut all: Vec<Vec<f64>> = design.keyframes.iter().map(|k| k.activations_mm.clone()).collect();
    all.retain(|a| a.iter().any(|&v| v > 0.0));
    all.sort_by(|a, b| sum(b).total_cmp(&sum(a)));
    all.dedup();
    let triangles = design.mesh.triangles.len().max(1);
    let count = if triangles > TOO_FINE { 0 } else { (MOST_TRIANGLES / triangles).clamp(1, MOST_KEYFRAMES) };
    all.truncate(count);
    all
}
