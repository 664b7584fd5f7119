//! Winches as motors know them: their names in tables, and counts for cable.

use crate::design::{Design, Network};
use std::collections::HashSet;
use std::f64::consts::PI;

/// `4 * encoder_lines * gear_ratio / (2 pi * spool_radius)`, counts per mm of cable.
pub fn counts_per_mm(design: &Design) -> f64 {
    let lines = f64::from(design.controller.encoder_lines);
    4.0 * lines * design.controller.gear_ratio / (2.0 * PI * design.fabrication.spool_radius_mm)
}

/// The pull of a winch's cables, and what that asks of its motor.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Load {
    /// Sum of the tensions of its tendons, N.
    pub force_n: f64,
    /// `r sum_k ratio_k tau_k` with the spool's radius `r`, N mm.
    pub torque_nmm: f64,
}

/// The load of each winch, where its tendons, network by network, have these tensions, N.
pub fn winch_loads(design: &Design, tensions: &[f64]) -> Vec<Load> {
    let mut tensions = tensions.iter().copied();
    let mut load = |network: &Network| {
        network.tendons.iter().fold(Load::default(), |load, tendon| {
            let tension = tensions.next().unwrap_or_default();
            let torque_nmm = load.torque_nmm + design.fabrication.spool_radius_mm * tendon.ratio * tension;
            Load { force_n: load.force_n + tension, torque_nmm }
        })
    };
    design.networks.iter().map(&mut load).collect()
}

/// Turn of a spool that winds so much cable of a tendon of ratio 1, degrees.
pub fn spool_degrees(design: &Design, wound_mm: f64) -> f64 {
    (wound_mm / design.fabrication.spool_radius_mm).to_degrees()
}

/// A name for each network that a table's header can hold: letters, digits, spaces and `-_.()`, each name once.
pub fn winch_labels(design: &Design) -> Vec<String> {
    let mut taken = HashSet::new();
    let plain = |c: char| if c.is_alphanumeric() || " -_.()".contains(c) { c } else { '_' };
    let label = |(i, name): (usize, &str)| {
        let name: String = name.chars().map(plain).collect();
        // A leading dash would make a formula of the cell in a spreadsheet.
        let name = name.trim().trim_start_matches('-').trim_start();
        let name = if name.is_empty() { format!("winch {}", i + 1) } else { name.to_string() };
        let mut unique = name.clone();
        let mut copy = 2;
        while !taken.insert(unique.clone()) {
            unique = format!("{name} ({copy})");
            copy += 1;
        }
        unique
    };
    design.networks.iter().map(|n| n.name.as_str()).enumerate().map(label).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::testing;

    #[test]
    fn loads_add_up_by_their_spools() {
        let mut design = testing::sample();
        design.fabrication.spool_radius_mm = 8.0;
        design.networks[0].tendons[1].ratio = 2.5;
        let loads = winch_loads(&design, &[1.0, 2.0, 0.5]);
        assert_eq!(loads, [Load { force_n: 3.0, torque_nmm: 48.0 }, Load { force_n: 0.5, torque_nmm: 4.0 }]);
        assert_eq!(winch_loads(&design, &[]).len(), 2);
        assert!((spool_degrees(&design, 8.0 * PI) - 180.0).abs() < 1e-12);
    }
}
