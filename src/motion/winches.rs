//! Winches as motors know them: their names in tables, and counts for cable.

use crate::design::Design;
use std::collections::HashSet;
use std::f64::consts::PI;

/// `4 * encoder_lines * gear_ratio / (2 pi * spool_radius)`, counts per mm of cable.
pub fn counts_per_mm(design: &Design) -> f64 {
    let lines = f64::from(design.controller.encoder_lines);
    4.0 * lines * design.controller.gear_ratio / (2.0 * PI * design.fabrication.spool_radius_mm)
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
