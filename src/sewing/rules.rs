//! The rules of sewing: figures that can be changed.

use crate::defaults;
use serde::{Deserialize, Serialize};

/// Limits that every routing is to keep. Each figure can be changed; a rule is lifted by a figure that nothing breaks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Rules {
    /// Least distance from a hole to the seam, mm: nearer, the needle meets the stitches and the felt tears.
    pub hole_to_seam_mm: f64,
    /// Least distance between two holes, mm: nearer, felt between them tears, and no finger finds the right one.
    pub hole_to_hole_mm: f64,
    /// Most holes between the winch and the end of a cable: each one costs minutes of work and friction.
    pub most_holes: usize,
    /// Largest turn at one hole, degrees: beyond, the cable saws through the felt.
    pub turn_degrees: f64,
    /// Largest sum of all turns of a cable, degrees: friction grows exponentially with it (capstan).
    pub turning_degrees: f64,
    /// Cables nearer than this run along each other, mm: they tangle and rub.
    pub beside_mm: f64,
    /// Longest stretch along another cable, mm.
    pub along_mm: f64,
    /// Length from the winch on which cables may run together, mm: they leave it side by side.
    pub lead_mm: f64,
    /// Diameter of a winch's housing, mm.
    pub housing_mm: f64,
    /// Least space between two housings, mm.
    pub between_housings_mm: f64,
}

impl Default for Rules {
    fn default() -> Self {
        Self {
            hole_to_seam_mm: defaults::HOLE_TO_SEAM_MM,
            hole_to_hole_mm: defaults::HOLE_TO_HOLE_MM,
            most_holes: defaults::MOST_HOLES,
            turn_degrees: defaults::TURN_DEGREES,
            turning_degrees: defaults::TURNING_DEGREES,
            beside_mm: defaults::BESIDE_MM,
            along_mm: defaults::ALONG_MM,
            lead_mm: defaults::LEAD_MM,
            housing_mm: defaults::HOUSING_MM,
            between_housings_mm: defaults::BETWEEN_HOUSINGS_MM,
        }
    }
}
