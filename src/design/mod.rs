//! The document: a plushie from outline to controller settings.
//!
//! A [`Design`] is plain data. It is validated on reading ([`Design::validate`]), written atomically ([`mod@file`]), changed by
//! the functions of [`edit`], and held by a [`history::History`], which keeps shared snapshots for undo. [`animation`]
//! reads winch activations off the timeline. Lengths are mm, stiffnesses N/mm.

mod acting;
pub mod animation;
pub mod bundled;
mod copy_on_write;
pub mod edit;
mod fault;
mod figures;
pub mod file;
pub mod history;
pub mod ranges;
pub mod remesh;
pub mod reshape;
mod settings;
mod sewable;
#[cfg(test)]
pub(crate) mod testing;
pub mod texture;
mod validate;
mod version;

pub use copy_on_write::CopyOnWrite;
pub use edit::EditError;
pub use fault::{DesignError, Fault};
pub use figures::MeshFigures;
pub use file::FileError;
pub use history::History;
pub use settings::{
    ControllerSettings, DriveSettings, FabricationSettings, FiberSet, FiberSettings, Gravity, Material, TendonSettings,
    Term,
};
pub use validate::MAX_NAME_CHARS;
pub use version::FORMAT_VERSION;

use crate::defaults;
use crate::mesh::{BodyPoint, Mesh};
use crate::outline::drawing::Track;
use crate::outline::{Drawing, Outline, Point};
pub use crate::physics::MaterialPoint;
use crate::sewing::Rules;
use serde::{Deserialize, Serialize};

/// A plushie: body, actuation, poses, animation, and how it is made. Stored as RON in `*.plush` files.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Design {
    /// Version of the file format this document was written in.
    pub version: u32,
    pub name: String,
    pub outline: Outline,
    pub mesh: CopyOnWrite<Mesh>,
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
    /// The rules that its routings are to keep so that a hand can sew them.
    #[serde(default, skip_serializing_if = "is_default")]
    pub sewing: Rules,
    /// The parts that the outline was, or will be, drawn from; in its coordinates.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drawing: Option<Drawing>,
    /// Picture on the body at rest, a path relative to the design file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub texture: Option<String>,
    /// Lower left and upper right corner of the texture, mm; those of the rest silhouette's box if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub texture_box: Option<[Point; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gravity: Option<Gravity>,
    /// Energy terms beside gravity, which has a field of its own; each kind at most once.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub terms: Vec<Term>,
    /// Factor on the moduli of each triangle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness_map: Option<Vec<f64>>,
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
    #[serde(default, skip_serializing_if = "is_default")]
    pub hold: Hold,
}

/// The part of a body that a pin holds, and in which directions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Hold {
    /// The point: the body may turn about it.
    #[default]
    Point,
    /// The point slides along a line through its anchor, at this angle from the x axis.
    Line { degrees: f64 },
    /// All nodes within the radius keep their places about the point, turned by the angle: the body cannot turn there.
    Region {
        radius_mm: f64,
        #[serde(default, skip_serializing_if = "is_zero")]
        degrees: f64,
    },
}

impl Pin {
    /// Holds a point of the body where it is at rest.
    pub fn at_rest(at: BodyPoint, stiffness: f64) -> Self {
        Self { at, position: None, stiffness, hold: Hold::Point }
    }

    /// World anchor, mm.
    pub fn anchor(&self, mesh: &Mesh) -> Point {
        self.position.unwrap_or_else(|| mesh.position(&self.at, &mesh.nodes))
    }
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
    /// Each routing starts at the winch.
    pub tendons: Vec<Tendon>,
    /// Red, green and blue of its cables in pictures; that of its number if absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub color: Option<[u8; 3]>,
    /// Whether it is switched off: it pulls nothing and is not made, but keeps its place and its activations in keyframes.
    #[serde(default, skip_serializing_if = "is_default")]
    pub muted: bool,
}

/// One cable of a network.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tendon {
    /// The winch, the holes and the end: points of the body, from the winch outward.
    pub routing: Vec<MaterialPoint>,
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Easing {
    Linear,
    /// Starts and ends at rest: `3 s^2 - 2 s^3`.
    #[default]
    Smooth,
    /// Stays until the next keyframe.
    Hold,
    /// Starts and ends at rest, as slowly as its handles say: the Bezier curve from (0, 0) to (1, 1) with the handles (out, 0) and
    /// (1 - into, 1), progress over time. With thirds it is `Smooth`.
    Slow {
        out: f64,
        into: f64,
    },
}

impl Network {
    /// The point of the body at which the winch sits.
    pub fn winch(&self) -> Option<&MaterialPoint> {
        self.tendons.first().and_then(|t| t.routing.first())
    }
}

impl Design {
    /// A bare plushie with default settings: no pins, poses or networks yet.
    pub fn new(name: impl Into<String>, outline: Outline, mesh: impl Into<CopyOnWrite<Mesh>>) -> Self {
        Self {
            version: FORMAT_VERSION,
            name: name.into(),
            outline,
            mesh: mesh.into(),
            material: Material::default(),
            fibers: FiberSettings::default(),
            tendons: TendonSettings::default(),
            pins: Vec::new(),
            poses: Vec::new(),
            networks: Vec::new(),
            keyframes: Vec::new(),
            fabrication: FabricationSettings::default(),
            controller: ControllerSettings::default(),
            sewing: Rules::default(),
            drawing: None,
            texture: None,
            texture_box: None,
            gravity: None,
            terms: Vec::new(),
            stiffness_map: None,
        }
    }

    /// Whether nobody has worked on it yet: all there is follows from an outline that was read.
    pub fn is_bare(&self) -> bool {
        let Self { pins, poses, networks, keyframes, stiffness_map, material, fibers, tendons, .. } = self;
        let lists = pins.is_empty() && poses.is_empty() && networks.is_empty() && keyframes.is_empty();
        let physics = *material == Material::default() && *fibers == FiberSettings::default();
        let made = self.fabrication == FabricationSettings::default()
            && self.controller == ControllerSettings::default()
            && self.sewing == Rules::default();
        let others = self.all_terms().is_empty()
            && stiffness_map.is_none()
            && self.drawing.is_none()
            && [TendonSettings::default(), TendonSettings::begun()].contains(tendons);
        lists && physics && made && others
    }

    /// All optional energy terms, gravity among them.
    pub fn all_terms(&self) -> Vec<Term> {
        self.gravity.map(Term::from).into_iter().chain(self.terms.iter().copied()).collect()
    }

    /// The routings of the muscle fibres, in the order in which fibre contractions are reported everywhere.
    pub fn fiber_routings(&self) -> Vec<Vec<usize>> {
        self.fibers.routings(&self.mesh)
    }

    /// Number of fibres if `mesh` were the design's mesh.
    pub(crate) fn fiber_count_on(&self, mesh: &Mesh) -> usize {
        match &self.fibers.set {
            FiberSet::Edges => mesh.edges().len(),
            FiberSet::Routings(routings) => routings.len(),
        }
    }

    /// Lines along which edges of the mesh run, and shall run in every other one, mm: those of the drawing.
    pub fn tracks(&self) -> &[Track] {
        self.drawing.as_ref().map_or(&[], |drawing| &drawing.tracks)
    }

    /// Lower left and upper right corner of the texture, mm.
    pub fn texture_rect(&self) -> [Point; 2] {
        self.texture_box.unwrap_or_else(|| self.outline.bounding_box().into())
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
fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}
fn is_zero(v: &f64) -> bool {
    *v == 0.0
}
