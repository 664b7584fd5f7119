//! Limits of the controllers and their files.

/// Most steps of a trajectory: over five hours at the default rate. A guard against a file of many gigabytes.
pub const MAX_STEPS: f64 = 1e6;
/// Largest position the classic controllers take, counts (unconfirmed, from their manuals' command list).
pub const MAX_COUNTS: f64 = 1.8e9;
/// Nodes of the RS-232 network are numbered 1 to this (0 is the factory setting).
pub const MAX_NODES: usize = 255;
/// Ids of servos on a bus; those above mean something else.
pub const MAX_BUS_NODES: usize = 252;
/// Channels of a PCA9685.
pub const MAX_SERVOS: usize = 16;
/// Largest encoder resolution, counts per revolution.
pub const MAX_RESOLUTION: u32 = 65535;

/// Largest speed and acceleration of a winch, mm and s of cable.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// mm/s.
    pub speed: f64,
    /// mm/s^2.
    pub acceleration: f64,
}
