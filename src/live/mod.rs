//! Motors that are told live: over a serial port, or over a simulated one.
//!
//! A [`Link`] carries bytes: [`SerialLink`] to real controllers, [`SimulatedLink`] to simulated ones in virtual time. A [`Player`] speaks the words of a family
//! ([`Stream`](crate::motion::Stream)) over it: it reads every reply, keeps the time, winds back to zero first, refuses to begin beyond the limits, and switches
//! all motors off on any fault. A [`Remote`] is a player on a thread of its own, for a window. A [`Simulation`] answers as the manuals say, with
//! [`Fault`]s on request; `pseudo_terminal` puts it behind a port that other programs can open.
//!
//! ```
//! use plushwright::design::{Easing, Keyframe, bundled};
//! use plushwright::live::{Player, SimulatedLink, Simulation};
//! use plushwright::motion::{Machine, Plan, TooFast, Trajectory, families};
//! use std::sync::atomic::AtomicBool;
//!
//! let mut design = bundled::ALL[0].design()?;
//! let key = |time_s, mm: f64| Keyframe { time_s, activations_mm: vec![mm; 3], pose: None, easing: Easing::Smooth };
//! design.networks.truncate(3);
//! design.keyframes = vec![key(0.0, 0.0), key(2.0, 5.0), key(4.0, 0.0)];
//! let winches = design.networks.len();
//! design.keyframes.iter_mut().for_each(|key| key.activations_mm.truncate(winches));
//!
//! let (plan, trajectory) = (Plan::of(&design, TooFast::Refuse)?, Trajectory::of(&design, TooFast::Refuse)?);
//! let family = families::by_name("ascii").expect("there is one");
//! let stream = (family.stream.expect("told by a host"))(&Machine::new(&design, &trajectory))?;
//! let mut link = SimulatedLink::new(Simulation::of(family, winches));
//! let cancel = AtomicBool::new(false);
//! let mut player = Player::found(&*stream, &mut link, &cancel)?;
//! player.set_zero()?;
//! let played = player.play(&plan, 0.02, &mut |_| ())?;
//! assert!(played.late_s(0.95) < 0.02);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod controllers;
mod error;
mod fault;
mod link;
mod player;
#[cfg(unix)]
mod pseudo_terminal;
mod remote;
mod report;
mod serial;
mod simulated;
mod simulation;

pub use controllers::{Axis, Controller};
pub use error::{Cause, End, LiveError};
pub use fault::{Fault, FaultKind};
pub use link::Link;
pub use player::{LIMIT_TOLERANCE_MM, PATIENCE_S, Player, Stage};
#[cfg(unix)]
pub use pseudo_terminal::PseudoTerminal;
pub use remote::{Motion, Open, Order, Remote, Status};
pub use report::Played;
pub use serial::{SerialLink, ports};
pub use simulated::SimulatedLink;
pub use simulation::Simulation;
