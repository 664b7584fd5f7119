//! Winches to print: a spool with a groove a thread, and a housing to sew into the body.
//!
//! Every tendon is two threads, front and back, on one spool. A thread's middle runs at the spool's radius of the design (times the tendon's
//! ratio), as the counts of the motors have it, so that grooves are half a thread deeper. One layer of thread lies in a groove.

mod drawing;
mod housing;
mod spool;

pub use drawing::drawing;
pub use housing::{Housing, housing_solid};
pub use spool::{Groove, Spool, spool_solid};

use crate::defaults::CABLE_MM;
use crate::design::{Design, Network};
use crate::engine::winch_reach_mm;
use std::f64::consts::PI;

/// How far a flange stands above the thread's middle, mm: a thread and a half.
const FLANGE_MM: f64 = 0.65;
/// Space between a flange and the housing, mm: less than a thread, which then cannot slip past.
const CLEARANCE_MM: f64 = 0.45;
/// Wall of a housing, mm: two lines of a printer's nozzle of 0.4 mm and a little.
const WALL_MM: f64 = 0.9;
/// Thickness of a flange, mm.
const FLANGE_WIDTH_MM: f64 = 1.0;
/// Turns beyond those that the tendon can be wound by: what holds the thread by friction when it is let out.
const SPARE_TURNS: f64 = 1.5;
/// Width of a turn over the thread's: a hand does not lay them closer.
const TURN_WIDTH: f64 = 1.2;
/// The part of a spool that is clamped on the shaft: its length and the wall around the shaft, mm.
const HUB_MM: f64 = 6.0;
const HUB_WALL_MM: f64 = 3.0;

/// The spool of a network for a shaft of a diameter, mm. Its length is for all that its tendons can be wound by.
pub fn spool(design: &Design, network: &Network, shaft_mm: f64) -> Spool {
    let radius = design.fabrication.spool_radius_mm;
    let turns = winch_reach_mm(design, network) / (2.0 * PI * radius) + SPARE_TURNS;
    let width_mm = turns.ceil() * TURN_WIDTH * CABLE_MM;
    let grooves: Vec<Groove> = network
        .tendons
        .iter()
        .enumerate()
        .flat_map(|(tendon, t)| {
            let radius_mm = (radius * t.ratio - 0.5 * CABLE_MM).max(0.5 * CABLE_MM);
            [false, true].map(|back| Groove { tendon, back, radius_mm, width_mm })
        })
        .collect();
    let flange_radius_mm = flange_radius_mm(design, network);
    let hub_radius_mm = (0.5 * shaft_mm + HUB_WALL_MM).min(flange_radius_mm);
    Spool { grooves, flange_radius_mm, flange_width_mm: FLANGE_WIDTH_MM, hub_radius_mm, hub_mm: HUB_MM, shaft_mm }
}

/// The housing around every spool of a design: as wide as the widest one needs.
pub fn housing(design: &Design) -> Housing {
    let widest = design.networks.iter().map(|network| flange_radius_mm(design, network)).fold(0.0, f64::max);
    let longest = design.networks.iter().map(|network| spool(design, network, 0.0).length_mm()).fold(0.0, f64::max);
    let inner_radius_mm = widest + CLEARANCE_MM;
    Housing { inner_radius_mm, outer_radius_mm: inner_radius_mm + WALL_MM, room_mm: longest + 2.0 * CLEARANCE_MM }
}

fn flange_radius_mm(design: &Design, network: &Network) -> f64 {
    let widest = network.tendons.iter().map(|t| t.ratio).fold(0.0, f64::max);
    design.fabrication.spool_radius_mm * widest + FLANGE_MM
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::defaults;
    use crate::design::testing;

    #[test]
    fn the_housing_of_the_default_spool_is_as_wide_as_the_rules_of_sewing_say() {
        let design = testing::sample();
        let housing = housing(&design);
        assert!((2.0 * housing.outer_radius_mm - defaults::HOUSING_MM).abs() < 1e-9, "{housing:?}");
        // Around the circle and its ears, flat: with the default turning gap it gets in.
        assert!(housing.flat_mm() < defaults::TURNING_GAP_MM, "{}", housing.flat_mm());
    }

    #[test]
    fn a_thread_winds_at_the_radius_that_the_counts_are_made_with() {
        let mut design = testing::sample();
        design.networks[0].tendons[0].ratio = 0.5;
        let spool = spool(&design, &design.networks[0], 4.0);
        let [front, back] = [&spool.grooves[0], &spool.grooves[1]];
        assert_eq!(front.radius_mm + 0.5 * CABLE_MM, 0.5 * design.fabrication.spool_radius_mm);
        assert!(!front.back && back.back && spool.grooves.len() == 2 * design.networks[0].tendons.len());
    }
}
