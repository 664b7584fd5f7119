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
pub const ALL: &[Bundled] = &[];

impl Bundled {
    pub fn design(&self) -> Result<Design, TextError> {
        parse(self.text)
    }
}
