//! Motors and their commands: where each winch is over time, and the commands that take it there.
//!
//! A [`Plan`] makes of the animation what motors can follow. A [`Trajectory`] samples it: cable wound by each winch, in mm and encoder counts. A [`Machine`] is
//! what the [`families`] of controllers need of a design: a family makes either [`Program`]s of timed commands for a host (a [`Stream`]), or sketches that play by
//! themselves. [`beats`] say when a live drive tells which winch what; [`Following`] simulates how closely drives follow.
//!
//! ```
//! use plushwright::design::{Easing, Keyframe, bundled};
//! use plushwright::motion::{self, Following, Machine, TooFast, Trajectory, families};
//!
//! let mut design = bundled::ALL[0].design()?;
//! let pulled = vec![5.0; design.networks.len()];
//! let rest = vec![0.0; design.networks.len()];
//! let key = |time_s, activations_mm| Keyframe { time_s, activations_mm, pose: None, easing: Easing::Smooth };
//! design.keyframes = vec![key(0.0, rest), key(2.0, pulled)];
//!
//! let trajectory = Trajectory::of(&design, TooFast::Refuse)?;
//! let machine = Machine::new(&design, &trajectory);
//! let classic = families::classic::Classic::new(&machine)?;
//! let programs = motion::programs(&classic, &trajectory, &[]);
//! assert!(programs.motion.bytes().starts_with(b"1AC30000\r1DEC30000\r1EN\r"));
//! let [lag_mm, ripple] = Following::of_file(&machine, &trajectory).worst();
//! assert!(lag_mm < 0.1 && ripple < 0.1);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod drive;
mod error;
pub mod families;
mod following;
mod forecast;
mod framing;
mod ghost;
pub mod limits;
pub mod line;
mod machine;
mod plan;
mod profile;
mod program;
mod schedule;
mod stream;
mod trajectory;
mod winches;

pub use drive::Drive;
pub use error::MotionError;
pub use families::{Family, Sketch};
pub use following::Following;
pub use forecast::Forecast;
pub use framing::{Framing, bytes_of, hex};
pub use ghost::{Doubt, Ghost, Why, doubted};
pub use limits::Limits;
pub use machine::Machine;
pub use plan::{Note, Plan, TooFast, smooth_s};
pub use program::Program;
pub use schedule::{Beat, beats, commands_a_step, left_out, slot_s};
pub use stream::{Move, Programs, Stream, programs};
pub use trajectory::{Trajectory, check};
pub use winches::counts_per_mm;
pub use winches::{Load, spool_degrees, winch_labels, winch_loads};
