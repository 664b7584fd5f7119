//! Motors and their commands: where each winch is over time, the commands that take it there, and the lines that carry them.
//!
//! A [`Plan`] makes of the animation what motors can follow. A [`Trajectory`] samples it: cable wound by each winch, in mm and encoder
//! counts. A dialect turns that into [`Program`]s of timed commands ([`classic`]: the ASCII family of Faulhaber controllers). [`transmit`] plays a program over a
//! [`Link`]: into a file ([`FileLink`]) or to simulated drives ([`SimulatedLink`]).
//!
//! ```
//! use plushwright::design::{Easing, Keyframe, bundled};
//! use plushwright::motion::{self, SimulatedLink, TooFast, Trajectory, classic};
//!
//! let mut design = bundled::ALL[0].design()?;
//! let pulled = vec![5.0; design.networks.len()];
//! let rest = vec![0.0; design.networks.len()];
//! let key = |time_s, activations_mm| Keyframe { time_s, activations_mm, pose: None, easing: Easing::Smooth };
//! design.keyframes = vec![key(0.0, rest), key(2.0, pulled)];
//! design.controller.track_rate_hz = 10.0;
//!
//! let trajectory = Trajectory::of(&design, TooFast::Refuse)?;
//! let programs = classic::programs(&design, &trajectory)?;
//! let mut drives = SimulatedLink::new(trajectory.winches.len());
//! motion::transmit(&programs.setup, &mut drives, motion::PATIENCE_S)?;
//! motion::transmit(&programs.motion, &mut drives, motion::PATIENCE_S)?;
//! assert!(drives.settle(10.0));
//! assert_eq!(drives.position(1), trajectory.counts.last().map(|row| row[0]));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod classic;
mod error;
pub mod limits;
mod link;
mod links;
mod plan;
mod profile;
mod program;
mod trajectory;
mod transmit;
mod winches;

pub use error::MotionError;
pub use limits::Limits;
pub use link::{Link, LinkError, Reply};
pub use links::{FileLink, SimulatedLink};
pub use plan::{Note, Plan, TooFast, smooth_s};
pub use program::Program;
pub use trajectory::{Trajectory, check};
pub use transmit::{PATIENCE_S, Sent, transmit};
pub use winches::counts_per_mm;
pub use winches::{Load, spool_degrees, winch_labels, winch_loads};
