//! What a family of controllers is.

use crate::motion::error::MotionError;
use crate::motion::machine::Machine;
use crate::motion::stream::Stream;
use crate::motion::trajectory::Trajectory;

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
