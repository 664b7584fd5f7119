//! The catalogue of materials.

mod neo_hookean;
mod st_venant_kirchhoff;

pub use neo_hookean::NeoHookean;
pub use st_venant_kirchhoff::StVenantKirchhoff;

use super::catalogue::{MaterialKind, catalogue};

/// All materials; the first is the default. A new one is a file and its two lines here.
static MATERIALS: [&MaterialKind; 2] = [&neo_hookean::KIND, &st_venant_kirchhoff::KIND];

catalogue!(MaterialKind, "Material", MATERIALS);
