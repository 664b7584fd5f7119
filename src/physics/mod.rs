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
//! A new material is one file and one line in [`material`]; a new term is one file and one line where models are built.

pub mod body;
pub mod cholesky;
mod continuation;
pub mod contractile;
pub mod double;
pub mod energy;
pub mod gravity;
pub mod indefinite;
pub mod material;
pub mod model;
pub mod neo_hookean;
mod panels;
mod patience;
pub mod pattern;
pub mod pins;
pub mod refine;
mod ridge;
mod segments;
pub mod st_venant_kirchhoff;
pub mod statics;
mod triangles;
pub(crate) mod wide;

pub use body::Body;
pub use contractile::{Contractile, Element, Law};
pub use double::Double;
pub use energy::{Energy, HessianForm, Scales};
pub use gravity::Gravity;
pub use material::Material;
pub use model::{Loose, Model, ModelError};
pub use neo_hookean::NeoHookean;
pub use pins::{Pin, Pins};
pub use st_venant_kirchhoff::StVenantKirchhoff;
pub use statics::{Cause, Equilibrium, StaticsError, StaticsSettings};
