//! The families of controllers: what can be told to wind. One file each, one line each in [`ALL`].

pub mod bus;
pub mod classic;
mod family;
pub mod grbl;
pub mod sdo;
pub mod servo;
mod servo_sketch;
mod shortened;
mod stored;
mod v3_script;

pub use family::{Family, Sketch};

/// All families.
pub static ALL: &[&Family] = &[
    &classic::FAMILY,
    &stored::FAMILY,
    &v3_script::FAMILY,
    &sdo::FAMILY,
    &servo::FAMILY,
    &servo_sketch::ARDUINO,
    &servo_sketch::MICROPYTHON,
    &bus::FAMILY,
    &grbl::FAMILY,
];

/// The family of this name.
pub fn by_name(name: &str) -> Option<&'static Family> {
    ALL.iter().copied().find(|family| family.name == name)
}

/// Their names, for people.
pub fn names() -> String {
    ALL.iter().map(|family| family.name).collect::<Vec<_>>().join(", ")
}

/// Families that a live drive can play.
pub fn streams() -> impl Iterator<Item = &'static Family> {
    ALL.iter().copied().filter(|family| family.stream.is_some())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_for_options_and_files_and_each_family_makes_something() {
        for (k, family) in ALL.iter().enumerate() {
            assert!(family.name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-'));
            assert_eq!(by_name(family.name).map(|found| found.title), Some(family.title), "{k}");
            assert!(family.stream.is_some() != family.sketches.is_some(), "{}", family.name);
        }
    }
}
