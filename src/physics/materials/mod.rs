//! The catalogue of materials.

mod neo_hookean;
mod st_venant_kirchhoff;

pub use neo_hookean::NeoHookean;
pub use st_venant_kirchhoff::StVenantKirchhoff;

use super::catalogue::{Kind, MaterialKind, Parameter};

/// All materials; the first is the default. A new one is a file and its two lines here.
static MATERIALS: [&MaterialKind; 2] = [&neo_hookean::KIND, &st_venant_kirchhoff::KIND];

static NAMES: [&str; MATERIALS.len()] = {
    let mut names = [""; MATERIALS.len()];
    let mut k = 0;
    while k < names.len() {
        names[k] = MATERIALS[k].name;
        k += 1;
    }
    names
};

impl Kind for MaterialKind {
    const OF: &'static str = "Material";

    fn all() -> &'static [&'static Self] {
        &MATERIALS
    }

    fn names() -> &'static [&'static str] {
        &NAMES
    }

    fn name(&self) -> &'static str {
        self.name
    }

    fn parameters(&self) -> &'static [Parameter] {
        self.parameters
    }
}
