//! Room fabrication.
