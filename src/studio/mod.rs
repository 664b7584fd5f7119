//! Room studio.
