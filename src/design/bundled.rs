//! The example designs, compiled in, so that the program runs alone.

use super::Design;
use super::file::{TextError, parse};

/// An example as it stands in its file.
#[derive(Clone, Copy, Debug)]
pub struct Bundled {
    pub name: &'static str,
    pub text: &'static str,
}

/// The examples, the one to start with first.
pub const ALL: &[Bundled] = &[
    Bundled { name: "Pig", text: include_str!("../../examples/pig.plush") },
    Bundled { name: "Robot", text: include_str!("../../examples/robot.plush") },
    Bundled { name: "Puppy", text: include_str!("../../examples/puppy.plush") },
    Bundled { name: "Squid", text: include_str!("../../examples/squid.plush") },
    Bundled { name: "E", text: include_str!("../../examples/e.plush") },
    Bundled { name: "S", text: include_str!("../../examples/s.plush") },
    Bundled { name: "Star", text: include_str!("../../examples/star.plush") },
    Bundled { name: "Cat", text: include_str!("../../examples/cat.plush") },
];

impl Bundled {
    /// The design, read and validated.
    ///
    /// # Errors
    /// What is wrong with the text; the tests read them all.
    pub fn design(&self) -> Result<Design, TextError> {
        parse(self.text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_example_is_a_sound_design() {
        for example in ALL {
            let design = example.design().unwrap_or_else(|error| panic!("{}: {error}", example.name));
            assert!(!design.poses.is_empty(), "{}", example.name);
        }
    }
}
