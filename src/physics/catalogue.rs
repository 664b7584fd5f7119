//! What a catalogue of materials or energy terms holds: names, parameters, and how one is built.
//!
//! The tables are [`super::materials`] and [`super::terms`]. Design files, problem files, validation, the settings panel and the tests of
//! derivatives read them; nothing else names a material or a term.

use super::energy::Energy;
use super::hyperelastic::Hyperelastic;

/// A parameter of a material or an energy term: one number, or the two components of a vector.
#[derive(Debug)]
pub struct Parameter {
    /// As in files.
    pub name: &'static str,
    /// As shown, with a line that explains it.
    pub label: &'static str,
    pub tip: &'static str,
    /// Empty for a plain number. In design files; problem files have the same in SI.
    pub unit: &'static str,
    /// How many numbers it has: 1 or 2.
    pub size: usize,
    pub default: [f64; 2],
    /// Smallest and largest value that a design file may have, and why.
    pub range: [f64; 2],
    pub why: &'static str,
    /// Largest multiple of the first parameter that it may be.
    pub most_times_first: Option<f64>,
    /// Smallest and largest value that can be dialled in, and the unit in which it is shown with its size: `shown = value * factor`.
    pub offered: [f64; 2],
    pub shown: Option<(&'static str, f64)>,
    pub dimension: Dimension,
}

impl Parameter {
    /// One plain number between 0 and 1, to be written over.
    pub const NUMBER: Self = Self {
        name: "",
        label: "",
        tip: "",
        unit: "",
        size: 1,
        default: [0.0; 2],
        range: [0.0, 1.0],
        why: "",
        most_times_first: None,
        offered: [0.0, 1.0],
        shown: None,
        dimension: Dimension::NONE,
    };
}

/// The dimension of a parameter, as powers of a 2-D modulus (force per length) and a length: in a frame in which these are
/// `m` and `s`, it is `value / (m^modulus s^length)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dimension {
    pub modulus: i32,
    pub length: i32,
}

impl Dimension {
    pub const NONE: Self = Self { modulus: 0, length: 0 };
    pub const MODULUS: Self = Self { modulus: 1, length: 0 };
    pub const FORCE_PER_AREA: Self = Self { modulus: 1, length: -1 };

    /// The unit in a frame with these units of modulus and length. Exact where they are powers of two.
    pub fn unit(self, modulus: f64, length: f64) -> f64 {
        modulus.powi(self.modulus) * length.powi(self.length)
    }
}

/// An entry of a catalogue.
pub trait Kind: Send + Sync + 'static {
    /// What the entries of this catalogue are, as in error messages.
    const OF: &'static str;
    /// All entries; the first is the default.
    fn all() -> &'static [&'static Self];
    /// Their names in files, in the same order.
    fn names() -> &'static [&'static str];
    fn name(&self) -> &'static str;
    fn parameters(&self) -> &'static [Parameter];
}

/// Makes the table of all entries of a type a catalogue: [`Kind`] for them.
macro_rules! catalogue {
    ($kind:ty, $of:literal, $all:ident) => {
        impl $crate::physics::catalogue::Kind for $kind {
            const OF: &'static str = $of;

            fn all() -> &'static [&'static Self] {
                &$all
            }

            fn names() -> &'static [&'static str] {
                static NAMES: [&str; $all.len()] = {
                    let mut names = [""; $all.len()];
                    let mut k = 0;
                    while k < names.len() {
                        names[k] = $all[k].name;
                        k += 1;
                    }
                    names
                };
                &NAMES
            }

            fn name(&self) -> &'static str {
                self.name
            }

            fn parameters(&self) -> &'static [$crate::physics::catalogue::Parameter] {
                self.parameters
            }
        }
    };
}
pub(super) use catalogue;

/// A material of the catalogue. Two are equal where their names are.
#[derive(Debug)]
pub struct MaterialKind {
    /// As in files.
    pub name: &'static str,
    pub label: &'static str,
    /// The first is the shear modulus.
    pub parameters: &'static [Parameter],
    /// `values`: those of all parameters in their order, in any consistent units.
    pub build: fn(values: &[f64]) -> Box<dyn Hyperelastic>,
    /// Values with which the derivatives are tested, `mu` near 1: ordinary ones first, then extreme ones.
    pub tested: &'static [&'static [f64]],
}

/// An optional energy term of the catalogue. Two are equal where their names are.
#[derive(Debug)]
pub struct TermKind {
    /// As in files.
    pub name: &'static str,
    pub label: &'static str,
    pub tip: &'static str,
    pub parameters: &'static [Parameter],
    /// `values` as for materials.
    pub build: fn(ground: &Ground, values: &[f64]) -> Box<dyn Energy>,
    /// Values with which the derivatives are tested on a body of size 1 and modulus 1.
    pub tested: &'static [&'static [f64]],
}

impl PartialEq for MaterialKind {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl PartialEq for TermKind {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// The body at rest that an energy term acts on.
pub struct Ground<'a> {
    pub nodes: &'a [[f64; 2]],
    pub triangles: &'a [[usize; 3]],
    /// A third of the area of the triangles around each node.
    pub nodal_areas: &'a [f64],
}
