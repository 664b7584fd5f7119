//! What a plushie is made of, and where it comes to rest.
//!
//! The total energy is `E(x) = E_plush + E_contractile + E_pins + ...` (eq. 1). Every term implements [`Energy`]: a term
//! knows its own stencils and nothing else; [`Model`] assembles. Statics ([`statics`]) minimises `E` by an inversion-safe
//! Newton method. Any consistent system of units will do.
//!
//! | symbol | meaning |
//! | --- | --- |
//! | `x`, `X` | deformed and rest coordinates, `[x0, y0, x1, y1, ...]` |
//! | `F`, `J` | deformation gradient (2 x 2) and its determinant |
//! | `mu`, `kappa` | moduli of eq. 5, force per length |
//! | `l`, `alpha`, `Gamma` | element length, rest length, `Gamma = l - alpha` |
//! | `U`, `tau` | strain energy of an element and its tension `dU/dGamma` |
//! | `G` | rows `dl/dx`; the paper's `A = -G^T` |
//!
//! A new material is one file and its lines in [`materials`]; a new optional term is one file and its lines in [`terms`].

pub mod body;
pub mod catalogue;
pub mod cholesky;
pub mod contractile;
pub mod double_double;
mod element;
pub mod energy;
pub mod friction;
pub mod hyperelastic;
pub mod indefinite;
mod material_point;
pub mod materials;
pub mod model;
mod panels;
pub mod pattern;
pub mod pins;
pub mod precise;
mod routed;
mod segments;
pub mod setting;
pub mod statics;
pub mod terms;
mod triangles;
pub(crate) mod wide;

pub use body::Body;
pub use catalogue::{Ground, Kind, MaterialKind, Parameter, TermKind};
pub use contractile::Contractile;
pub use double_double::DoubleDouble;
pub use element::{Element, Law};
pub use energy::{Energy, HessianForm, Scales};
pub use friction::{Direction, Friction, FrictionError};
pub use hyperelastic::Hyperelastic;
pub use material_point::{Carriers, MaterialPoint};
pub use materials::{NeoHookean, StVenantKirchhoff};
pub use model::{Loose, Model, ModelError};
pub use pins::{PinSpring, Pins};
pub use setting::Setting;
pub use statics::{Cause, Equilibrium, StaticsError, StaticsSettings};
pub use terms::Gravity;
