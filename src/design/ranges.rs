//! What every number of a design may be. A design may come from anybody: outside these ranges a figure is a slip or an attack.
//!
//! The ranges are generous, a hundred times and more beyond any plushie, and narrow enough that no product of figures leaves what the
//! solvers and the sheets can hold. `examples/design-format.md` has the same table.

use super::fault::{Check, DesignError, Fault, fail, finite, require};
use crate::physics::{Kind, Parameter, Setting};

/// The range of a field, both ends allowed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Path into the file; `[]` stands for any index.
    pub field: &'static str,
    /// Empty for a plain number.
    pub unit: &'static str,
    pub low: f64,
    pub high: f64,
    pub why: &'static str,
}

macro_rules! ranges {
    ($($name:ident: $field:literal, $unit:literal, $low:literal, $high:literal, $why:literal;)*) => {
        $(pub(super) const $name: Range =
            Range { field: $field, unit: $unit, low: $low, high: $high, why: $why };)*
        /// Every range but those of materials and energy terms, which their catalogues hold, in the order of the file.
        pub const ALL: &[Range] = &[$($name),*];
    };
}

ranges! {
    FIBER_STIFFNESS: "fibers.stiffness", "N/mm", 1e-6, 1e6, "as mu";
    FIBER_EPSILON: "fibers.epsilon_fraction", "", 1e-8, 1.0, "below, a fibre is a kink that no step can cross";
    FIBER_CONTRACTION: "fibers.max_contraction", "", 0.0, 1.0, "a part of the length";
    TENDON_STIFFNESS: "tendons.stiffness", "N/mm", 1e-6, 1e6, "steel rope 1 mm thick is 1e3";
    TENDON_EPSILON: "tendons.epsilon_mm", "mm", 1e-6, 1e3, "below, a tendon is a kink that no step can cross";
    TENDON_CONTRACTION: "tendons.max_contraction", "", 0.0, 1.0, "a part of the length";
    FRICTION: "tendons.friction", "", 0.0, 1.0, "lines on cloth are 0.1 to 0.5; 0 is none";
    TEXTURE_SIZE: "texture_box, its sides", "mm", 1e-3, 2e6, "as the body";
    SEAM_ALLOWANCE: "fabrication.seam_allowance_mm", "mm", 0.0, 1e3, "shops use 6 to 10";
    TENDON_HOLE: "fabrication.tendon_hole_mm", "mm", 1e-2, 100.0, "what can be cut";
    TURNING_GAP: "fabrication.turning_gap_mm", "mm", 0.0, 1e4, "at most a quarter of the outline is left open anyway";
    SPOOL_RADIUS: "fabrication.spool_radius_mm", "mm", 0.1, 1e3, "what can be printed";
    ENCODER_LINES: "controller.encoder_lines", "", 1.0, 65535.0, "the export takes at most a quarter";
    GEAR_RATIO: "controller.gear_ratio", "", 1e-3, 1e5, "planetary gears reach 1500";
    TRACK_RATE: "controller.track_rate_hz", "Hz", 1e-2, 1e3, "a step takes a controller some ms";
    SPEED: "controller.speed_rpm", "rpm", 1.0, 30000.0, "what the controllers take; the plan of the animation asks for no more than the field says";
    MOTOR_ACCELERATION: "controller.acceleration", "rev/s^2", 1.0, 30000.0, "as controller.speed_rpm";
    MOTOR_TORQUE: "controller.torque_nmm", "N mm", 1e-3, 1e6, "a car's winch has 1e6";
    BAUD: "controller.drives.baud", "baud", 600.0, 115200.0, "what the controllers take";
    CURRENT: "controller.drives.current_ma", "mA", 0.0, 50000.0, "0 leaves what the controller has";
    DELAY_UNIT: "controller.drives.delay_unit_s", "s", 1e-4, 1.0, "believed 0.01";
    SCRIPT_DELAY_UNIT: "controller.drives.script_delay_unit_s", "s", 1e-4, 1.0, "believed 0.001";
    FOLLOWING: "controller.drives.following_acceleration", "rev/s^2", 1.0, 30000.0, "what the controllers take";
    SERVO_DEGREES: "controller.drives.servo_degrees", "degrees", 10.0, 3600.0, "sail winches turn ten times";
    SERVO_LOW: "controller.drives.servo_low_us", "us", 100.0, 10000.0, "half of a period at 50 Hz";
    SERVO_HIGH: "controller.drives.servo_high_us", "us", 100.0, 10000.0, "as the other end";
    STEPS_PER_TURN: "controller.drives.steps_per_turn", "", 1.0, 1e7, "a geared stepper with 256 microsteps has 1e6";
    HOLE_TO_SEAM: "sewing.hole_to_seam_mm", "mm", 0.0, 1e3, "0 lifts the rule inside the body";
    HOLE_TO_HOLE: "sewing.hole_to_hole_mm", "mm", 0.0, 1e3, "0 lifts the rule";
    MOST_HOLES: "sewing.most_holes", "", 0.0, 1e4, "as many as a routing may have";
    TURN: "sewing.turn_degrees", "degrees", 0.0, 180.0, "back the same way; lifts the rule";
    TURNING: "sewing.turning_degrees", "degrees", 0.0, 1.8e6, "back the same way at every hole; lifts the rule";
    BESIDE: "sewing.beside_mm", "mm", 0.0, 1e3, "0 lifts the rule";
    ALONG: "sewing.along_mm", "mm", 0.0, 1e4, "longer than any cable";
    LEAD: "sewing.lead_mm", "mm", 0.0, 1e4, "longer than any cable; lifts the rule";
    HOUSING: "sewing.housing_mm", "mm", 0.0, 1e3, "0 is a bare spool";
    BETWEEN_HOUSINGS: "sewing.between_housings_mm", "mm", 0.0, 1e3, "wider than any plushie";
    PIN_STIFFNESS: "pins[].stiffness", "N/mm", 1e-6, 1e6, "beyond, the matrix loses its digits";
    PIN_RADIUS: "pins[].hold.radius_mm", "mm", 0.0, 1e5, "larger than any plushie; holds all of it";
    PIN_ANGLE: "pins[].hold.degrees", "degrees", -360.0, 360.0, "once round";
    POSITION: "pins[].position, poses[].targets[].to, texture_box", "mm", -1e6, 1e6, "a kilometre, as the body";
    WEIGHT: "poses[].targets[].weight", "", 0.0, 1e6, "beyond, nothing else counts";
    RATIO: "networks[].tendons[].ratio", "", 1e-3, 1e3, "spools on one shaft";
    SLACK: "networks[].tendons[].slack_mm", "mm", 0.0, 1e4, "longer than any cable";
    TIME: "keyframes[].time_s", "s", 0.0, 36000.0, "ten hours";
    EASE: "keyframes[].easing.out, keyframes[].easing.into", "", 0.05, 0.9, "less jerks; more stands still and then leaps";
    ACTIVATION: "keyframes[].activations_mm[]", "mm or body lengths over 1000", -1e3, 1e4, "the cable on one spool";
    COORDINATE: "outline.*[], mesh.nodes[]", "mm", -1e6, 1e6, "a kilometre, as imports";
    BODY: "the longer side of the mesh", "mm", 1e-2, 2e6, "as imports";
    STIFFNESS_FACTOR: "stiffness_map[]", "", 1e-4, 1e4, "neighbours that differ more lose digits";
}

