//! The families of controllers: what can be told to wind. One file each, one line each in [`ALL`].

pub mod bus;
pub mod classic;
pub mod grbl;
pub mod sdo;
pub mod servo;
mod servo_sketch;
mod stored;
mod v3_script;

use super::error::MotionError;
use super::machine::Machine;
use super::stream::Stream;
use super::trajectory::Trajectory;

/// A family of controllers.
#[derive(Debug)]
pub struct Family {
    /// Of its files and options.
    pub name: &'static str,
    /// Which controllers, and by whom they are told.
    pub title: &'static str,
    /// Of its programs.
    pub extension: &'static str,
    /// The commands that a host sends, for families that are told by one.
    pub stream: Option<MakeStream>,
    /// Texts to be loaded into the controllers, for families that play by themselves.
    pub sketches: Option<MakeSketches>,
    /// What manuals do not say, or say in different ways.
    pub unconfirmed: &'static [&'static str],
}

/// Makes the commands for one machine.
pub type MakeStream = fn(&Machine) -> Result<Box<dyn Stream>, MotionError>;
/// Makes the texts that play a trajectory.
pub type MakeSketches = fn(&Machine, &Trajectory) -> Result<Vec<Sketch>, MotionError>;

/// A text for a controller that plays by itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sketch {
    /// What of the family it is: `setup`, `motion`, `stop`, or all of it where it has no name.
    pub part: String,
    pub extension: &'static str,
    pub text: String,
}

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
