//! The looks: a file and a line in [`LOOKS`] each.

mod contraction;
mod crumpling;
mod field;
mod force;
mod gap;
mod plain;
mod plush;
mod strain;
mod wireframe;

pub use contraction::Contraction;
pub use crumpling::Crumpling;
pub use force::Force;
pub use gap::Gap;
pub use plain::Plain;
pub use plush::Plush;
pub use strain::Strain;
pub use wireframe::Wireframe;

use super::look::LookEntry;

/// All looks, the first that of pictures by default.
pub const LOOKS: &[LookEntry] = &[
    LookEntry::of::<Plain>(),
    LookEntry::of::<Plush>(),
    LookEntry::of::<Wireframe>(),
    LookEntry::of::<Contraction>(),
    LookEntry::of::<Force>(),
    LookEntry::of::<Strain>(),
    LookEntry::of::<Crumpling>(),
    LookEntry::of::<Gap>(),
];

/// The look of a name.
pub fn look(name: &str) -> Option<&'static LookEntry> {
    LOOKS.iter().find(|look| look.name == name)
}