/// How many of a kind a design may have: what bounds the work that it can ask for.
pub(super) const MAX_TRIANGLES: usize = 400_000;
pub(super) const MAX_OUTLINE_POINTS: usize = 400_000;
pub(super) const MAX_PINS: usize = 2_000;
pub(super) const MAX_POSES: usize = 1_000;
pub(super) const MAX_TARGETS: usize = 2_000;
pub(super) const MAX_NETWORKS: usize = 1_000;
pub(super) const MAX_TENDONS: usize = 1_000;
pub(super) const MAX_ROUTING: usize = 10_000;
pub(super) const MAX_KEYFRAMES: usize = 10_000;

impl Range {
    /// Whether a number is finite and in the range.
    pub(super) fn check(&self, at: &str, value: f64) -> Check {
        self.check_scaled(at, value, 1.0)
    }

    /// [`Range::check`] with both ends times a factor.
    pub(super) fn check_scaled(&self, at: &str, value: f64, factor: f64) -> Check {
        finite(at, value)?;
        let (low, high) = (self.low * factor, self.high * factor);
        let fault = match value {
            v if (low..=high).contains(&v) => return Ok(()),
            v if low > 0.0 && v <= 0.0 => Fault::NotPositive(v),
            v if low == 0.0 && v < 0.0 => Fault::Negative(v),
            v if high == 1.0 && v > high => Fault::TooLarge(v, high),
            value => Fault::OutOfBounds { value, low, high, unit: if factor == 1.0 { self.unit } else { "mm" } },
        };
        fail(at, fault)
    }
}

