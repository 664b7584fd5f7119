//! Room physics.
