//! The document: a plushie from outline to controller settings.
//!
//! A [`Design`] is plain data. It is validated on reading ([`Design::validate`]), written atomically, and edited through
//! [`history::History`], which keeps shared snapshots for undo. Lengths are mm, stiffnesses N/mm.

use crate::defaults;
use crate::mesh::{BodyPoint, Mesh};
use crate::outline::{Outline, Point};
use serde::{Deserialize, Serialize};

/// A plushie: body, actuation, poses, animation, and how it is made. Stored as RON in `*.plush` files.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Design {
    /// Version of the file format this document was written in.
    pub version: u32,
    pub name: String,
    pub outline: Outline,
    pub mesh: Mesh,
    #[serde(default)]
    pub material: Material,
    #[serde(default)]
    pub fibers: FiberSettings,
    #[serde(default)]
    pub tendons: TendonSettings,
    #[serde(default)]
    pub pins: Vec<Pin>,
    #[serde(default)]
    pub poses: Vec<Pose>,
    #[serde(default)]
    pub networks: Vec<Network>,
    #[serde(default)]
    pub keyframes: Vec<Keyframe>,
    #[serde(default)]
    pub fabrication: FabricationSettings,
    #[serde(default)]
    pub controller: ControllerSettings,
    /// Picture stretched over the rest silhouette's box, a path relative to the design file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub texture: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gravity: Option<Gravity>,
    /// Factor on the moduli of each triangle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness_map: Option<Vec<f64>>,
}

/// Material of the body. A choice, so that others can follow.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Material {
    /// Eq. 5 of the paper.
    NeoHookean { mu: f64, kappa: f64 },
    /// Linear in the Green strain; for comparison, and only for moderate compression.
    StVenantKirchhoff { mu: f64, lambda: f64 },
}

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
}

/// Holds a point of the body where it is at rest, or at `position`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pin {
    pub at: BodyPoint,
    /// World anchor, mm; the rest position if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub position: Option<Point>,
    /// N/mm.
    #[serde(default = "pin_stiffness")]
    pub stiffness: f64,
}

/// A named pose: where points of the body should go.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pose {
    pub name: String,
    #[serde(default)]
    pub targets: Vec<Target>,
}

/// A point of the body and where it should go, mm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Target {
    pub at: BodyPoint,
    pub to: Point,
    #[serde(default = "one")]
    pub weight: f64,
}

/// A winch and the tendons it winds on one spool.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Network {
    pub name: String,
    /// Each routing starts at the winch's node.
    pub tendons: Vec<Tendon>,
}

/// One cable of a network.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tendon {
    /// Mesh nodes from the winch outward.
    pub routing: Vec<usize>,
    /// Its entry of `Z`: contraction per unit of winch activation (relative spool radius).
    #[serde(default = "one", skip_serializing_if = "is_one")]
    pub ratio: f64,
    /// Slack at assembly, mm: added to the rest length.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub slack_mm: f64,
}

/// Winch activations at a moment of the animation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Keyframe {
    pub time_s: f64,
    /// Cable wound by each winch, mm, in the order of `networks`; 0 is the just-slack rest state.
    pub activations_mm: Vec<f64>,
    /// The pose these activations were solved from, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pose: Option<String>,
    /// How the animation moves from this keyframe to the next.
    #[serde(default)]
    pub easing: Easing,
}

/// Shape of the motion between two keyframes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Easing {
    Linear,
    /// Starts and ends at rest: `3 s^2 - 2 s^3`.
    #[default]
    Smooth,
    /// Stays until the next keyframe.
    Hold,
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
    pub speed_rpm: u32,
    /// rev/s^2.
    pub acceleration: u32,
}

impl Default for Material {
    fn default() -> Self {
        Self::NeoHookean { mu: defaults::MU, kappa: defaults::KAPPA }
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
        }
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
        }
    }
}

impl Network {
    /// The mesh node at which the winch sits.
    pub fn winch_node(&self) -> Option<usize> {
        self.tendons.first().and_then(|t| t.routing.first().copied())
    }
}

impl Design {
    /// The routings of the muscle fibres, in the order in which fibre contractions are reported everywhere.
    pub fn fiber_routings(&self) -> Vec<Vec<usize>> {
        match &self.fibers.set {
            FiberSet::Edges => self.mesh.edges().into_iter().map(Vec::from).collect(),
            FiberSet::Routings(routings) => routings.clone(),
        }
    }

    /// The longer side of the rest silhouette's box, mm: pose errors are stated in it.
    pub fn body_length_mm(&self) -> f64 {
        self.mesh.body_length()
    }
}

fn pin_stiffness() -> f64 {
    defaults::PIN_STIFFNESS
}
fn one() -> f64 {
    1.0
}
fn is_one(v: &f64) -> bool {
    *v == 1.0
}
fn is_zero(v: &f64) -> bool {
    *v == 0.0
}
