//! Settings of a design: material, fibres, tendons, fabrication, controllers. The figures come from [`crate::defaults`].

use super::is_zero;
use crate::defaults;
use crate::mesh::Mesh;
use crate::physics::terms::GRAVITY;
use crate::physics::{MaterialKind, Setting, TermKind};
use serde::{Deserialize, Serialize};

/// Material of the body: one of the catalogue ([`crate::physics::materials`]) with its parameters, neo-Hookean by default (eq. 5).
pub type Material = Setting<MaterialKind>;

/// An optional energy term: one of the catalogue ([`crate::physics::terms`]) with its parameters.
pub type Term = Setting<TermKind>;

/// The muscle fibres of the idealized plushie.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FiberSettings {
    pub set: FiberSet,
    /// `K` of eq. 8, N/mm.
    pub stiffness: f64,
    /// `epsilon` of eq. 8 as a fraction of the mean fibre length.
    pub epsilon_fraction: f64,
    /// Largest contraction as a fraction of the rest length.
    pub max_contraction: f64,
}

/// Where the fibres run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum FiberSet {
    /// One on every mesh edge, in the order of [`Mesh::edges`].
    #[default]
    Edges,
    /// Routings of their own over the mesh nodes: a coarse set on a fine mesh (section 8.2).
    Routings(Vec<Vec<usize>>),
}

/// The tendons of all networks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TendonSettings {
    /// `K` of eq. 8, N/mm.
    pub stiffness: f64,
    /// `epsilon` of eq. 8, mm.
    pub epsilon_mm: f64,
    /// Largest contraction as a fraction of the rest length.
    pub max_contraction: f64,
    /// `mu` of a cable at the holes it passes, dimensionless; 0: no friction. The default is that of old files, which had none.
    #[serde(skip_serializing_if = "is_zero")]
    pub friction: f64,
}

/// Gravity, off unless present.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gravity {
    /// m/s^2.
    pub acceleration: [f64; 2],
    /// kg per mm^2 of silhouette.
    pub surface_density: f64,
}

/// How the skin is cut and the cables are led.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct FabricationSettings {
    pub seam_allowance_mm: f64,
    pub tendon_hole_mm: f64,
    pub turning_gap_mm: f64,
    pub spool_radius_mm: f64,
}

/// The motor behind each winch and the rate of its track.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ControllerSettings {
    pub encoder_lines: u32,
    pub gear_ratio: f64,
    pub track_rate_hz: f64,
    /// Largest speed that the plan of an animation asks for, rpm of the motor.
    pub speed_rpm: u32,
    /// Largest acceleration that it asks for, rev/s^2 of the motor.
    pub acceleration: u32,
    /// Largest torque that the motor can keep up, N mm at the spool.
    #[serde(skip_serializing_if = "is_assumed")]
    pub torque_nmm: f64,
    /// What the families of controllers differ in.
    #[serde(skip_serializing_if = "super::is_default")]
    pub drives: DriveSettings,
}

/// Settings of single families of motor controllers: what their manuals leave to the maker, or do not say.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DriveSettings {
    /// Speed of the line to Faulhaber controllers of the classic family, baud.
    pub baud: u32,
    /// Largest current of a motor with such a controller, mA, peak and continuous; 0 leaves what the controller has.
    pub current_ma: u32,
    /// Unit of `DELAY` in their stored programs, s.
    pub delay_unit_s: f64,
    /// Range of a hobby servo, degrees.
    pub servo_degrees: f64,
    /// Pulse that holds its horn at the beginning of the range, the cable just slack, microseconds.
    pub servo_low_us: u32,
    /// Pulse that holds it at the end, microseconds; less than the other one for a spool that winds the other way round.
    pub servo_high_us: u32,
    /// Steps of a stepper's driver for a turn of the spool, microsteps counted.
    pub steps_per_turn: f64,
}

impl From<Gravity> for Term {
    fn from(Gravity { acceleration: [x, y], surface_density }: Gravity) -> Self {
        Self::new(GRAVITY, &[x, y, surface_density])
    }
}

impl From<Term> for Gravity {
    /// Panics where it is another term: a mistake of the caller.
    fn from(term: Term) -> Self {
        assert_eq!(term.kind().name, GRAVITY.name);
        let &[x, y, surface_density] = term.values() else { unreachable!("gravity has three values") };
        Self { acceleration: [x, y], surface_density }
    }
}

impl FiberSettings {
    /// The routings of the fibres on a mesh.
    pub fn routings(&self, mesh: &Mesh) -> Vec<Vec<usize>> {
        match &self.set {
            FiberSet::Edges => mesh.edges().into_iter().map(Vec::from).collect(),
            FiberSet::Routings(routings) => routings.clone(),
        }
    }
}

impl Default for FiberSettings {
    fn default() -> Self {
        Self {
            set: FiberSet::Edges,
            stiffness: defaults::FIBER_STIFFNESS,
            epsilon_fraction: defaults::FIBER_EPSILON_FRACTION,
            max_contraction: defaults::FIBER_MAX_CONTRACTION,
        }
    }
}

impl Default for TendonSettings {
    fn default() -> Self {
        Self {
            stiffness: defaults::TENDON_STIFFNESS,
            epsilon_mm: defaults::TENDON_EPSILON_MM,
            max_contraction: defaults::TENDON_MAX_CONTRACTION,
            friction: 0.0,
        }
    }
}

impl TendonSettings {
    /// Those of a design that is begun: as the default ones, with the friction that is guessed at.
    pub fn begun() -> Self {
        Self { friction: defaults::NEW_FRICTION, ..Self::default() }
    }
}

impl Default for FabricationSettings {
    fn default() -> Self {
        Self {
            seam_allowance_mm: defaults::SEAM_ALLOWANCE_MM,
            tendon_hole_mm: defaults::TENDON_HOLE_MM,
            turning_gap_mm: defaults::TURNING_GAP_MM,
            spool_radius_mm: defaults::SPOOL_RADIUS_MM,
        }
    }
}

impl Default for ControllerSettings {
    fn default() -> Self {
        Self {
            encoder_lines: defaults::ENCODER_LINES,
            gear_ratio: defaults::GEAR_RATIO,
            track_rate_hz: defaults::TRACK_RATE_HZ,
            speed_rpm: defaults::MOTOR_SPEED_RPM,
            acceleration: defaults::MOTOR_ACCELERATION,
            torque_nmm: defaults::MOTOR_TORQUE_NMM,
            drives: DriveSettings::default(),
        }
    }
}

impl Default for DriveSettings {
    fn default() -> Self {
        Self {
            baud: defaults::BAUD,
            current_ma: defaults::MOTOR_CURRENT_MA,
            delay_unit_s: defaults::DELAY_UNIT_S,
            servo_degrees: defaults::SERVO_DEGREES,
            servo_low_us: defaults::SERVO_PULSES_US[0],
            servo_high_us: defaults::SERVO_PULSES_US[1],
            steps_per_turn: defaults::STEPS_PER_TURN,
        }
    }
}

/// Whether a torque is the one that is assumed where nothing is said.
fn is_assumed(torque_nmm: &f64) -> bool {
    *torque_nmm == defaults::MOTOR_TORQUE_NMM
}