/// Whether every parameter of a material or an energy term is in its range; `at`: its path into the file.
pub(super) fn parameters<K: Kind>(at: &str, setting: &Setting<K>) -> Check {
    let first = setting.values()[0];
    for (parameter, values) in setting.each() {
        let at = format!("{at}.{}", parameter.name);
        values.iter().try_for_each(|&value| of(parameter).check(&at, value))?;
        if let Some(most) = parameter.most_times_first {
            let factor = values[0] / first;
            require(factor <= most, &at, || Fault::TooStiff { factor, most })?;
        }
    }
    Ok(())
}

fn of(parameter: &Parameter) -> Range {
    let &Parameter { name: field, unit, range: [low, high], why, .. } = parameter;
    Range { field, unit, low, high, why }
}

/// Whether there are at most so many of a kind.
pub(super) fn at_most(at: &str, found: usize, most: usize, what: &'static str) -> Check {
    if found <= most { Ok(()) } else { Err(DesignError { at: at.into(), fault: Fault::TooMany { found, most, what } }) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::{MaterialKind, TermKind};

    #[test]
    fn the_documented_table_is_this_one() {
        let text = include_str!("../../examples/design-format.md");
        for Range { field, unit, low, high, why } in ALL {
            let row = format!("| `{field}` | {unit} | {} | {} | {why} |", number(*low), number(*high));
            assert!(text.contains(&row), "missing: {row}");
        }
        let materials = MaterialKind::all().iter().flat_map(|kind| kind.parameters);
        let terms = TermKind::all().iter().flat_map(|kind| kind.parameters.iter().map(|p| (kind.name, p)));
        let of_terms = terms.map(|(kind, p)| (if kind == "Gravity" { "gravity" } else { "terms[]" }, p));
        for (at, parameter) in materials.map(|p| ("material", p)).chain(of_terms) {
            let Range { field, unit, low, high, why } = of(parameter);
            let row = format!("| `{at}.{field}` | {unit} | {} | {} | {why} |", number(low), number(high));
            assert!(text.contains(&row), "missing: {row}");
        }
        let counts = [
            ("mesh.triangles", MAX_TRIANGLES),
            ("outline, points", MAX_OUTLINE_POINTS),
            ("pins", MAX_PINS),
            ("poses", MAX_POSES),
            ("poses[].targets", MAX_TARGETS),
            ("networks", MAX_NETWORKS),
            ("networks[].tendons", MAX_TENDONS),
            ("networks[].tendons[].routing, fibers.set[]", MAX_ROUTING),
            ("keyframes", MAX_KEYFRAMES),
        ];
        for (what, most) in counts {
            assert!(text.contains(&format!("| `{what}` | {most} |")), "missing: | `{what}` | {most} |");
        }
    }

    fn number(value: f64) -> String {
        if value != 0.0 && !(1e-2..1e5).contains(&value.abs()) { format!("{value:e}") } else { format!("{value}") }
    }

    #[test]
    fn both_ends_are_allowed_and_nothing_beyond() {
        for range in ALL {
            for value in [range.low, range.high, 0.5 * (range.low + range.high)] {
                range.check("x", value).unwrap();
            }
            let beyond = 1e-12 + 1e-12 * range.high.abs();
            for value in [range.low - beyond, range.high + beyond, f64::NAN, f64::INFINITY, -1e300, 4294967295.0, 1e9] {
                assert!(range.check("x", value).is_err(), "{}: {value}", range.field);
            }
        }
    }
}
